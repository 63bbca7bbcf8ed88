/// Scenes of quadrilaterals whose light is known in closed form, and what can be wrong with them.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/units.h"
#include "core/vec3.h"

namespace tenku::stability {

struct Quad {
  std::string object;
  std::array<Vec3, 4> corner;
};

using Quads = std::vector<Quad>;

/// Faces that look outward from the box, or inward.
inline Quads box(const std::string& object, Vec3 a, Vec3 b, bool inward = false) {
  const std::array<Vec3, 8> v{{{a.x, a.y, a.z},
                               {b.x, a.y, a.z},
                               {b.x, b.y, a.z},
                               {a.x, b.y, a.z},
                               {a.x, a.y, b.z},
                               {b.x, a.y, b.z},
                               {b.x, b.y, b.z},
                               {a.x, b.y, b.z}}};
  Quads quads;
  for (const std::array<std::size_t, 4>& f : {std::array<std::size_t, 4>{3, 2, 1, 0},
                                              {4, 5, 6, 7},
                                              {0, 1, 5, 4},
                                              {1, 2, 6, 5},
                                              {2, 3, 7, 6},
                                              {3, 0, 4, 7}}) {
    quads.push_back({object, {v[f[0]], v[f[1]], v[f[2]], v[f[3]]}});
    if (inward) std::swap(quads.back().corner[1], quads.back().corner[3]);
  }
  return quads;
}

inline Quads& append(Quads& quads, const Quads& more) {
  quads.insert(quads.end(), more.begin(), more.end());
  return quads;
}

/// A block of 20 x 10 x 9 m on the ground, and 120 m of ground.
inline Quads block_on_ground() {
  Quads quads = box("block", {-10, 0, 0}, {10, 10, 9});
  append(quads, {{"ground", {{{-60, -60, 0}, {60, -60, 0}, {60, 60, 0}, {-60, 60, 0}}}}});
  return quads;
}

/// Room of 4 x 5 x 3 m whose faces look inward.
inline Quads room() { return box("room", {0, 0, 0}, {4, 5, 3}, true); }

/// The block with a face in the plane of its front.
inline Quads with_poster() {
  Quads quads = block_on_ground();
  quads.push_back({"poster", {{{-5, 0, 1}, {5, 0, 1}, {5, 0, 8}, {-5, 0, 8}}}});
  return quads;
}

/// With another that reaches through its back and the ground, hidden from the front.
inline Quads crossed() {
  Quads quads = block_on_ground();
  return append(quads, box("crossing", {-9, 0.5, -2}, {9, 14, 8.5}));
}

inline Quads without_its_back() {
  Quads quads = block_on_ground();
  quads.erase(quads.begin() + 4);  // the face at y = 10
  quads.erase(quads.begin());      // the bottom
  return quads;
}

inline Quads with_a_face_of_no_area() {
  Quads quads = block_on_ground();
  quads.push_back({"window", {{{-5, -1, 1}, {5, -1, 1}, {5, -1, 1}, {-5, -1, 1}}}});
  return quads;
}

inline Quads moved(Quads quads, double scale, Vec3 by = {}) {
  for (Quad& quad : quads) {
    for (Vec3& v : quad.corner) v = scale * v + by;
  }
  return quads;
}

inline Quads inverted(Quads quads) {
  for (Quad& quad : quads) std::swap(quad.corner[1], quad.corner[3]);
  return quads;
}

inline Quads twice(Quads quads) {
  const Quads once = quads;
  for (Quad quad : once) {
    quad.object += "_again";
    quads.push_back(quad);
  }
  return quads;
}

/// Each face cut into strips, of which two are a ten-thousandth of its width.
inline Quads with_slivers(const Quads& quads) {
  Quads result;
  for (const Quad& quad : quads) {
    const auto& c = quad.corner;
    const auto at = [&](double t, std::size_t a, std::size_t b) {
      return c[a] + t * (c[b] - c[a]);
    };
    const std::array<double, 5> cut{0.0, 0.0001, 0.5, 0.5001, 1.0};
    for (std::size_t k = 0; k + 1 < cut.size(); ++k) {
      result.push_back(
          {quad.object,
           {at(cut[k], 0, 1), at(cut[k + 1], 0, 1), at(cut[k + 1], 3, 2), at(cut[k], 3, 2)}});
    }
  }
  return result;
}

inline std::string obj_text(const Quads& quads) {
  std::string text, object;
  for (const Quad& quad : quads) {
    if (quad.object != object) text += "o " + (object = quad.object) + "\n";
    for (const Vec3& v : quad.corner) text += fmt::format("v {} {} {}\n", v.x, v.y, v.z);
    text += "f -4 -3 -2 -1\n";
  }
  return text;
}

/// Sensors and what each must receive.
struct Probe {
  Vec3 position, normal;
  double truth_lux = 0.0;
};

inline std::string probe_lines(const std::vector<Probe>& probes, double scale = 1.0, Vec3 by = {}) {
  std::string lines;
  for (const Probe& probe : probes) {
    const Vec3 p = scale * probe.position + by, n = probe.normal;
    lines += fmt::format("{} {} {} {} {} {}\n", p.x, p.y, p.z, n.x, n.y, n.z);
  }
  return lines;
}

constexpr double kOpenSky_lux = 10'000.0;

/// What a level point before the block receives from a uniform sky: what its front hides is
/// missing. Source  J. R. Howell, "A Catalog of Radiation Heat Transfer Configuration Factors",
/// B-4.
inline double before_the_block_lux(Vec3 p) {
  constexpr double kHeight = 9.0;
  const double distance = -p.y, slant = std::hypot(kHeight, distance);
  const auto hidden = [&](double width) {
    return (std::atan2(width, distance) - distance / slant * std::atan2(width, slant)) /
           (2.0 * kPi);
  };
  return kOpenSky_lux * (1.0 - hidden(10.0 - p.x) - hidden(10.0 + p.x));
}

/// Twenty level sensors on the ground before the block, in the light of the sky.
inline std::vector<Probe> before_the_block() {
  std::vector<Probe> probes;
  for (int k = 0; k < 20; ++k) {
    const Vec3 p{7.0 * std::sin(3.7 * k), -0.5 - 1.3 * k, 0.0};
    probes.push_back({p, kZenith, before_the_block_lux(p)});
  }
  return probes;
}

}  // namespace tenku::stability
