// Cells of what asks for the sky and the sun: rays, shadow maps, elements of the sky, the disc.
#include <gtest/gtest.h>

#include "stability/cell_runs.h"

namespace tenku::stability {
namespace {

/// A method of direct light, and the options that choose it.
struct Light {
  std::string name, options;
  bool by_sun = false;
};

const std::string kUniform = " --sky uniform --sky-illuminance 10000 --sun-illuminance 0";

const std::vector<Light>& lights() {
  static const std::vector<Light> kLights{
      {"rays", " --engine rays" + kUniform},
      {"shadow_maps", " --engine shadow-maps --gl osmesa" + kUniform},
      {"sky_elements", " --engine rays --partition reinhart:4" + kUniform},
      {"sun_disc",
       " --engine rays --sky none --sun-illuminance 50000 --sun-altitude 40 --sun-azimuth 0", true},
  };
  return kLights;
}

/// The light of a high sun on the ground before the block: its shadow is 9 m / tan(40 deg) long.
std::vector<Probe> expected(const Light& light, std::vector<Probe> probes = before_the_block()) {
  if (!light.by_sun) return probes;
  const double altitude = 40.0 * kPi / 180.0, shadow = 9.0 / std::tan(altitude);
  std::erase_if(probes, [&](const Probe& p) { return std::abs(-p.position.y - shadow) < 0.3; });
  for (Probe& p : probes) {
    p.truth_lux = -p.position.y < shadow ? 0.0 : 50'000.0 * std::sin(altitude);
  }
  return probes;
}

ProgramRun light_up(const fs::path& folder, const Light& light, const Quads& quads,
                    const std::string& sensors, const std::string& more = {}) {
  write_text(folder / "s.obj", obj_text(quads));
  write_text(folder / "s.pts", sensors);
  return run_tenku(
      "illuminance s.obj --sensors s.pts --bounces 0 --out o.csv" + light.options + more, folder);
}

/// The block and its sensors, changed in a way that leaves their light as it is.
Outcome as_before(const fs::path& folder, const Light& light, const Quads& quads,
                  double scale = 1.0, Vec3 by = {}, const std::string& more = {}) {
  const std::vector<Probe> probes = expected(light);
  const ProgramRun run =
      light_up(folder, light, moved(quads, scale, by), probe_lines(probes, scale, by), more);
  expect_done(run);
  if (run.exit_code != 0 && run.exit_code != 3) return {"WRONG", ""};
  return holds(folder / "o.csv", probes, light.by_sun ? 2.0 : 1.5);
}

Outcome open_to_sky(const fs::path& folder, const Light& light, const std::vector<Probe>& probes,
                    const Quads& quads = block_on_ground()) {
  std::vector<Probe> lit = probes;
  for (Probe& p : lit) {
    if (light.by_sun) p.truth_lux *= 50'000.0 * std::sin(40.0 * kPi / 180.0) / kOpenSky_lux;
  }
  expect_done(light_up(folder, light, quads, probe_lines(lit)));
  return holds(folder / "o.csv", lit, 2.0);
}

/// On the upper edges and corners of the block everything above is open.
Outcome on_edges(const fs::path& folder, const Light& light) {
  return open_to_sky(folder, light,
                     {{{10, 0, 9}, kZenith, kOpenSky_lux},
                      {{-10, 10, 9}, kZenith, kOpenSky_lux},
                      {{3, 0, 9}, kZenith, kOpenSky_lux},
                      {{10, 4, 9}, kZenith, kOpenSky_lux},
                      {{10, 10, 9}, kZenith, kOpenSky_lux}});
}

/// At the foot of the front half of the sky is hidden; the sun behind the block all of it.
Outcome off_wall(const fs::path& folder, const Light& light) {
  std::vector<Probe> probes;
  for (const double x : {-7.0, -1.0, 0.0, 3.3, 6.0}) {
    probes.push_back({{x, -1e-6, 0}, kZenith, light.by_sun ? 0.0 : kOpenSky_lux / 2.0});
    probes.push_back({{x, -1e-6, 2}, kZenith, light.by_sun ? 0.0 : kOpenSky_lux / 2.0});
  }
  return open_to_sky(folder, light, probes);
}

Outcome inside_solid(const fs::path& folder, const Light& light) {
  const ProgramRun run =
      light_up(folder, light, block_on_ground(), "0 5 4 0 0 1\n0 5 1e-6 0 0 1\n5 9.999 4 0 -1 0\n");
  expect_done(run);
  holds(folder / "o.csv", {{{}, {}, 0.0}, {{}, {}, 0.0}, {{}, {}, 0.0}});
  return light.by_sun ? Outcome{"right", "0 lx"} : told(run, "no_light", "sensor");
}

/// The sun stands exactly over edges and corners of many squares, which together are one roof.
Outcome ray_edges(const fs::path& folder, const Light& light) {
  Quads quads;
  for (int i = -20; i < 20; ++i) {
    for (int j = -20; j < 20; ++j) {
      const double x = 4.0 * i, y = 4.0 * j;
      quads.push_back({"roof", {{{x, y, 1}, {x + 4, y, 1}, {x + 4, y + 4, 1}, {x, y + 4, 1}}}});
    }
  }
  std::vector<Probe> probes;
  for (int k = -5; k < 5; ++k) probes.push_back({{4.0 * k, 4.0 * (k / 2), 0}, kZenith, 0.0});
  const std::string overhead = light.by_sun ? " --sun-altitude 90 --sun-azimuth 0" : "";
  Light above = light;
  if (light.by_sun) above.options = " --engine rays --sky none --sun-illuminance 50000";
  expect_done(light_up(folder, above, quads, probe_lines(probes), overhead));
  // Beyond the roof's edges, 80 m away and 1 m up, lies (1 / 80)^2 of the sky.
  return holds(folder / "o.csv", probes, 1e-3 * kOpenSky_lux);
}

Outcome one_triangle(const fs::path& folder, const Light& light) {
  write_text(folder / "s.obj", "o t\nv -9 0 5\nv 9 0 5\nv 0 9 5\nf 1 2 3\n");
  write_text(folder / "s.pts", "0 -40 6 0 0 1\n20 3 6 0 0 1\n");
  expect_done(run_tenku("illuminance s.obj --sensors s.pts --bounces 0 --out o.csv" + light.options,
                        folder));
  const double lux = light.by_sun ? 50'000.0 * std::sin(40.0 * kPi / 180.0) : kOpenSky_lux;
  return holds(folder / "o.csv", {{{}, {}, lux}, {{}, {}, lux}}, 2.0);
}

Outcome threads(const fs::path& folder, const Light& light) {
  std::string first;
  for (const int count : {1, 2, 3, 8}) {
    as_before(folder, light, block_on_ground(), 1.0, {}, fmt::format(" --threads {}", count));
    const std::string table = testing_support::contents_of(folder / "o.csv");
    if (first.empty()) first = table;
    EXPECT_EQ(table, first) << count;
  }
  return {"right", "the same bits with 1, 2, 3 and 8 threads"};
}

Outcome scales(const fs::path& folder, const Light& light) {
  Outcome worst;
  for (const double scale : {1e-3, 1e-2, 1e2, 1e3}) {
    SCOPED_TRACE(scale);
    worst = as_before(folder, light, block_on_ground(), scale);
  }
  const std::vector<Probe> probes = expected(light);
  const ProgramRun large =
      light_up(folder, light, moved(block_on_ground(), 1e5), probe_lines(probes, 1e5));
  expect_done(large);
  told(large, "far_from_origin", "ground");
  worst.note += "; 1e5: `far_from_origin`";
  return worst;
}

Outcome millions(const fs::path& folder, const Light& light) {
  Quads quads;
  constexpr int kSide = 700;  // 490,000 squares a layer, ten layers: 9.8 million triangles
  for (int layer = 0; layer < 10; ++layer) {
    const double z = -1.0 - layer;
    for (int i = 0; i < kSide * kSide; ++i) {
      const double x = i % kSide - 350, y = i / kSide - 350;
      quads.push_back({"under", {{{x, y, z}, {x + 1, y, z}, {x + 1, y + 1, z}, {x, y + 1, z}}}});
    }
  }
  return as_before(folder, light, append(quads, block_on_ground()));
}

using Test = std::function<Outcome(const fs::path&, const Light&)>;

Test changed(const Quads& quads, double scale = 1.0, Vec3 by = {}, const std::string& more = {}) {
  return [=](const fs::path& folder, const Light& light) {
    return as_before(folder, light, quads, scale, by, more);
  };
}

Outcome low_sun(const fs::path& folder, const Light& light) {
  for (const char* altitude : {"0", "0.1", "-0.1"}) {
    Light low = light;
    low.options = " --engine rays --sky none --sun-illuminance 50000 --sun-azimuth 180";
    const ProgramRun run = light_up(folder, low, block_on_ground(), "0 -20 0 0 0 1\n",
                                    std::string(" --sun-altitude ") + altitude);
    if (run.exit_code == 2) return refused(run, "altitude");
    expect_done(run);
    // The disc's part above the horizon, its radius 0.2666 degrees: sin(altitude) on average.
    const double a = std::stod(altitude) * kPi / 180.0, r = 0.2666 * kPi / 180.0;
    double sum = 0.0;
    for (int k = 0; k < 20'000; ++k) {
      const double t = r * ((k + 0.5) / 10'000.0 - 1.0);
      if (a + t > 0.0) sum += 2.0 * std::sqrt(r * r - t * t) * std::sin(a + t) * (r / 10'000.0);
    }
    SCOPED_TRACE(altitude);
    holds(folder / "o.csv", {{{}, {}, 50'000.0 * sum / (kPi * r * r)}}, 3.0);
  }
  return {"right", "the part of the disc above the horizon; `grazing_sun`"};
}

Outcome high_sun(const fs::path& folder, const std::string& engine) {
  const Light high{"", " --gl osmesa --sky none --sun-illuminance 50000 --engine " + engine, true};
  const ProgramRun run =
      light_up(folder, high, block_on_ground(), "0 -0.5 0 0 0 1\n0 5 9 0 0 1\n0 -30 0 0 0 1\n",
               " --sun-altitude 89.9 --sun-azimuth 180");
  expect_done(run);
  const double lux = 50'000.0 * std::sin(89.9 * kPi / 180.0);
  return holds(folder / "o.csv", {{{}, {}, lux}, {{}, {}, lux}, {{}, {}, lux}}, 2.0);
}

}  // namespace

std::vector<Cell> sky_cells() {
  const std::vector<std::pair<std::string, Test>> tests{
      {"on_edges", on_edges},
      {"off_wall", off_wall},
      {"inside_solid", inside_solid},
      {"ray_edges", ray_edges},
      {"coplanar", changed(with_poster())},
      {"intersecting", changed(crossed())},
      {"slivers", changed(with_slivers(block_on_ground()))},
      {"zero_window", changed(with_a_face_of_no_area())},
      {"open_solid", changed(without_its_back())},
      {"inverted", changed(inverted(block_on_ground()))},
      {"duplicated", changed(twice(block_on_ground()))},
      {"scale", scales},
      {"offset", changed(block_on_ground(), 1.0, {1e7, -1e7, 0})},
      {"one_triangle", one_triangle},
      {"threads", threads},
      {"ten_million", millions},
  };
  std::vector<Cell> cells;
  for (const Light& light : lights()) {
    for (const auto& [hazard, test] : tests) {
      cells.push_back({light.name, hazard, [light, test = test](const fs::path& folder) {
                         return test(folder, light);
                       }});
      cells.back().takes_minutes = hazard == "ten_million";
    }
  }
  const Light sun = lights().back();
  cells.push_back({"sun_disc", "sun_low", [sun](const fs::path& f) { return low_sun(f, sun); }});
  cells.push_back({"sun_disc", "sun_high", [](const fs::path& f) { return high_sun(f, "rays"); }});
  cells.push_back(
      {"shadow_maps", "sun_high", [](const fs::path& f) { return high_sun(f, "shadow-maps"); }});
  return cells;
}

}  // namespace tenku::stability
