/// Processor time that has passed.
#pragma once

#include <ctime>

namespace tenku {

/// Runs from when it is made: seconds of all threads of the program together, which others on the
/// machine lengthen less than the clock.
class ProcessorWatch {
 public:
  double seconds() const {
    return static_cast<double>(std::clock() - start_) / static_cast<double>(CLOCKS_PER_SEC);
  }

 private:
  std::clock_t start_ = std::clock();
};

}  // namespace tenku
