/// How a long calculation tells how far it is, and learns that it should stop.
#pragma once

#include <cstddef>
#include <string_view>

namespace tenku {

/// Listener of a calculation in stages. This base does nothing and never stops; the command line
/// derives one that draws a bar and watches Ctrl-C.
///
/// Threads  `advance` and `is_cancelled` may be called from many threads at once.
class Progress {
 public:
  virtual ~Progress() = default;
  /// A stage begins that takes `steps` steps (0: unknown).
  virtual void begin(std::string_view stage, std::size_t steps);
  /// `steps` more steps of the stage are done.
  virtual void advance(std::size_t steps);
  /// The stage is done; `summary` is a short text for the log, such as `41,187 triangles`.
  virtual void end(std::string_view summary);
  /// The user asked to stop.
  virtual bool is_cancelled() const;
  /// @throws Cancelled if the user asked to stop
  void stop_if_cancelled() const;
};

}  // namespace tenku
