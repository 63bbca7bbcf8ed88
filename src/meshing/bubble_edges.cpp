#include "meshing/bubble_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/parallel.h"
#include "meshing/point_tree.h"

namespace tenku {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// A straight part of an edge, the corner with the lower number first.
struct Part {
  std::uint32_t from, to;
  std::vector<std::uint32_t> polygons;   ///< that it bounds
  std::vector<std::uint32_t> bubbles{};  ///< between its ends
};

bool is_kept(const BubbleOptions& options, std::size_t polygon) {
  return !options.kept.empty() && !options.kept[polygon].elements.empty();
}

/// Vertices of a mesh's border.
std::vector<Vec3> border_of(const PolygonMesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& t : mesh.elements) {
    for (unsigned k = 0; k < 3; ++k) edges.push_back(std::minmax(t[k], t[(k + 1) % 3]));
  }
  std::sort(edges.begin(), edges.end());
  std::vector<std::uint32_t> once;
  for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
    for (end = i; end < edges.size() && edges[end] == edges[i];) ++end;
    if (end - i == 1) once.insert(once.end(), {edges[i].first, edges[i].second});
  }
  std::sort(once.begin(), once.end());
  once.erase(std::unique(once.begin(), once.end()), once.end());
  std::vector<Vec3> border;
  for (const std::uint32_t v : once) border.push_back(mesh.vertices[v]);
  return border;
}

class EdgeFiller {
 public:
  EdgeFiller(std::span<const FlatPolygon> polygons, const SizeAt& size_at,
             const BubbleOptions& options)
      : polygons_(polygons), size_at_(size_at), options_(options) {
    made_.rings.resize(polygons.size());
    made_.refusal.resize(polygons.size());
  }

  EdgeBubbles fill() {
    find_corners();
    part_edges();
    find_short();
    take_over_kept();
    place_bubbles();
    make_rings();
    return std::move(made_);
  }

 private:
  using Chain = std::vector<std::uint32_t>;  ///< corners

  void find_corners() {
    corner_of_.resize(polygons_.size());
    std::vector<Vec3> all;
    for (std::size_t p = 0; p < polygons_.size(); ++p) {
      const auto& rings = polygons_[p].rings;
      const bool is_sound = std::all_of(rings.begin(), rings.end(), [](const auto& ring) {
        return std::all_of(ring.begin(), ring.end(), is_finite);
      });
      if (!is_sound) made_.refusal[p] = BubbleFlaw::Kind::NotFinite;
      for (const auto& ring : rings) {
        if (is_sound) all.insert(all.end(), ring.begin(), ring.end());
      }
    }
    if (all.empty()) return;
    weld_m_ = JoinTolerance::of(all).weld_m;
    const auto stands_for = welded(all, weld_m_);
    std::vector<std::uint32_t> number(all.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) {
      if (stands_for[i] == i) {
        number[i] = static_cast<std::uint32_t>(made_.places.size());
        made_.places.push_back(all[i]);
      } else {
        number[i] = number[stands_for[i]];
      }
    }
    std::size_t next = 0;
    for (std::size_t p = 0; p < polygons_.size(); ++p) {
      if (made_.refusal[p]) continue;
      for (const auto& ring : polygons_[p].rings) {
        Chain& chain = corner_of_[p].emplace_back();
        for (std::size_t k = 0; k < ring.size(); ++k) chain.push_back(number[next++]);
      }
    }
  }

  /// Corners on the way from one to another, both included.
  Chain corners_between(const PointTree& tree, std::uint32_t from, std::uint32_t to) const {
    const Vec3 a = made_.places[from], b = made_.places[to];
    std::vector<std::pair<double, std::uint32_t>> along;
    for (const std::uint32_t v : tree.near_segment(a, b, weld_m_)) {
      if (v != from && v != to) along.emplace_back(dot(made_.places[v] - a, b - a), v);
    }
    std::sort(along.begin(), along.end());
    Chain chain{from};
    for (const auto& [t, v] : along) chain.push_back(v);
    chain.push_back(to);
    return chain;
  }

