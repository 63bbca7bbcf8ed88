#include "radiosity/mesh_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/extent.h"
#include "core/parallel.h"
#include "core/stopwatch.h"
#include "meshing/edges_on_lines.h"
#include "meshing/parted_mesh.h"

namespace tenku {
namespace {

constexpr std::size_t kMostElements = 1'000'000;
constexpr double kOtherSize = 1.4;   // times larger or smaller: another size
constexpr double kOtherShare = 0.1;  // of the elements asked for on a polygon
constexpr double kLeastGain =
    0.9;  // of error and elements before: a round that gains less is the last
constexpr double kMostOnTop = 0.5;  // of what was asked for: as far as one round goes on
constexpr double kLargest = 0.25;   // of the scene's longest side: largest element unasked
constexpr double kSmallest = 1.0 / 4096.0;
constexpr int kAttempts = 8;                            // at a number of elements
constexpr double kNearlyAll = 0.96, kManyOfAll = 0.93;  // of the elements allowed

/// What bubbles could not do, by kind.
std::vector<Finding> findings_of(const std::vector<BubbleFlaw>& flaws) {
  std::map<BubbleFlaw::Kind, std::pair<std::size_t, double>> kinds;
  for (const BubbleFlaw& flaw : flaws) {
    ++kinds[flaw.kind].first;
    kinds[flaw.kind].second += flaw.length_m;
  }
  std::vector<Finding> findings;
  for (const auto& [kind, sum] : kinds) {
    Finding finding;
    finding.count = sum.first;
    if (kind == BubbleFlaw::Kind::Constraints) {
      finding.code = "shadow_edges_left_out";
      finding.severity = Severity::Note;
      finding.what = std::to_string(sum.second) + " m of shadow edges run too near to others";
      finding.repair = "elements do not follow them; a smaller --size-min";
    } else {
      finding.code = "polygons_not_meshed_anew";
      finding.what =
          std::to_string(sum.first) +
          " polygons could not be meshed to suit the light: " + std::string(name_of(kind));
      finding.repair = "they keep the elements of the mesh before";
    }
    findings.push_back(std::move(finding));
  }
  return findings;
}

/// Means by elements and edges, the least angle of all.
MeshQuality quality_of(const BubbleMesh& made, std::span<const std::uint8_t> is_wanted) {
  MeshQuality all;
  double elements = 0.0;
  for (std::size_t p = 0; p < is_wanted.size(); ++p) {
    const auto here = static_cast<double>(made.meshes[p].elements.size());
    if (is_wanted[p] == 0 || here == 0.0) continue;
    const MeshQuality& q = made.quality[p];
    all.least_angle_deg =
        elements > 0.0 ? std::min(all.least_angle_deg, q.least_angle_deg) : q.least_angle_deg;
    all.mean_smallest_angle_deg += here * q.mean_smallest_angle_deg;
    all.share_within_20_pct += static_cast<double>(q.edges) * q.share_within_20_pct;
    all.edges += q.edges;
    all.steps = std::max(all.steps, q.steps);
    elements += here;
  }
  if (elements > 0.0) all.mean_smallest_angle_deg /= elements;
  if (all.edges > 0) all.share_within_20_pct /= static_cast<double>(all.edges);
  return all;
}

std::string told(const MeshQuality& quality) {
  return fmt::format(
      "smallest angles {:.1f} degrees on average, {:.1f} the least; {:.1f} % of edges within 20 % "
      "of the size; {} steps",
      quality.mean_smallest_angle_deg, quality.least_angle_deg, quality.share_within_20_pct,
      quality.steps);
}

}  // namespace

Mesher mesher_named(std::string_view name) {
  if (name == "uniform") return Mesher::Uniform;
  if (name == "refine") return Mesher::Refine;
  if (name == "bubble") return Mesher::Bubble;
  throw InputError("there is no mesh named '" + std::string(name) +
                   "'; there are: uniform, refine, bubble");
}

MeshLoop::MeshLoop(MeshedScene first, const std::vector<Material>& materials,
                   InteriorOptions interior, MeshLoopOptions options)
    : materials_(materials),
      how_(std::move(interior)),
      options_(std::move(options)),
      asked_pct_(options_.tolerance_pct),
      polygons_(std::move(first.polygons)),
      polygon_of_(std::move(first.polygon_of)),
      patch_m_(first.sizes.patch_m),
      mesh_(std::make_unique<ElementMesh>(std::move(first.mesh))) {
  const auto [least, most] = options_.sizes;
  if (least > 0.0 && most > 0.0 && !(least <= most)) {
    throw InputError("the least size of elements is above the greatest");
  }
  if (options_.rounds < 0) throw InputError("rounds should be 0 or more");
  if (!(options_.tolerance_pct > 0.0)) throw InputError("the tolerance should be positive");
  for (const ShadowEdges& edges : options_.edges) {
    constraints_.push_back(edges.shadows);
    constraints_.back().insert(constraints_.back().end(), edges.contacts.begin(),
                               edges.contacts.end());
  }
  if (!mesh_->vertices.empty()) longest_m_ = extent_of(mesh_->vertices).longest_side();
}

void MeshLoop::run(const LightRequest& request, Progress& progress) {
  solve(request, progress);
  rounds_.back().polygons_meshed = polygons_.size();
  if (options_.mesher == Mesher::Uniform) return;
  const bool is_once = options_.mesher == Mesher::Bubble && has_sizes_by_hand();
  const int rounds = is_once ? std::min(1, options_.rounds) : options_.rounds;
  for (int round = 0; round < rounds; ++round) {
    progress.stop_if_cancelled();
    if (!is_once && is_enough()) return;
    if (!remesh(progress)) return;
    solve(request, progress);
  }
}

void MeshLoop::solve(const LightRequest& request, Progress& progress) {
  if (interior_) before_ = times();
  interior_.reset();  // its form factors make room
  interior_ = std::make_unique<Interior>(*mesh_, materials_, how_);
  const std::size_t points_kept = interior_->adopt_rows(std::exchange(kept_rows_, {}));
  light_ = interior_->light(request, progress);
  on_mesh_.emplace(light_on_mesh(*mesh_, *interior_, light_));
  const Stopwatch watch;
  is_bent_ = edges_on_lines(*mesh_, polygons_, polygon_of_, constraints_);
  missed_lux_ = interpolation_error(*on_mesh_, is_bent_);
  if (options_.mesher == Mesher::Bubble && !has_sizes_by_hand()) size_field_s_ += watch.seconds();
  const double mean = mean_lux(*on_mesh_);
  if (rounds_.empty() || rounds_.back().elements > 0) rounds_.emplace_back();
  rounds_.back().elements = mesh_->size();
  rounds_.back().points_kept = points_kept;
  rounds_.back().missed_pct =
      mean > 0.0 ? 100.0 * interpolation_rms(*on_mesh_, missed_lux_) / mean : 0.0;
}

bool MeshLoop::is_enough() const {
  const MeshRound& last = rounds_.back();
  if (last.missed_pct <= options_.tolerance_pct) return true;
  if (rounds_.size() < 3) return false;
  const MeshRound& before = rounds_[rounds_.size() - 2];
  const double gain = last.missed_pct / before.missed_pct,
               fewer = static_cast<double>(last.elements) / static_cast<double>(before.elements);
  return gain > kLeastGain && gain * fewer > kLeastGain;
}

bool MeshLoop::remesh(Progress& progress) {
  return options_.mesher == Mesher::Refine ? remesh_by_threshold() : remesh_by_bubbles(progress);
}

std::vector<std::uint32_t> MeshLoop::sides_in(std::span<const MeshPiece> pieces) const {
  const auto present = pieces_of(*mesh_, polygon_of_, polygons_.size());
  std::vector<std::uint32_t> now(mesh_->sides(), PointGather::kGone);
  std::uint32_t here = 0, there = 0;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const PolygonMesh &before = present[p].mesh, &after = pieces[p].mesh;
    const auto sides = static_cast<std::uint32_t>(2 * before.elements.size());
    const bool is_same = before.elements == after.elements && before.vertices == after.vertices;
    for (std::uint32_t s = 0; s < sides && is_same; ++s) now[here + s] = there + s;
    here += sides;
    there += static_cast<std::uint32_t>(2 * after.elements.size());
  }
  return now;
}

