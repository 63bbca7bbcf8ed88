// Cells of what comes in: scene files and times.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "stability/cell_runs.h"

namespace tenku::stability {
namespace {

using nlohmann::json;

json inspected(const fs::path& folder, const Quads& quads, const std::string& more = {}) {
  write_text(folder / "s.obj", obj_text(quads));
  const ProgramRun run = run_tenku("inspect s.obj --json" + more, folder);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return run.exit_code == 0 ? json::parse(run.out) : json();
}

Outcome finding(const json& summary, const std::string& code) {
  for (const json& f : summary.at("findings")) {
    if (f.at("code") != code) continue;
    EXPECT_FALSE(f.at("object").get<std::string>().empty());
    EXPECT_FALSE(f.at("where").get<std::string>().empty());
    return {"told", "`" + code + "`"};
  }
  ADD_FAILURE() << code << " in " << summary.at("findings").dump(1);
  return {"WRONG", ""};
}

Outcome triangles_kept(const fs::path& folder, const Quads& quads, std::size_t count) {
  const json summary = inspected(folder, quads);
  EXPECT_EQ(summary.at("triangles"), count);
  return {"right", fmt::format("{} triangles, none lost", count)};
}

/// A block drawn in millimetres is 20 km wide.
Outcome millimetres(const fs::path& folder) {
  return finding(inspected(folder, moved(block_on_ground(), 1000.0)), "unlikely_size");
}

Outcome no_area(const fs::path& folder) {
  Quads quads = block_on_ground();
  quads.push_back({"window", {{{0, 0, 1}, {1, 0, 1}, {2, 0, 1}, {3, 0, 1}}}});
  return finding(inspected(folder, quads), "zero_area_face");
}

json sun(const fs::path& folder, const std::string& options) {
  const ProgramRun run = run_tenku("sun --json --quiet " + options, folder);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return run.exit_code == 0 ? json::parse(run.out)
                            : json{{"altitude_deg", 1e9}, {"declination_deg", -1e9}};
}

/// At the poles the sun's altitude is its declination, but for its parallax of 0.0025 degrees.
Outcome poles(const fs::path& folder) {
  for (const char* pole : {"90", "-90"}) {
    const json at =
        sun(folder, std::string("--no-refraction --lon 0 --time 2026-06-21T12:00Z --lat=") + pole);
    const double sign = pole[0] == '-' ? -1.0 : 1.0;
    EXPECT_NEAR(at["altitude_deg"].get<double>(), sign * 23.4365, 0.004) << pole;
  }
  return {"right", "solstice: altitude of the obliquity, 23.44 degrees"};
}

/// 180 degrees east and west are one meridian.
Outcome date_line(const fs::path& folder) {
  const std::string time = " --lat 10 --time 2026-03-05T23:30Z";
  const json east = sun(folder, "--lon 180" + time), west = sun(folder, "--lon=-180" + time);
  EXPECT_NEAR(east["altitude_deg"].get<double>(), west["altitude_deg"].get<double>(), 1e-9);
  const json zone = sun(folder, "--lon 180 --lat 10 --time 2026-03-06T12:30+13:00");
  EXPECT_NEAR(zone["altitude_deg"].get<double>(), east["altitude_deg"].get<double>(), 1e-9);
  // 23:30 UTC at the date line: 11.5 h by the mean sun, whose equation of time is -11.6 minutes:
  // 41.6 minutes before noon, an hour angle of -10.4 degrees; declination -5.8 degrees.
  const double rad = kPi / 180.0, declination = east["declination_deg"].get<double>() * rad;
  const double hour = (23.5 * 15.0 - 180.0 - 180.0 + 180.0 - 180.0 +
                       east["equation_of_time_min"].get<double>() / 4.0) *
                      rad;
  const double truth = std::asin(std::sin(10 * rad) * std::sin(declination) +
                                 std::cos(10 * rad) * std::cos(declination) * std::cos(hour)) /
                       rad;
  EXPECT_NEAR(east["altitude_deg"].get<double>(), truth, 0.01);
  return {"right", "the same sun by either sign and either date"};
}

/// The second that was put in moves the sun by a second's turn and no more.
Outcome leap_second(const fs::path& folder) {
  const std::string place = "--lat 0 --lon 90 --no-refraction --time ";
  const double before = sun(folder, place + "2016-12-31T23:59:59Z")["altitude_deg"],
               leap = sun(folder, place + "2016-12-31T23:59:60Z")["altitude_deg"],
               after = sun(folder, place + "2017-01-01T00:00:00Z")["altitude_deg"];
  const double turn = (after - before) / 2.0;  // two seconds passed
  EXPECT_NEAR(std::abs(turn), 15.0 / 3600.0 * std::cos(23.0 * kPi / 180.0), 3e-4);
  EXPECT_NEAR(leap - before, turn, 1e-5);
  return refused(run_tenku("sun " + place + "2015-12-31T23:59:60Z", folder), "60").kind == "refused"
             ? Outcome{"right", "a second of its own; refused on days without one"}
             : Outcome{};
}

Outcome daylight_saving(const fs::path& folder) {
  const std::string place = "sun --lat 52 --lon 13 --zone Europe/Berlin --time ";
  refused(run_tenku(place + "2026-03-29T02:30", folder), "2026-03-29");
  return refused(run_tenku(place + "2026-10-25T02:30", folder), "2026-10-25");
}

/// At the equinox on the equator the sun passes the zenith within the equation of time.
Outcome zenith(const fs::path& folder) {
  const json noon = sun(folder, "--lat 0 --lon 0 --no-refraction --time 2026-03-20T12:07:30Z");
  EXPECT_GT(noon["altitude_deg"].get<double>(), 89.7);
  return {"right", "the zenith on the equator at the equinox"};
}

Outcome half_set(const fs::path& folder) {
  const json set = sun(folder, "--lat 0 --lon 0 --time 2026-03-20T18:10:30Z");
  // Refraction at the horizon: 29 to 35 minutes of arc (Bennett 1982; 34 by convention).
  const double lift =
      set["apparent_altitude_deg"].get<double>() - set["altitude_deg"].get<double>();
  if (std::abs(set["apparent_altitude_deg"].get<double>()) < 0.5) {
    EXPECT_GT(lift, 0.4);
    EXPECT_LT(lift, 0.7);
  }
  return {"right", "refraction of 24 to 42 minutes of arc on the horizon"};
}

}  // namespace

std::vector<Cell> input_cells() {
  return {
      {"readers", "units", millimetres},
      {"readers", "zero_window", no_area},
      {"readers", "coplanar",
       [](const fs::path& f) {
         return finding(inspected(f, twice(block_on_ground())), "coincident_faces");
       }},
      {"readers", "duplicated",
       [](const fs::path& f) {
         return finding(inspected(f, twice(block_on_ground())), "coincident_faces");
       }},
      {"readers", "slivers",
       [](const fs::path& f) { return triangles_kept(f, with_slivers(block_on_ground()), 56); }},
      {"readers", "inverted",
       [](const fs::path& f) { return triangles_kept(f, inverted(block_on_ground()), 14); }},
      {"readers", "offset",
       [](const fs::path& f) {
         return triangles_kept(f, moved(block_on_ground(), 1, {1e7, 1e7, 0}), 14);
       }},
      {"readers", "one_triangle",
       [](const fs::path& f) {
         write_text(f / "s.obj", "o t\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
         const ProgramRun run = run_tenku("inspect s.obj --json", f);
         EXPECT_EQ(json::parse(run.out).at("triangles"), 1);
         return Outcome{"right", "one triangle"};
       }},
      {"sun_position", "poles", poles},
      {"sun_position", "date_line", date_line},
      {"sun_position", "leap_second", leap_second},
      {"sun_position", "daylight_saving", daylight_saving},
      {"sun_position", "sun_high", zenith},
      {"sun_position", "sun_low", half_set},
  };
}

}  // namespace tenku::stability