  void part_edges() {
    const std::vector<Vec3> corners = made_.places;
    const PointTree tree(corners);
    std::vector<std::vector<Chain>> parted(polygons_.size());
    parallel_for(polygons_.size(), 16, [&](IndexRange range) {
      for (std::size_t p = range.begin; p < range.end; ++p) {
        for (const Chain& ring : corner_of_[p]) {
          Chain& chain = parted[p].emplace_back();
          for (std::size_t k = 0; k < ring.size(); ++k) {
            if (ring[k] == ring[(k + 1) % ring.size()]) continue;
            const Chain way = corners_between(tree, ring[k], ring[(k + 1) % ring.size()]);
            chain.insert(chain.end(), way.begin(), way.end() - 1);
          }
        }
      }
    });
    corner_of_ = std::move(parted);
    for (std::uint32_t p = 0; p < polygons_.size(); ++p) {
      for (const Chain& ring : corner_of_[p]) {
        for (std::size_t k = 0; k < ring.size(); ++k)
          add_part(ring[k], ring[(k + 1) % ring.size()], p);
      }
    }
  }

  void add_part(std::uint32_t a, std::uint32_t b, std::uint32_t polygon) {
    const auto key = std::minmax(a, b);
    const auto [at, is_new] = part_of_.try_emplace({key.first, key.second}, parts_.size());
    if (is_new) parts_.push_back({key.first, key.second, {}});
    auto& users = parts_[at->second].polygons;
    if (users.empty() || users.back() != polygon) users.push_back(polygon);
  }

  void find_short() {
    shortest_.assign(made_.places.size(), kFar);
    for (const Part& part : parts_) {
      const double long_m = length(made_.places[part.to] - made_.places[part.from]);
      for (const std::uint32_t v : {part.from, part.to}) {
        shortest_[v] = std::min(shortest_[v], long_m);
      }
    }
  }

  /// Gives parts of polygons that are kept the vertices that are there.
  void take_over_kept() {
    is_given_.assign(parts_.size(), 0);
    std::vector<std::vector<std::size_t>> parts(polygons_.size());
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      for (const std::uint32_t p : parts_[i].polygons) {
        if (is_kept(options_, p)) parts[p].push_back(i);
      }
    }
    for (std::size_t p = 0; p < polygons_.size(); ++p) {
      if (parts[p].empty()) continue;
      const std::vector<Vec3> border = border_of(options_.kept[p]);
      const PointTree tree(border);
      for (const std::size_t i : parts[p]) {
        is_given_[i] = 1;
        const Vec3 a = made_.places[parts_[i].from], b = made_.places[parts_[i].to];
        for (const std::uint32_t v : tree.near_segment(a, b, weld_m_))
          add_given(parts_[i], border[v]);
      }
    }
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const Vec3 a = made_.places[parts_[i].from], b = made_.places[parts_[i].to];
      std::sort(parts_[i].bubbles.begin(), parts_[i].bubbles.end(), [&](auto v, auto w) {
        return dot(made_.places[v] - a, b - a) < dot(made_.places[w] - a, b - a);
      });
    }
  }

  void add_given(Part& part, Vec3 place) {
    const auto is_there = [&](std::uint32_t v) {
      return length(made_.places[v] - place) <= weld_m_;
    };
    if (is_there(part.from) || is_there(part.to) ||
        std::any_of(part.bubbles.begin(), part.bubbles.end(), is_there)) {
      return;
    }
    part.bubbles.push_back(static_cast<std::uint32_t>(made_.places.size()));
    made_.places.push_back(place);
  }

  /// Least size of the polygons that have the part; one whose size cannot be used is refused.
  double size_on(const Part& part, double t, std::vector<std::uint8_t>& is_bad) const {
    const Vec3 a = made_.places[part.from], b = made_.places[part.to];
    const double long_m = length(b - a);
    const Vec3 place = a + (t / long_m) * (b - a);
    double size = kFar;
    for (std::size_t k = 0; k < part.polygons.size(); ++k) {
      const std::uint32_t p = part.polygons[k];
      const double wanted = size_at_(p, polygons_[p].flat(place));
      if (wanted > 0.0 && std::isfinite(wanted)) {
        size = std::min(size, wanted);
      } else {
        is_bad[k] = 1;
      }
    }
    size = std::min(size, shortest_[part.from] + kRiseFromShort * t);
    return std::min(size, shortest_[part.to] + kRiseFromShort * (long_m - t));
  }

  void place_bubbles() {
    std::vector<std::vector<double>> at(parts_.size());
    std::vector<std::vector<std::uint8_t>> is_bad(parts_.size());
    std::vector<std::optional<BubbleFlaw::Kind>> refusal(parts_.size());
    parallel_for(parts_.size(), 16, [&](IndexRange range) {
      for (std::size_t i = range.begin; i < range.end; ++i) {
        const Part& part = parts_[i];
        is_bad[i].assign(part.polygons.size(), 0);
        if (is_given_[i] != 0) continue;
        ChainAnswer answer = bubble_chain(
            length(made_.places[part.to] - made_.places[part.from]),
            [&](double t) { return size_on(part, t, is_bad[i]); }, options_.vertices_most);
        at[i] = std::move(answer.at);
        refusal[i] = answer.refusal;
      }
    });
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      Part& part = parts_[i];
      for (std::size_t k = 0; k < part.polygons.size(); ++k) {
        if (is_bad[i][k] != 0) made_.refusal[part.polygons[k]] = BubbleFlaw::Kind::BadSize;
        if (refusal[i] && !made_.refusal[part.polygons[k]]) {
          made_.refusal[part.polygons[k]] = refusal[i];
        }
      }
      const Vec3 a = made_.places[part.from], b = made_.places[part.to];
      for (const double t : at[i]) {
        part.bubbles.push_back(static_cast<std::uint32_t>(made_.places.size()));
        made_.places.push_back(a + t * (b - a));
      }
    }
  }

  void make_rings() {
    for (std::size_t p = 0; p < polygons_.size(); ++p) {
      for (const Chain& corners : corner_of_[p]) {
        auto& ring = made_.rings[p].emplace_back();
        for (std::size_t k = 0; k < corners.size(); ++k) {
          const std::uint32_t a = corners[k], b = corners[(k + 1) % corners.size()];
          const auto key = std::minmax(a, b);
          const auto& between = parts_[part_of_.at({key.first, key.second})].bubbles;
          ring.push_back(a);
          if (a < b) {
            ring.insert(ring.end(), between.begin(), between.end());
          } else {
            ring.insert(ring.end(), between.rbegin(), between.rend());
          }
        }
      }
    }
  }

  std::span<const FlatPolygon> polygons_;
  const SizeAt& size_at_;
  const BubbleOptions& options_;
  double weld_m_ = 0.0;
  std::vector<std::vector<Chain>> corner_of_;  ///< [polygon][ring]
  std::vector<Part> parts_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> part_of_;
  std::vector<double> shortest_;        ///< [corner] part that ends there
  std::vector<std::uint8_t> is_given_;  ///< [part] by a mesh that is kept
  EdgeBubbles made_;
};

}  // namespace