void MeshLoop::take(std::vector<MeshPiece> pieces) {
  kept_rows_ = interior_->release_rows(sides_in(pieces));
  AssembledMesh all = assembled(polygons_, pieces);
  all.mesh.panes = mesh_->panes;
  interior_.reset();
  mesh_ = std::make_unique<ElementMesh>(std::move(all.mesh));
  polygon_of_ = std::move(all.polygon_of);
}

bool MeshLoop::remesh_by_threshold() {
  const Stopwatch watch;
  if (!refinement_) {
    refinement_ = std::make_unique<ThresholdRefinement>(
        polygons_, pieces_of(*mesh_, polygon_of_, polygons_.size()));
  }
  const double threshold_pct =
      options_.threshold_pct > 0.0 ? options_.threshold_pct : options_.tolerance_pct;
  const std::size_t most = options_.elements_max > 0 ? options_.elements_max : kMostElements;
  const std::size_t before = mesh_->size();
  auto pieces = refinement_->refined(neighbour_difference(*on_mesh_),
                                     threshold_pct / 100.0 * mean_lux(*on_mesh_), most, patch_m_);
  std::size_t after = 0;
  for (const MeshPiece& piece : pieces) after += piece.mesh.elements.size();
  if (after != before) {
    before_ = times();
    rounds_.emplace_back().polygons_meshed = polygons_.size();
    take(std::move(pieces));
  }
  remesh_s_ += watch.seconds();
  return after != before;
}

