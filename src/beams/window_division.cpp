#include "beams/window_division.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace tenku {
namespace {

constexpr std::size_t kLinesTried = 12;
constexpr double kEquallyNear = 1e-10;  ///< relative: no more than rounding tells apart

/// How two faces stand to each other where the first is seen.
enum class Order { Before, Behind, Same, Crossing };

Order order_of(const SeenFace& face, const SeenFace& other) {
  const Nearness ahead = face.nearness - other.nearness;
  bool before = false, behind = false;
  for (const WindowPolygon::Corner& c : face.outline.corners()) {
    const double h = ahead.at(c.at);
    const double slack = kEquallyNear * std::max(std::abs(face.nearness.at(c.at)),
                                                 std::abs(other.nearness.at(c.at)));
    before = before || h > slack;
    behind = behind || h < -slack;
  }
  if (before && behind) return Order::Crossing;
  if (!before && !behind) return Order::Same;
  return before ? Order::Before : Order::Behind;
}

bool wins_tie(const SeenFace& a, const SeenFace& b) {
  if (a.is_pane != b.is_pane) return a.is_pane;
  if (a.is_mirror != b.is_mirror) return a.is_mirror;
  return a.face < b.face;
}

/// Places where `ahead` is zero, positive where it is.
WindowLine line_of(const Nearness& ahead) {
  const double size = std::hypot(ahead.by_u, ahead.by_v);
  return {ahead.by_u / size, ahead.by_v / size, ahead.at_origin / size};
}

/// Where in a list an edge is.
struct EdgeAt {
  std::size_t face, edge;
};

class Divider {
 public:
  explicit Divider(const DivisionOptions& options) : options_(options) {}

  void divide(WindowPolygon window, std::vector<SeenFace> faces, std::optional<SeenFace> ground) {
    while (parts_.size() <= options_.most_parts && work_ <= options_.most_work) {
      take_covering(faces, ground);
      if (is_decided(faces, ground)) return add(window, faces, ground);
      const EdgeAt at = best_edge(faces);
      const WindowLine line = faces[at.face].outline.corners()[at.edge].edge;
      WindowPolygon left = window.cut(line, options_.slack, false);
      WindowPolygon right = window.cut(line.reversed(), options_.slack, false);
      if (left.empty() || right.empty()) {  // the edge runs along the border
        faces[at.face].outline.disown(at.edge);
        if (left.empty()) faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(at.face));
        continue;
      }
      divide(std::move(left), cut_all(faces, line), ground);
      window = std::move(right);
      faces = cut_all(faces, line.reversed());
    }
  }

  Division result() && { return {std::move(parts_), work_}; }

 private:
  std::vector<SeenFace> cut_all(const std::vector<SeenFace>& faces, const WindowLine& line) {
    work_ += faces.size();
    std::vector<SeenFace> kept;
    for (const SeenFace& face : faces) {
      WindowPolygon outline = face.outline.cut(line, options_.slack, false);
      if (outline.empty()) continue;
      kept.push_back({face.face, face.is_mirror, face.nearness, std::move(outline), face.is_pane});
    }
    return kept;
  }

  /// Makes what covers the window its ground, and drops what is hidden by the ground.
  void take_covering(std::vector<SeenFace>& faces, std::optional<SeenFace>& ground) const {
    for (;;) {
      const auto covering = std::find_if(faces.begin(), faces.end(), [](const SeenFace& face) {
        return !face.outline.has_own_edge();
      });
      if (covering == faces.end()) return;
      const SeenFace found = std::move(*covering);
      faces.erase(covering);
      if (ground) {
        // What is left in the list was compared with the ground: this is before it, or they cross.
        const Order order = order_of(found, *ground);
        if (order == Order::Behind || (order == Order::Same && wins_tie(*ground, found))) continue;
        if (order == Order::Crossing) {
          SeenFace part = found;
          part.outline =
              part.outline.cut(line_of(found.nearness - ground->nearness), options_.slack, true);
          if (part.outline.has_own_edge()) {
            faces.push_back(std::move(part));
            continue;
          }
          if (part.outline.empty()) continue;
        }
      }
      ground = found;
      drop_hidden(faces, *ground);
    }
  }

  void drop_hidden(std::vector<SeenFace>& faces, const SeenFace& ground) const {
    std::erase_if(faces, [&](SeenFace& face) {
      const Order order = order_of(face, ground);
      if (order == Order::Crossing) {
        face.outline =
            face.outline.cut(line_of(face.nearness - ground.nearness), options_.slack, true);
        return face.outline.empty();
      }
      return order == Order::Behind || (order == Order::Same && wins_tie(ground, face));
    });
  }

  static bool any_mirror(const std::vector<SeenFace>& faces) {
    return std::any_of(faces.begin(), faces.end(), [](const SeenFace& f) { return f.is_mirror; });
  }

  bool is_decided(const std::vector<SeenFace>& faces, const std::optional<SeenFace>& ground) const {
    if (faces.empty()) return true;
    return !options_.divide_others && !any_mirror(faces) && !(ground && ground->is_mirror);
  }

  void add(const WindowPolygon& window, const std::vector<SeenFace>& faces,
           const std::optional<SeenFace>& ground) {
    std::uint32_t face = ground ? ground->face : kNoFace;
    const bool is_other = ground ? !ground->is_mirror : !faces.empty();
    if (is_other && !options_.divide_others) face = kUndivided;
    parts_.push_back({window.points(), face});
  }

  /// The edge to cut along: of few tried the one that parts the list best. Edges of mirrors come
  /// first where others are not to be told apart.
  EdgeAt best_edge(const std::vector<SeenFace>& faces) {
    std::vector<EdgeAt> edges;
    const bool mirrors_only = !options_.divide_others && any_mirror(faces);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if (mirrors_only && !faces[f].is_mirror) continue;
      for (std::size_t e = 0; e < faces[f].outline.size(); ++e) {
        if (faces[f].outline.corners()[e].is_own) edges.push_back({f, e});
      }
    }
    EdgeAt best = edges.front();
    if (faces.size() <= 2) return best;
    double least = std::numeric_limits<double>::infinity();
    const std::size_t step = std::max<std::size_t>(1, edges.size() / kLinesTried);
    for (std::size_t k = step / 2; k < edges.size(); k += step) {
      const double cost = cost_of(faces, edges[k]);
      if (cost < least) least = cost, best = edges[k];
    }
    return best;
  }

  double cost_of(const std::vector<SeenFace>& faces, EdgeAt at) {
    work_ += faces.size();
    const WindowLine line = faces[at.face].outline.corners()[at.edge].edge;
    double left = 0.0, right = 0.0;
    for (const SeenFace& face : faces) {
      bool is_left = false, is_right = false;
      for (const WindowPolygon::Corner& c : face.outline.corners()) {
        const double h = line.height(c.at);
        is_left = is_left || h > options_.slack;
        is_right = is_right || h < -options_.slack;
      }
      left += is_left, right += is_right;
    }
    constexpr double kCutCost = 2.0;
    const double cut = left + right - static_cast<double>(faces.size());
    return std::max(left, right) + kCutCost * cut;
  }

  const DivisionOptions& options_;
  std::vector<WindowPart> parts_;
  std::uint64_t work_ = 0;
};

}  // namespace

Division divide_window(const WindowPolygon& window, std::vector<SeenFace> faces,
                       const DivisionOptions& options) {
  Divider divider(options);
  divider.divide(window, std::move(faces), std::nullopt);
  return std::move(divider).result();
}

}  // namespace tenku
