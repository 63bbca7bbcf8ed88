/// Measured errors, kept in the test's record and printed for docs/validation.md.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace tenku::testing_support {

/// Largest of some errors, with where it was found.
class WorstError {
 public:
  explicit WorstError(std::string name) : name_(std::move(name)) {}
  ~WorstError() {
    std::printf("[ MEASURED ] %s: %.3g (%zu values, worst at %s)\n", name_.c_str(), worst_, count_,
                where_.c_str());
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", worst_);
    ::testing::Test::RecordProperty(name_, text);
  }
  WorstError(const WorstError&) = delete;
  WorstError& operator=(const WorstError&) = delete;

  void add(double error, const std::string& where) {
    ++count_;
    if (!(std::abs(error) <= worst_)) {
      worst_ = std::abs(error);
      where_ = where;
    }
  }
  double worst() const { return worst_; }

 private:
  std::string name_, where_;
  double worst_ = 0.0;
  std::size_t count_ = 0;
};

}  // namespace tenku::testing_support
