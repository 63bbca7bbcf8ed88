/// Progress as a person at a terminal, or a log file, wants it.
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>

#include "core/progress.h"

namespace tenku {

/// On a terminal a bar with the time left for anything over two seconds; elsewhere one line a
/// stage. While it lives, Ctrl-C and SIGTERM make `is_cancelled` true.
class TerminalProgress : public Progress {
 public:
  explicit TerminalProgress(bool quiet);
  ~TerminalProgress() override;

  void begin(std::string_view stage, std::size_t steps) override;
  void advance(std::size_t steps) override;
  void end(std::string_view summary) override;
  bool is_cancelled() const override;

 private:
  using Clock = std::chrono::steady_clock;
  void draw(double elapsed_s, double fraction);
  void clear_line();

  bool quiet_, terminal_, drawn_ = false;
  std::string stage_;
  std::size_t steps_ = 0;
  std::atomic<std::size_t> done_{0};
  Clock::time_point start_, last_draw_;
  std::mutex drawing_;
};

}  // namespace tenku
