// Cells of reflected light: a closed room whose walls shine evenly, where every sensor receives
// emission / (1 - reflectance) wherever it is and however it is turned.
#include <gtest/gtest.h>

#include "stability/cell_runs.h"

namespace tenku::stability {
namespace {

struct Method {
  std::string name, command;
};

const std::vector<Method>& room_methods() {
  static const std::vector<Method> kMethods{
      {"paths", "illuminance s.obj --reflection paths --bounces 12"},
      {"radiosity", ""},
      {"meshes", ""},
  };
  return kMethods;
}

std::vector<Probe> in_the_room() {
  return {{{1, 1, 1}, {0, 0, 1}}, {{2, 3, 2}, {1, 0, 0}}, {{3.5, 4, 0.4}, {-1, -2, 1}}};
}

std::vector<Probe> on_edges_of_the_room() {
  return {{{0, 0, 1.3}, {1, 1, 0}}, {{0, 0, 0}, {1, 1, 1}}, {{4, 5, 3}, {-1, -1, -1}}};
}

/// At the foot of walls: on which side of them, only rounding tells.
std::vector<Probe> on_feet_of_walls() {
  return {{{2, 2, 0}, {0, 0, 1}}, {{2, 0, 0}, {0, 0, 1}}, {{0, 0, 0}, {0, 0, 1}}};
}

std::vector<Probe> off_walls_of_the_room() {
  return {{{1e-6, 2, 1}, {1, 0, 0}},
          {{2, 1e-6, 1}, {0, 0, 1}},
          {{1, 1, 1e-6}, {0, 0, 1}},
          {{1e-6, 1e-6, 1e-6}, {1, 1, 1}}};
}

struct Case {
  Quads quads = room();
  std::vector<Probe> probes = in_the_room();
  double scale = 1.0;
  Vec3 by{};
  double reflectance = 0.5;
  std::string more = {};
};

ProgramRun run_room(const fs::path& folder, const std::string& command, const Case& c) {
  write_text(folder / "s.obj", obj_text(moved(c.quads, c.scale, c.by)));
  write_text(folder / "s.pts", probe_lines(c.probes, c.scale, c.by));
  std::string materials;
  for (std::vector<std::string> seen; const Quad& quad : c.quads) {
    if (std::find(seen.begin(), seen.end(), quad.object) != seen.end()) continue;
    seen.push_back(quad.object);
    materials +=
        fmt::format("[{}]\nreflectance = {}\nemission_lm_m2 = 100\n", quad.object, c.reflectance);
  }
  write_text(folder / "s.toml", materials);
  return run_tenku(command + " --materials s.toml --sky none --sensors s.pts --out o.csv" + c.more,
                   folder);
}

/// Lengths in options follow the scale of the room.
std::vector<std::string> commands(const Method& method, double scale) {
  if (method.name == "paths") return {method.command};
  const std::string sizes =
      fmt::format(" --tolerance 10 --size-max {} --patch-size {}", 2.0 * scale, 4.0 * scale);
  if (method.name == "radiosity") return {"radiosity s.obj" + sizes};
  return {"radiosity s.obj --mesh uniform" + sizes,
          "radiosity s.obj --mesh refine --rounds 1" + sizes,
          "radiosity s.obj --mesh bubble --rounds 1" + sizes};
}

/// Paths end before the light does: the rest is estimated, in the interval, and told.
Outcome bright_by_paths(const fs::path& folder, const Method& method, const Case& c) {
  const ProgramRun run = run_room(folder, method.command, c);
  expect_done(run);
  const ReferenceTable lit((folder / "o.csv").string());
  for (std::size_t i = 0; i < lit.size(); ++i) {
    const double off = 100.0 / (1.0 - c.reflectance) - lit.number(i, "total_lux");
    EXPECT_LE(std::abs(off), 1.05 * lit.number(i, "error_lux"));  // chance, in the last order
  }
  return told(run, "tolerance_not_reached", "sensors");
}

Outcome furnace(const fs::path& folder, const Method& method, Case c) {
  if (method.name == "paths" && c.reflectance > 0.95) return bright_by_paths(folder, method, c);
  for (Probe& p : c.probes) p.truth_lux = 100.0 / (1.0 - c.reflectance);
  Outcome outcome;
  for (const std::string& command : commands(method, c.scale)) {
    SCOPED_TRACE(command);
    const ProgramRun run = run_room(folder, command, c);
    expect_done(run);
    if (run.exit_code != 0 && run.exit_code != 3) return {"WRONG", ""};
    outcome = holds(folder / "o.csv", c.probes, 0.01);
  }
  return outcome;
}

Outcome on_edges(const fs::path& folder, const Method& method) {
  Case c;
  c.probes = on_edges_of_the_room();
  furnace(folder, method, c);
  c.probes = on_feet_of_walls();
  for (const std::string& command : commands(method, c.scale)) {
    SCOPED_TRACE(command);
    const ProgramRun run = run_room(folder, command, c);
    expect_done(run);
    told(run, "2 x sensor_on_edge", "sensor 2");
  }
  return {"told", "right where the normal tells the side; else `sensor_on_edge`"};
}

Outcome scales(const fs::path& folder, const Method& method) {
  Outcome outcome;
  for (const double scale : {1e-3, 1e3, 1e5}) {
    SCOPED_TRACE(scale);
    Case c;
    c.scale = scale;
    outcome = furnace(folder, method, c);
  }
  return outcome;
}

Outcome threads(const fs::path& folder, const Method& method) {
  std::string first;
  for (const int count : {1, 2, 8}) {
    Case c;
    c.more = fmt::format(" --threads {}", count);
    furnace(folder, method, c);
    const std::string table = testing_support::contents_of(folder / "o.csv");
    if (first.empty()) first = table;
    EXPECT_EQ(table, first) << count;
  }
  return {"right", "the same bits with 1, 2 and 8 threads"};
}

/// Outside of the room nothing shines on what lies inside a closed block.
Outcome inside_solid(const fs::path& folder, const Method& method) {
  Case c;
  append(c.quads, box("block", {1.5, 1.5, 0.5}, {2.5, 2.5, 1.5}));
  c.probes = {{{1, 1, 1}, {0, 0, 1}}, {{3, 3, 1}, {1, 0, 0}}, {{2, 2, 1}, {0, 0, 1}}};
  // Within the block its own faces shine as evenly as the room: materials have two sides.
  return furnace(folder, method, c);
}

Case with(const Quads& quads) {
  Case c;
  c.quads = quads;
  return c;
}

Case crossed_room() {
  Case c;
  append(c.quads, box("crossing", {3, -1, -1}, {6, 1, 1}));
  return c;
}

/// Elements across the cut hold light of both its sides: within 1 %, and told.
Outcome intersecting(const fs::path& folder, const Method& method) {
  Case c = crossed_room();
  if (method.name == "paths") return furnace(folder, method, c);
  double worst = 0.0;
  for (const std::string& command : commands(method, c.scale)) {
    SCOPED_TRACE(command);
    const ProgramRun run = run_room(folder, command, c);
    expect_done(run);
    told(run, "faces_cross", "crossing");
    const ReferenceTable lit((folder / "o.csv").string());
    for (std::size_t i = 0; i < lit.size(); ++i) {
      worst = std::max(worst, std::abs(lit.number(i, "total_lux") - 200.0));
    }
  }
  EXPECT_LE(worst, 2.0);
  return {"told", fmt::format("`faces_cross`; {:.2g} of 200 lx off", worst)};
}

Case coplanar() {
  Case c;
  c.quads.push_back({"carpet", {{{1, 1, 0}, {3, 1, 0}, {3, 4, 0}, {1, 4, 0}}}});
  return c;
}

Case zero_window() {
  Case c;
  c.quads.push_back({"window", {{{0, 1, 1}, {0, 1, 2}, {0, 1, 2}, {0, 1, 1}}}});
  return c;
}

/// In the middle of walls that are divided at their middles: rays meet common edges.
Case at_the_centre() {
  Case c = with(with_slivers(room()));
  c.probes = {{{2, 2.5, 1.5}, {0, 0, 1}}, {{2, 2.5, 1.5}, {1, 0, 0}}, {{2, 2.5, 0}, {0, 0, 1}}};
  return c;
}

/// A triangle that shines on a sensor below it.
/// Source  J. H. Lambert, "Photometria", 1760: sum over its edges of their angle times the cosine.
Outcome one_triangle(const fs::path& folder, const Method& method) {
  const std::array<Vec3, 3> v{{{0, 0, 2}, {3, 0, 2}, {0, 3, 2}}};
  const Vec3 p{0.5, 0.7, 0};
  double sum = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 a = v[k] - p, b = v[(k + 1) % 3] - p, across = cross(a, b);
    sum += across.z / length(across) * std::atan2(length(across), dot(a, b));
  }
  write_text(folder / "s.obj", "o t\nv 0 0 2\nv 3 0 2\nv 0 3 2\nf 1 2 3\n");
  write_text(folder / "s.toml", "[t]\nreflectance = 0\nemission_lm_m2 = 100\n");
  const std::vector<Probe> probes{{p, kZenith, 100.0 * std::abs(sum) / (2.0 * kPi)}};
  write_text(folder / "s.pts", probe_lines(probes));
  Outcome outcome;
  for (const std::string& command : commands(method, 1.0)) {
    expect_done(
        run_tenku(command + " --materials s.toml --sky none --sensors s.pts --out o.csv", folder));
    outcome = holds(folder / "o.csv", probes, 0.01);
  }
  return outcome;
}

}  // namespace

