/// How much memory the process holds.
#pragma once

namespace tenku {

/// Forgets the most that was held so far, where the system can (Linux); otherwise the peak goes on
/// from the start of the process.
void reset_peak_memory();

/// Most that the process has held at once, MiB; 0 where the system does not say.
double peak_memory_mb();

}  // namespace tenku
