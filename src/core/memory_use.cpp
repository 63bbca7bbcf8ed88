#include "core/memory_use.h"

#include <fstream>
#include <sstream>
#include <string>

namespace tenku {

void reset_peak_memory() {
  std::ofstream("/proc/self/clear_refs") << 5;  // proc(5): the peak becomes what is held now
}

double peak_memory_mb() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (!line.starts_with("VmHWM:")) continue;
    double kilobytes = 0.0;
    std::istringstream(line.substr(6)) >> kilobytes;
    return kilobytes / 1024.0;
  }
  return 0.0;
}

}  // namespace tenku
