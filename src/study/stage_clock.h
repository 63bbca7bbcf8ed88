/// How long each stage of a calculation took.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/progress.h"
#include "output/manifest.h"

namespace tenku {

/// Passes everything on to another listener, and takes the time of stages.
class StageClock : public Progress {
 public:
  explicit StageClock(Progress& listener) : listener_(listener) {}

  void begin(std::string_view stage, std::size_t steps) override {
    name_ = stage;
    start_ = std::chrono::steady_clock::now();
    listener_.begin(stage, steps);
  }
  void advance(std::size_t steps) override { listener_.advance(steps); }
  void end(std::string_view summary) override {
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start_;
    stages_.push_back({std::exchange(name_, {}), time.count()});
    listener_.end(summary);
  }
  bool is_cancelled() const override { return listener_.is_cancelled(); }

  const std::vector<ManifestStage>& stages() const { return stages_; }

 private:
  Progress& listener_;
  std::string name_;
  std::chrono::steady_clock::time_point start_;
  std::vector<ManifestStage> stages_;
};

}  // namespace tenku