std::vector<Cell> room_cells() {
  Case off, far, bright;
  off.probes = off_walls_of_the_room();
  far.by = {1e7, -1e7, 0};
  bright.reflectance = 0.99;
  const std::vector<std::pair<std::string, Case>> cases{
      {"off_wall", off},
      {"coplanar", coplanar()},
      {"slivers", with(with_slivers(room()))},
      {"inverted", with(inverted(room()))},
      {"duplicated", with(twice(room()))},
      {"offset", far},
      {"zero_window", zero_window()},
      {"ray_edges", at_the_centre()},
      {"bright", bright},
  };
  std::vector<Cell> cells;
  for (const Method& method : room_methods()) {
    for (const auto& [hazard, c] : cases) {
      cells.push_back({method.name, hazard, [method, c = c](const fs::path& folder) {
                         return furnace(folder, method, c);
                       }});
    }
    cells.push_back({method.name, "intersecting",
                     [method](const fs::path& f) { return intersecting(f, method); }});
    cells.push_back(
        {method.name, "on_edges", [method](const fs::path& f) { return on_edges(f, method); }});
    cells.push_back(
        {method.name, "scale", [method](const fs::path& f) { return scales(f, method); }});
    cells.push_back(
        {method.name, "threads", [method](const fs::path& f) { return threads(f, method); }});
    cells.push_back({method.name, "one_triangle",
                     [method](const fs::path& f) { return one_triangle(f, method); }});
    cells.push_back({method.name, "inside_solid",
                     [method](const fs::path& f) { return inside_solid(f, method); }});
  }
  return cells;
}

}  // namespace tenku::stability
