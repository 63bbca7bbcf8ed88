/// How long each stage of a calculation took.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/progress.h"
#include "core/stopwatch.h"
#include "output/manifest.h"

namespace tenku {

/// Passes everything on to another listener, and takes the time of stages.
class StageClock : public Progress {
 public:
  explicit StageClock(Progress& listener) : listener_(listener) {}

  void begin(std::string_view stage, std::size_t steps) override {
    name_ = stage;
    watch_ = {};
    listener_.begin(stage, steps);
  }
  void advance(std::size_t steps) override { listener_.advance(steps); }
  void end(std::string_view summary) override {
    stages_.push_back({std::exchange(name_, {}), watch_.seconds()});
    listener_.end(summary);
  }
  bool is_cancelled() const override { return listener_.is_cancelled(); }

  const std::vector<ManifestStage>& stages() const { return stages_; }

 private:
  Progress& listener_;
  std::string name_;
  Stopwatch watch_;
  std::vector<ManifestStage> stages_;
};

}  // namespace tenku
