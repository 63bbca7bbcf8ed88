#include "radiosity/point_gather.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "core/parallel.h"
#include "form_factors/point_view.h"
#include "radiosity/settled_looks.h"

namespace tenku {
namespace {

constexpr std::size_t kGrain = 8;      // rows to find a task
constexpr std::size_t kRowGrain = 64;  // points a task that have them
constexpr std::size_t kChunk = 8192;   // rows between two looks at the memory
constexpr std::uint64_t kSecondSeed = 0x9e3779b97f4a7c15U;

}  // namespace

std::size_t PointGather::levels(const PointGatherOptions& options) {
  std::size_t levels = 1;
  while (levels < kLevels &&
         resolution_at(options.form_factors.resolution, levels) <= options.finest) {
    ++levels;
  }
  return levels;
}

int PointGather::first_resolution(const PointGatherOptions& options) {
  const double share = std::sqrt(static_cast<double>(kLooks));
  return std::max(2, static_cast<int>(std::lround(options.form_factors.resolution / share)));
}

PointGather::Methods PointGather::methods(const ElementMesh& mesh,
                                          const PointGatherOptions& options, std::size_t level) {
  FormFactorOptions half = options.form_factors;
  half.resolution = resolution_at(first_resolution(options), level);
  Methods made;
  for (auto& method : made) {
    method = form_factor_method(options.method, mesh, half);
    // Methods that do not sample differ by their resolution instead.
    half.seed += kSecondSeed;
    half.resolution += 1;
  }
  return made;
}

PointGather::PointGather(const ElementMesh& mesh, const Sensors& points,
                         const PointGatherOptions& options)
    : points_(points),
      lift_m_(options.lift_m),
      outward_(mesh, options.lift_m),
      mesh_(mesh),
      options_(options),
      level_(points.size()),
      store_(kLooks * points.size(), options.most_bytes) {
  method_[0] = methods(mesh, options, 0);
}

void PointGather::ready(std::size_t level) {
  if (!method_[level][0]) method_[level] = methods(mesh_, options_, level);
}

bool PointGather::look_finer(std::span<std::uint8_t> steps) {
  const std::size_t finest = levels(options_) - 1;
  bool any = false;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (level_[i] >= finest) steps[i] = 0;
    if (steps[i] == 0) continue;
    level_[i] = static_cast<std::uint8_t>(std::min<std::size_t>(level_[i] + steps[i], finest));
    ready(level_[i]);
    for (std::size_t look = 0; look < kLooks; ++look) store_.forget(kLooks * i + look);
    any = true;
  }
  return any;
}

FormFactorRow PointGather::find(std::size_t point, std::size_t look) const {
  const Vec3 normal = points_.normal[point];
  if (outward_.faces_nothing(points_.position[point], normal)) return {};
  return method_[level_[point]][look]->from_point(points_.position[point] + lift_m_ * normal,
                                                  normal);
}

std::vector<PointGather::Kept> PointGather::release(std::span<const std::uint32_t> now) {
  std::vector<Kept> kept;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Kept one{points_.position[i], points_.normal[i], level_[i], {}};
    bool is_whole = true;
    for (std::size_t look = 0; look < kLooks && is_whole; ++look) {
      const FormFactorRow* row = store_.find(kLooks * i + look);
      is_whole = row != nullptr && std::all_of(row->begin(), row->end(), [&](const FormFactor& f) {
                   return now[f.side] != kGone;
                 });
      if (!is_whole) break;
      one.row[look] = *row;
      for (FormFactor& f : one.row[look]) f.side = now[f.side];
    }
    if (is_whole) kept.push_back(std::move(one));
    for (std::size_t look = 0; look < kLooks; ++look) store_.forget(kLooks * i + look);
  }
  return kept;
}

std::size_t PointGather::adopt(std::vector<Kept> rows) {
  std::unordered_map<std::uint64_t, std::size_t> known;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    known.emplace(key_of(rows[k].position, rows[k].normal, 0), k);
  }
  std::size_t adopted = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const auto found = known.find(key_of(points_.position[i], points_.normal[i], 0));
    if (found == known.end()) continue;
    Kept& one = rows[found->second];
    if (!(one.position == points_.position[i]) || !(one.normal == points_.normal[i])) continue;
    if (!store_.fits(one.row[0]) || !store_.fits(one.row[1])) break;
    level_[i] = one.level;
    ready(one.level);
    for (std::size_t look = 0; look < kLooks; ++look) {
      if (store_.fits(one.row[look])) store_.keep(kLooks * i + look, std::move(one.row[look]));
    }
    known.erase(found);
    ++adopted;
  }
  return adopted;
}

void PointGather::prepare(std::span<const std::uint8_t> is_wanted, Progress& progress) {
  std::vector<std::size_t> missing;
  for (std::size_t k = 0; k < store_.size(); ++k) {
    if (is_wanted[k / kLooks] != 0 && store_.find(k) == nullptr) missing.push_back(k);
  }
  progress.begin("form factors of points", missing.size());
  refused_ = 0;
  for (std::size_t begin = 0; begin < missing.size() && refused_ == 0; begin += kChunk) {
    const std::size_t count = std::min(kChunk, missing.size() - begin);
    std::vector<FormFactorRow> rows(count);
    parallel_for(count, kGrain, [&](IndexRange range) {
      progress.stop_if_cancelled();
      for (std::size_t k = range.begin; k < range.end; ++k) {
        rows[k] = find(missing[begin + k] / kLooks, missing[begin + k] % kLooks);
      }
      progress.advance(range.end - range.begin);
    });
    for (std::size_t k = 0; k < count; ++k) {
      if (!store_.fits(rows[k])) {
        refused_ = missing.size() - begin - k;
        break;
      }
      store_.keep(missing[begin + k], std::move(rows[k]));
    }
  }
  progress.end(std::to_string(missing.size()) + " rows");
}

void PointGather::for_rows(
    std::span<const std::uint8_t> is_wanted,
    const std::function<void(std::size_t, std::size_t, const FormFactorRow&)>& use) const {
  parallel_for(points_.size(), kRowGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      if (is_wanted[i] == 0) continue;
      for (std::size_t look = 0; look < kLooks; ++look) {
        if (const FormFactorRow* row = store_.find(kLooks * i + look)) {
          use(i, look, *row);
        } else {
          use(i, look, find(i, look));
        }
      }
    }
  });
}

std::vector<PointGather::Looks> PointGather::gather(std::span<const Rgb> of_side,
                                                    std::span<const std::uint8_t> is_wanted) const {
  std::vector<Looks> sums(points_.size());
  for_rows(is_wanted, [&](std::size_t point, std::size_t look, const FormFactorRow& row) {
    Rgb sum;
    for (const FormFactor& f : row) sum = sum + f.value * of_side[f.side];
    sums[point][look] = sum;
  });
  return sums;
}

}  // namespace tenku
