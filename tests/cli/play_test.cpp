// `tenku play`: frames, films and pages.
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/lit_scene_files.h"
#include "flythrough/floor_store.h"
#include "flythrough/playback.h"
#include "support/run_program.h"
#include "view/false_colour.h"
#include "view/tone_map.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;
using namespace testing_support;
using nlohmann::json;

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// A program called ffmpeg in the folder `bin`, and nothing else of that name.
void write_stand_in(const fs::path& folder, const std::string& script) {
  fs::create_directories(folder / "bin");
  write_text(folder / "bin" / "ffmpeg", "#!/bin/sh\n" + script);
  fs::permissions(folder / "bin" / "ffmpeg", fs::perms::owner_all);
}

class PathSetting {
 public:
  explicit PathSetting(const std::string& path) : before_(std::getenv("PATH")) {
    setenv("PATH", path.c_str(), 1);
  }
  ~PathSetting() { setenv("PATH", before_.c_str(), 1); }

 private:
  std::string before_;
};

TEST(PlayCommand, FramesOfASpanOfTime) {
  const fs::path folder = test_folder();
  write_floor_store(folder / "f.tkpts");
  const ProgramRun run =
      run_tenku("play f.tkpts --out frames --from 0.1 --to 0.4 --fps 20 --json", folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(files_in(folder / "frames"), 7U);
  EXPECT_EQ(json::parse(run.out).at("frames"), 7);
  ASSERT_EQ(run_tenku("play f.tkpts --out exr --format exr --width 32", folder).exit_code, 0);
  EXPECT_EQ(files_in(folder / "exr"), 6U);
}

TEST(PlayCommand, RefusesWhatItCannotDo) {
  const fs::path folder = test_folder();
  write_floor_store(folder / "f.tkpts");
  for (const char* wrong :
       {"f.tkpts --out no/such/frames", "f.tkpts --out no/film.html", "f.tkpts --out film.avi",
        "f.tkpts --out x --format gif", "f.tkpts --out x --fps 0", "f.tkpts --out x --from 2",
        "f.tkpts --out x --lighting 2", "f.tkpts --out x --width 40000",
        "f.tkpts --out p.html --width 10", "none.tkpts --out x", "f.tkpts --out -"}) {
    const ProgramRun run = run_tenku(std::string("play ") + wrong, folder);
    EXPECT_EQ(run.exit_code, 2) << wrong << run.err;
    EXPECT_FALSE(fs::exists(folder / "x")) << wrong;
  }
}

TEST(PlayCommand, AStoreThatIsCutOffIsPlayedAsFarAsItGoes) {
  const fs::path folder = test_folder();
  write_floor_store(folder / "f.tkpts.part", 2);
  const ProgramRun run = run_tenku("play f.tkpts.part --out frames", folder);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_NE(run.err.find("2 of 6 frames"), std::string::npos) << run.err;
  EXPECT_EQ(files_in(folder / "frames"), 2U);
  write_floor_store(folder / "empty.tkpts", 0);
  EXPECT_EQ(run_tenku("play empty.tkpts --out frames", folder).exit_code, 2);
}

TEST(PlayCommand, FilmsAreSentToFfmpegWithoutAShell) {
  const fs::path folder = test_folder();
  write_floor_store(folder / "f.tkpts");
  write_stand_in(folder, "for last; do :; done\n/bin/cat > \"${last#file:}\"\n");
  const PathSetting path((folder / "bin").string());
  // A name that a shell would take apart.
  ASSERT_EQ(run_tenku("play f.tkpts --out '$(x) a;b.mp4'", folder).exit_code, 0);
  EXPECT_EQ(fs::file_size(folder / "$(x) a;b.mp4"), 6U * 64U * 48U * 3U);
}

TEST(PlayCommand, AFilmThatFfmpegDoesNotFinishIsNotThere) {
  const fs::path folder = test_folder();
  write_floor_store(folder / "f.tkpts");
  write_stand_in(folder, "exit 3\n");
  {
    const PathSetting path((folder / "bin").string());
    EXPECT_EQ(run_tenku("play f.tkpts --out a.mp4", folder).exit_code, 1);
    EXPECT_FALSE(fs::exists(folder / "a.mp4"));
  }
  const PathSetting path("/nowhere");
  const ProgramRun run = run_tenku("play f.tkpts --out a.mp4", folder);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("ffmpeg"), std::string::npos) << run.err;
}

/// What a script says in the page; nothing where no browser is.
std::optional<json> page_says(const fs::path& page, const std::string& script) {
  write_text(page.parent_path() / "script.js", script);
  const std::string command = "cd '" + page.parent_path().string() +
                              "' && python3 '" TENKU_SOURCE_DIR "/tests/support/drive_page.py' '" +
                              page.string() + "' \"$(cat script.js)\" 100 > answer.json";
  const int status = std::system(command.c_str());
  if (WIFEXITED(status) && WEXITSTATUS(status) == 77) return std::nullopt;
  EXPECT_EQ(status, 0);
  return json::parse(contents_of(page.parent_path() / "answer.json"));
}