ChainAnswer bubble_chain(double length_m, const std::function<double(double)>& size_at,
                         std::size_t most) {
  // Bubbles that touch lie at equal steps of the integral of 1 / size.
  constexpr double kStep = 0.5, kFewest = 8.0;             // of the size; steps of a whole chain
  std::vector<std::pair<double, double>> sum{{0.0, 0.0}};  // place, integral
  double size = size_at(0.0);
  while (sum.back().first < length_m) {
    if (!(size > 0.0)) return {{}, BubbleFlaw::Kind::BadSize};
    if (sum.size() > 4 * most + 16) return {{}, BubbleFlaw::Kind::TooMany};
    const auto [t, integral] = sum.back();
    const double next = std::min(length_m, t + std::min(kStep * size, length_m / kFewest));
    if (!(next > t)) return {{}, BubbleFlaw::Kind::TooMany};
    const double size_there = size_at(next);
    sum.emplace_back(next, integral + 0.5 * (next - t) * (1.0 / size + 1.0 / size_there));
    size = size_there;
  }
  const double whole = sum.back().second;
  if (!(whole >= 0.0)) return {{}, BubbleFlaw::Kind::BadSize};
  if (whole > static_cast<double>(most)) return {{}, BubbleFlaw::Kind::TooMany};
  // Of n and n + 1 pieces, those whose length is off by the lesser factor.
  const double less = std::max(1.0, std::floor(whole));
  const double n = whole > std::sqrt(less * (less + 1.0)) ? less + 1.0 : less;
  ChainAnswer answer;
  std::size_t i = 1;
  for (double k = 1.0; k < n; ++k) {
    const double wanted = whole * k / n;
    while (i + 1 < sum.size() && sum[i].second < wanted) ++i;
    const auto& [t0, s0] = sum[i - 1];
    const auto& [t1, s1] = sum[i];
    answer.at.push_back((t0 + (wanted - s0) / (s1 - s0) * (t1 - t0)) / length_m);
  }
  return answer;
}

EdgeBubbles fill_edges(std::span<const FlatPolygon> polygons, const SizeAt& size_at,
                       const BubbleOptions& options) {
  return EdgeFiller(polygons, size_at, options).fill();
}

}  // namespace tenku