std::vector<MeshLoop::Samples> MeshLoop::samples_at_vertices(std::span<const double> size_m) const {
  std::vector<Samples> samples(polygons_.size());
  std::vector<std::uint8_t> is_taken(mesh_->vertices.size());
  for (std::size_t e = 0; e < mesh_->size(); ++e) {
    for (const std::uint32_t v : mesh_->elements[e]) {
      if (std::exchange(is_taken[v], 1) != 0) continue;
      const std::uint32_t p = polygon_of_[e];
      samples[p].push_back({polygons_[p].flat(mesh_->vertices[v]), size_m[v]});
    }
  }
  return samples;
}

std::vector<MeshLoop::Samples> MeshLoop::samples_in_elements(std::span<const double> size_m) const {
  std::vector<Samples> samples(polygons_.size());
  for (std::size_t e = 0; e < mesh_->size(); ++e) {
    const std::uint32_t p = polygon_of_[e];
    samples[p].push_back({polygons_[p].flat(mesh_->centre(e)), size_m[e]});
  }
  return samples;
}

void MeshLoop::make_fields(const std::vector<Samples>& samples, SizeRange range) {
  std::vector<std::unique_ptr<SizeField>> made(polygons_.size());
  parallel_for(made.size(), 1, [&](IndexRange part) {
    for (std::size_t p = part.begin; p < part.end; ++p) {
      made[p] = std::make_unique<SizeField>(
          polygons_[p], samples[p],
          SizeFieldOptions{
              .least_m = range.least_m, .most_m = range.most_m, .grading = options_.grading});
    }
  });
  field_.clear();
  for (auto& field : made) field_.push_back(std::move(*field));
}

std::vector<std::uint8_t> MeshLoop::polygons_to_mesh() const {
  std::vector<double> other(polygons_.size()), all(polygons_.size());
  for (std::size_t e = 0; e < mesh_->size(); ++e) {
    const std::uint32_t p = polygon_of_[e];
    const double asked = field_[p].at(polygons_[p].flat(mesh_->centre(e))),
                 ratio = mesh_->mean_edge_m(e) / asked,
                 elements = mesh_->area_m2(e) / (asked * asked);
    all[p] += elements;
    if (ratio > kOtherSize || ratio < 1.0 / kOtherSize) other[p] += elements;
  }
  std::vector<std::uint8_t> is_wanted(polygons_.size());
  for (std::size_t p = 0; p < all.size(); ++p) is_wanted[p] = other[p] > kOtherShare * all[p];
  return is_wanted;
}

BubbleMesh MeshLoop::bubbles(std::span<const std::uint8_t> is_wanted, double scale) const {
  std::vector<PolygonMesh> kept(polygons_.size());
  auto pieces = pieces_of(*mesh_, polygon_of_, polygons_.size());
  for (std::size_t p = 0; p < kept.size(); ++p) {
    if (is_wanted[p] == 0) kept[p] = std::move(pieces[p].mesh);
  }
  BubbleOptions options;
  options.kept = kept;
  return bubble_mesh(
      polygons_, [&](std::size_t p, PlanePoint at) { return scale * field_[p].at(at); },
      constraints_, options);
}

/// Equilateral triangles of the sizes asked for.
double MeshLoop::foreseen_elements() const {
  double sum = 0.0;
  for (std::size_t e = 0; e < mesh_->size(); ++e) {
    const std::uint32_t p = polygon_of_[e];
    const double size = field_[p].at(polygons_[p].flat(mesh_->centre(e)));
    sum += mesh_->area_m2(e) / (std::sqrt(3.0) / 4.0 * size * size);
  }
  return sum;
}