/// Mean difference of the codes of all channels, rows of `rgba` from the bottom.
double mean_difference(const json& rgba, const Image8& picture) {
  double sum = 0.0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const std::size_t at =
          4 * static_cast<std::size_t>((picture.height - 1 - y) * picture.width + x);
      const Rgb8 c = picture.at(x, y);
      sum += std::abs(rgba[at].get<int>() - c.r) + std::abs(rgba[at + 1].get<int>() - c.g) +
             std::abs(rgba[at + 2].get<int>() - c.b);
    }
  }
  return sum / (3.0 * picture.width * picture.height);
}

double mean_difference(const json& rgba, const json& other) {
  double sum = 0.0;
  for (std::size_t k = 0; k < rgba.size(); ++k) {
    sum += std::abs(rgba[k].get<int>() - other.at(k).get<int>());
  }
  return sum / (0.75 * static_cast<double>(rgba.size()));
}

TEST(PlayCommand, ThePageShowsTheFramesThatTheProgramDraws) {
  const fs::path folder = test_folder();
  write_floor_store(folder / "f.tkpts");
  ASSERT_EQ(run_tenku("play f.tkpts --out f.html", folder).exit_code, 0);
  const std::string text = contents_of(folder / "f.html");
  EXPECT_EQ(text.find("http"), std::string::npos);
  const auto said = page_says(folder / "f.html", R"js(tenkuPlayer.then(async (p) => {
    const gl = p.painter.gl, shots = [];
    const shot = () => {
      const rgba = new Uint8Array(4 * 64 * 48);
      gl.readPixels(0, 0, 64, 48, gl.RGBA, gl.UNSIGNED_BYTE, rgba);
      shots.push([...rgba]);
    };
    for (const frame of [0, 5]) p.goTo(frame), shot();
    element("false").click(); shot(); element("false").click();
    p.setLighting(1); shot();
    p.look(10, 0); shot();
    p.setLighting(0);
    const byLoop = p.painter.isByLoop, drafts = [];
    for (const isByLoop of [true, false]) {
      p.painter.isByLoop = isByLoop;
      element("samples").value = "1"; p.goTo(5); shot();
      p.look(10, 0); shot();
      element("samples").value = "0.5"; p.goTo(0);
      const draft = new Uint8Array(4 * 32 * 24);
      gl.readPixels(0, 0, 32, 24, gl.RGBA, gl.UNSIGNED_BYTE, draft);
      drafts.push([...draft]);
    }
    const draftWidth = p.painter.canvas.width;
    element("samples").value = "auto"; p.goTo(0);
    const restWidth = p.painter.canvas.width;
    p.play(true);
    let later = 0;  // a busy machine may take seconds to a frame
    for (let k = 0; k < 200 && !later; ++k) {
      await new Promise((done) => setTimeout(done, 100));
      later = p.frame;
    }
    return {shots, drafts, byLoop, draftWidth, restWidth, later, glError: gl.getError(),
            hours: element("hour").options.length, ticks: element("ticks").children.length};
  }))js");
  if (!said) GTEST_SKIP() << "skipped: no chromium";
  EXPECT_EQ(said->at("errors"), json::array());
  EXPECT_EQ(said->at("requests"), json::array());
  const json& value = said->at("value");
  EXPECT_EQ(value.at("glError"), 0);
  EXPECT_GT(value.at("later"), 0);
  EXPECT_EQ(value.at("hours"), 2);
  EXPECT_GE(value.at("ticks").get<int>(), 3);
  const PointStore store(folder / "f.tkpts");
  FramePlayer player(store, {}), evening(store, {.lighting = 1});
  const FilmTone tone = film_tone(player);
  ToneMapOptions how;
  how.ev100 = -std::log2(1.2 * tone.exposure);
  const json& shots = value.at("shots");
  EXPECT_LE(mean_difference(shots[0], tone_map(player.frame(0), how)), 0.5);
  EXPECT_EQ(value.at("draftWidth"), 32);
  EXPECT_EQ(value.at("restWidth"), 64);
  // In the lower half, which is all floor, nothing shows through one point of four.
  const int sky = tone_map(player.frame(0), how).at(0, 0).r;
  for (const json& draft : value.at("drafts")) {
    for (std::size_t p = 0; p < 32 * 12; ++p) EXPECT_NE(draft[4 * p], sky) << p;
  }
  // The browser draws in software: points by the loop, which shows what the shaders show.
  EXPECT_TRUE(value.at("byLoop"));
  for (const std::size_t k : {5U, 6U}) EXPECT_LE(mean_difference(shots[k], shots[k + 2]), 0.5) << k;
  EXPECT_LE(mean_difference(shots[1], tone_map(player.frame(5), how)), 0.5);
  EXPECT_LE(mean_difference(shots[2], false_colour(player.frame(5), tone.scale)), 0.5);
  EXPECT_LE(mean_difference(shots[3], tone_map(evening.frame(5), how)), 0.5);
  EXPECT_NE(shots[4], shots[3]);
}

}  // namespace
}  // namespace tenku
