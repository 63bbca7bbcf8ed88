/// Small scenes for the tests of the program.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace tenku::testing_support {

inline void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// A closed box of 2 m, centred on the origin, on a floor of 40 m at z = -2.
inline const char* const kBoxScene =
    "o box\n"
    "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
    "f 5 6 7 8\nf 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
    "o floor\nv -20 -20 -2\nv 20 -20 -2\nv 20 20 -2\nv -20 20 -2\nf 9 10 11 12\n";

/// `box.obj`, `open.pts` (a sensor in the open), a sky of 10,000 lx.
inline void write_box_scene(const std::filesystem::path& folder) {
  write_text(folder / "box.obj", kBoxScene);
  write_text(folder / "open.pts", "10 10 0 0 0 1\n");
}

inline const std::string kSky = " --sky uniform --sky-illuminance 10000";

/// The rest of a study: a sun, a sky and a view.
inline const std::string kSun =
    "[sun]\naltitude_deg = 40\nazimuth_deg = 180\n[sky]\nmodel = \"cie:12\"\n[[view]]\n";

}  // namespace tenku::testing_support
