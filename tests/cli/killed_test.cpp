// Killed at any moment, the program leaves no half-written file under a final name.
//
// TENKU_KILLS      how many runs are killed (default 52)
// TENKU_KILL_SEED  of the moments (default 1)
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <thread>
#include <vector>

#include "cli/lit_scene_files.h"
#include "core/random.h"
#include "support/long_runs.h"
#include "support/run_program.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;
using namespace testing_support;
using Clock = std::chrono::steady_clock;

const char* const kStudy =
    "[scene]\nfile = \"box.obj\"\n[sun]\naltitude_deg = 40\nazimuth_deg = 180\n"
    "[sky]\nmodel = \"uniform\"\nilluminance_lx = 10000\n[calculation]\ntolerance_percent = 20\n"
    "bounces = 0\n[[view]]\nname = \"view\"\nsize = [24, 16]\nfiles = [\"png\", \"exr\", \"hdr\"]\n"
    "[[sensors]]\nname = \"points\"\nfile = \"open.pts\"\n[report]\ntitle = \"Killed\"\n";

const char* const kPath =
    "frames_per_second = 4\nsize = [24, 16]\n"
    "[[key]]\ntime_s = 0\neye = [6, -6, 3]\ntarget = [0, 0, 0]\n"
    "[[key]]\ntime_s = 1\neye = [7, -4, 3]\ntarget = [0, 0, 0]\n";

/// One of each kind of output, written into the folder `out`.
std::vector<std::string> commands() {
  const std::string grid =
      "illuminance box.obj --grid ground --spacing 8 --tolerance 20 --bounces 0" + kSky + " --out ";
  const std::string view = "render box.obj --size 24x16 --tolerance 20 --bounces 0" + kSky;
  return {grid + "out/a.csv",
          grid + "out/a.vtp",
          grid + "out/a.city.json",
          grid + "out/a.glb",
          view + " --out out/a.png",
          view + " --out out/a.exr",
          view + " --out out/a.hdr",
          "inspect box.obj --repaired out/a.city.json",
          "radiosity box.obj --elements-max 200 --out out/a.vtp" + kSky,
          "reflections m.obj --materials m.toml --sun-altitude 40 --sun-azimuth 170 "
          "--sun-illuminance 50000 --out out/a.geojson",
          "flythrough box.obj --path p.toml --tolerance 20 --bounces 0 --out out/a.tkpts" + kSky,
          "run s.toml --out out",
          "chart box.obj --stage sky --out out" + kSky};
}

void write_inputs(const fs::path& folder) {
  write_box_scene(folder);
  write_text(folder / "m.obj",
             "o ground\nv -60 -60 0\nv 60 -60 0\nv 60 60 0\nv -60 60 0\nf 1 2 3 4\n"
             "o mirror\nv -1 0 2\nv 1 0 2\nv 1 0 5\nv -1 0 5\nf 5 6 7 8\n");
  write_text(folder / "m.toml", "[mirror]\nmirror = 1.0\n");
  write_text(folder / "p.toml", kPath);
  write_text(folder / "s.toml", kStudy);
}

/// The program, started without a shell, so that the signal reaches it.
pid_t start_tenku(const std::string& arguments, const fs::path& folder) {
  std::istringstream blanks(arguments + " --quiet");
  std::vector<std::string> words{TENKU_PROGRAM};
  for (std::string word; blanks >> word;) words.push_back(word);
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t child = fork();
  if (child != 0) return child;
  if (chdir(folder.c_str()) != 0 || std::freopen("said.out", "w", stdout) == nullptr ||
      std::freopen("said.err", "w", stderr) == nullptr) {
    _exit(127);
  }
  execv(pointers.front(), pointers.data());
  _exit(127);
}

bool is_aside(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with(".partial-") || name.ends_with(".part") || name.ends_with(".part.new");
}

std::map<std::string, std::string> files_of(const fs::path& folder, bool aside = false) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && is_aside(entry.path()) == aside) {
      files[fs::relative(entry.path(), folder)] = contents_of(entry.path());
    }
  }
  return files;
}

void empty_out(const fs::path& folder) {
  fs::remove_all(folder / "out");
  fs::create_directory(folder / "out");
}

/// What two undisturbed runs write. Files that carry times are not the same twice.
struct Undisturbed {
  double seconds = 0.0;
  std::map<std::string, std::string> files;
  std::set<std::string> same_twice;
};