BubbleMesh MeshLoop::bubbles_up_to(std::span<const std::uint8_t> is_wanted) {
  const auto most =
      static_cast<double>(options_.elements_max > 0 ? options_.elements_max : kMostElements);
  const double wished = 0.5 * (1.0 + kNearlyAll) * most, foreseen = foreseen_elements();
  const double first = std::max(1.0, coarser_ * std::sqrt(foreseen / wished));
  BubbleMesh best;
  double scale = first, most_yet = -1.0, before = 0.0, before_scale = scale;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    BubbleMesh made = bubbles(is_wanted, scale);
    double count = 0.0;
    for (const PolygonMesh& mesh : made.meshes) count += static_cast<double>(mesh.elements.size());
    const bool is_better = most_yet > most ? count < most_yet : count <= most && count > most_yet;
    if (attempt == 0 || is_better) best = std::move(made), most_yet = count;
    const bool are_too_few = count < kManyOfAll * most && scale > 1.0;
    if (count <= most && (!are_too_few || attempt >= kAttempts / 2)) break;
    // Elements along lines do not grow with the others: how the number falls is learnt.
    if ((before - count) * (scale - before_scale) > 0.0) {
      power_ = std::clamp(std::log(before / count) / std::log(scale / before_scale), 0.5, 2.0);
    }
    before = count;
    before_scale =
        std::exchange(scale, std::max(1.0, scale * std::pow(count / wished, 1.0 / power_)));
  }
  if (foreseen > wished) coarser_ *= scale / first;
  return best;
}

bool MeshLoop::remesh_by_bubbles(Progress& progress) {
  const Stopwatch watch;
  SizeRange range = options_.sizes;
  std::vector<Samples> samples;
  if (has_sizes_by_hand()) {
    samples = samples_at_vertices(sizes_by_change(*on_mesh_, range));
  } else {
    if (!(range.most_m > 0.0)) range.most_m = std::max(range.least_m, kLargest * longest_m_);
    if (!(range.least_m > 0.0)) range.least_m = std::min(range.most_m, kSmallest * longest_m_);
    // Jumps keep more than foreseen: what the last round fell short by is asked for on top.
    const double short_by = options_.tolerance_pct / rounds_.back().missed_pct;
    if (rounds_.size() > 1) asked_pct_ *= std::clamp(short_by, kMostOnTop, 1.0);
    const double allowed = asked_pct_ / 100.0 * mean_lux(*on_mesh_);
    samples = samples_in_elements(
        sizes_by_error(*on_mesh_, missed_lux_, {allowed, options_.elements_max, range}, is_bent_));
  }
  make_fields(samples, range);
  const std::vector<std::uint8_t> is_wanted = polygons_to_mesh();
  const auto wanted = std::count(is_wanted.begin(), is_wanted.end(), 1);
  size_field_s_ += watch.seconds();
  if (wanted == 0) return false;
  const Stopwatch meshing;
  progress.begin("mesh of bubbles", 0);
  BubbleMesh made = bubbles_up_to(is_wanted);
  const MeshQuality quality = quality_of(made, is_wanted);
  progress.end(told(quality));
  findings_ = findings_of(made.flaws);
  auto pieces = pieces_of(*mesh_, polygon_of_, polygons_.size());
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    if (is_wanted[p] == 0 || made.meshes[p].elements.empty()) continue;
    PolygonMesh mesh = std::move(made.meshes[p]);
    if (!options_.edges.empty() && !options_.edges[p].contacts.empty()) {
      mesh = parted_along(polygons_[p], std::move(mesh), options_.edges[p].contacts);
    }
    pieces[p] = grouped_piece(polygons_[p], std::move(mesh), patch_m_);
  }
  before_ = times();
  rounds_.emplace_back().polygons_meshed = static_cast<std::size_t>(wanted);
  rounds_.back().quality = quality;
  take(std::move(pieces));
  remesh_s_ += meshing.seconds();
  return true;
}

InteriorTimes MeshLoop::times() const {
  InteriorTimes sum = before_;
  if (interior_) {
    sum.form_factors_s += interior_->times().form_factors_s;
    sum.daylight_s += interior_->times().daylight_s;
    sum.solve_s += interior_->times().solve_s;
  }
  return sum;
}

std::vector<double> MeshLoop::asked_size_m() const {
  if (field_.empty()) return {};
  std::vector<double> size(mesh_->vertices.size());
  for (std::size_t e = 0; e < mesh_->size(); ++e) {
    const std::uint32_t p = polygon_of_[e];
    for (const std::uint32_t v : mesh_->elements[e]) {
      size[v] = field_[p].at(polygons_[p].flat(mesh_->vertices[v]));
    }
  }
  return size;
}

}  // namespace tenku
