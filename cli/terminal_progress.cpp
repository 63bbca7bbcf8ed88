#include "cli/terminal_progress.h"

#include <unistd.h>

#include <csignal>
#include <cstdio>

#include "cli/command.h"

namespace tenku {
namespace {

volatile std::sig_atomic_t stop_asked = 0;  // a signal handler can reach nothing else

extern "C" void ask_to_stop(int) { stop_asked = 1; }

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

TerminalProgress::TerminalProgress(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO)) {
  std::signal(SIGINT, ask_to_stop);
  std::signal(SIGTERM, ask_to_stop);
}

TerminalProgress::~TerminalProgress() {
  clear_line();
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

void TerminalProgress::begin(std::string_view stage, std::size_t steps) {
  const std::lock_guard lock(drawing_);
  stage_ = stage;
  steps_ = steps;
  done_ = 0;
  start_ = last_draw_ = Clock::now();
}

void TerminalProgress::advance(std::size_t steps) {
  done_ += steps;
  if (quiet_ || !terminal_ || steps_ == 0) return;
  const std::unique_lock lock(drawing_, std::try_to_lock);
  if (!lock.owns_lock()) return;
  const double elapsed = seconds_since(start_);
  if (elapsed < 2.0 || seconds_since(last_draw_) < 0.2) return;
  last_draw_ = Clock::now();
  draw(elapsed, std::min(1.0, static_cast<double>(done_) / static_cast<double>(steps_)));
}

void TerminalProgress::draw(double elapsed_s, double fraction) {
  constexpr int kWidth = 30;
  const int filled = static_cast<int>(fraction * kWidth);
  std::string bar(static_cast<std::size_t>(filled), '#');
  bar.resize(kWidth, '.');
  const double left = fraction > 0.0 ? elapsed_s * (1.0 - fraction) / fraction : 0.0;
  std::fprintf(stderr, "\r\033[K%s [%s] %3.0f %%, %.0f s left", stage_.c_str(), bar.c_str(),
               100.0 * fraction, left);
  std::fflush(stderr);
  drawn_ = true;
}

void TerminalProgress::clear_line() {
  if (drawn_) std::fprintf(stderr, "\r\033[K");
  drawn_ = false;
}

void TerminalProgress::end(std::string_view summary) {
  const std::lock_guard lock(drawing_);
  clear_line();
  if (quiet_) return;
  std::fprintf(stderr, "%-24s %6.2f s  %.*s\n", stage_.c_str(), seconds_since(start_),
               static_cast<int>(summary.size()), summary.data());
}

bool TerminalProgress::is_cancelled() const { return stop_asked != 0; }

void say(const CommonOptions& options, const std::string& line) {
  if (!options.quiet) std::fprintf(stderr, "%s\n", line.c_str());
}

}  // namespace tenku
