#include "illuminance/decision.h"

#include <fmt/format.h>

#include <charconv>
#include <string>

#include "core/error.h"

namespace tenku {

DecisionThreshold decision_threshold(std::string_view text) {
  const auto refuse = [&] {
    return InputError(
        "'" + std::string(text) +
        "' is nothing to decide on: give an illuminance above 0, such as 300lx, or "
        "skylight as a share of that of an open field, above 0 and up to 100, such as "
        "27%sky");
  };
  DecisionThreshold threshold;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), threshold.value);
  if (error != std::errc()) throw refuse();
  std::string_view unit = text.substr(static_cast<std::size_t>(end - text.data()));
  while (!unit.empty() && unit.front() == ' ') unit.remove_prefix(1);
  if (unit == "lx") {
    if (!(threshold.value > 0.0 && threshold.value <= 1e7)) throw refuse();
    return threshold;
  }
  if (unit != "%sky" || !(threshold.value > 0.0 && threshold.value <= 100.0)) throw refuse();
  threshold.of = DecisionThreshold::Of::Skylight;
  threshold.value /= 100.0;
  return threshold;
}

Decided decided_by(double value_lux, double interval_lux, double threshold_lux) {
  if (value_lux - interval_lux > threshold_lux) return Decided::Yes;
  if (value_lux + interval_lux < threshold_lux) return Decided::No;
  return Decided::Undecided;
}

DecisionCounts counts_of(const std::vector<Decided>& decided) {
  DecisionCounts counts;
  for (const Decided d : decided) {
    (d == Decided::Yes ? counts.yes : d == Decided::No ? counts.no : counts.undecided) += 1;
  }
  return counts;
}

std::string in_words(std::string_view threshold, const DecisionCounts& counts) {
  return fmt::format("above {}: {} yes, {} no, {} undecided", threshold, counts.yes, counts.no,
                     counts.undecided);
}

}  // namespace tenku