Undisturbed undisturbed(const std::string& command, const fs::path& folder) {
  Undisturbed whole;
  for (const int turn : {0, 1}) {
    empty_out(folder);
    const Clock::time_point start = Clock::now();
    EXPECT_EQ(run_tenku(command + " --quiet", folder).exit_code, 0)
        << command << contents_of(folder / "said.err");
    whole.seconds = seconds_since(start);
    for (auto& [name, bytes] : files_of(folder / "out")) {
      if (turn == 0) {
        whole.files[name] = bytes;
      } else if (whole.files.at(name) == bytes && !name.ends_with(".exr")) {
        whole.same_twice.insert(name);
      }
    }
  }
  return whole;
}

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// OpenEXR files carry the date of writing, `YYYY:MM:DD hh:mm:ss`.
bool differ_by_a_date(const std::string& a, const std::string& b) {
  if (a.size() != b.size()) return false;
  std::size_t differing = 0;
  for (std::size_t i = 0; i < a.size(); ++i) differing += a[i] != b[i] ? 1 : 0;
  return differing <= 19;
}

/// Whether a file that carries times is all there.
bool is_whole(const std::string& name, const std::string& bytes, const std::string& like) {
  if (name.ends_with("json")) return nlohmann::json::accept(bytes);
  if (name.ends_with(".exr")) return differ_by_a_date(bytes, like);
  if (name.ends_with(".toml")) {  // what the chart recommends depends on the times it measured
    return bytes.ends_with('\n') && bytes.find("[calculation]") != bytes.npos;
  }
  if (name.ends_with(".html")) return bytes.find("</html>") + 10 > bytes.size();
  if (name.ends_with(".svg")) return bytes.find("</svg>") + 10 > bytes.size();
  if (name.ends_with(".vtp")) return bytes.find("</VTKFile>") + 14 > bytes.size();
  if (name.ends_with(".png")) return bytes.find("IEND") + 8 == bytes.size();
  return bytes.ends_with('\n') && lines_of(bytes) == lines_of(like);
}

void expect_whole(const fs::path& out, const Undisturbed& whole, const std::string& command) {
  for (const auto& [name, bytes] : files_of(out)) {
    const auto like = whole.files.find(name);
    ASSERT_NE(like, whole.files.end()) << name << " of " << command;
    if (whole.same_twice.contains(name)) {
      EXPECT_TRUE(bytes == like->second) << name << " of " << command;
    } else {
      EXPECT_TRUE(is_whole(name, bytes, like->second)) << name << " of " << command;
    }
  }
}

bool has_file(const fs::path& folder) {
  return fs::recursive_directory_iterator(folder) != fs::recursive_directory_iterator();
}

void wait_for(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

/// Every other run is killed at any moment of it, the others as soon as they write a file or within
/// milliseconds of it, where the file would be cut off.
/// @return whether the signal came before the end
bool run_and_kill(const std::string& command, const fs::path& folder, double seconds, int turn,
                  SampleRandom& random) {
  empty_out(folder);
  const pid_t child = start_tenku(command, folder);
  const Clock::time_point start = Clock::now();
  if (turn % 2 == 0) {
    wait_for(seconds * random.uniform());
  } else {
    while (!has_file(folder / "out") && seconds_since(start) < 10.0 * seconds) continue;
    if (turn % 4 == 3) wait_for(0.01 * random.uniform() * random.uniform());
  }
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status);
}

TEST(Killed, WhateverBearsItsFinalNameIsWhole) {
  const fs::path folder = test_folder();
  write_inputs(folder);
  const auto kills = static_cast<std::size_t>(number_of("TENKU_KILLS", 52.0));
  const auto seed = static_cast<std::uint64_t>(number_of("TENKU_KILL_SEED", 1.0));
  const std::vector<std::string> all = commands();
  std::size_t before_end = 0, while_writing = 0;
  for (std::size_t c = 0; c < all.size(); ++c) {
    const Undisturbed whole = undisturbed(all[c], folder);
    ASSERT_FALSE(whole.files.empty()) << all[c];
    for (std::size_t k = c; k < kills; k += all.size()) {
      SampleRandom random(seed, c, k);
      const int turn = static_cast<int>(k / all.size());
      before_end += run_and_kill(all[c], folder, whole.seconds, turn, random);
      while_writing += !files_of(folder / "out", true).empty();
      expect_whole(folder / "out", whole, all[c]);
    }
  }
  std::printf("[ MEASURED ] %zu runs, %zu killed before their end, %zu with a file written aside\n",
              kills, before_end, while_writing);
  EXPECT_GT(before_end, kills / 3);
  EXPECT_GT(while_writing, kills / 10);
}

}  // namespace
}  // namespace tenku
