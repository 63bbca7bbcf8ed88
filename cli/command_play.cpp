#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/command.h"
#include "cli/option_list.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "flythrough/playback.h"
#include "output/film_writer.h"
#include "output/image_writer.h"
#include "reports/viewer_page.h"
#include "view/false_colour.h"
#include "view/tone_map.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;

struct PlayOptions {
  std::string store, out, format = "png";
  PlaybackRequest request;
  std::optional<double> fps, ev100, from_s, to_s;
  bool is_false_colour = false;
};

enum class Target { Frames, Film, Page };

Target target_of(const PlayOptions& options) {
  const std::string ending = fs::path(options.out).extension().string();
  if (ending == ".mp4") return Target::Film;
  if (ending == ".html") return Target::Page;
  if (ending.empty() || fs::is_directory(options.out)) return Target::Frames;
  throw InputError(
      fmt::format("--out {}: a folder, or a file ending in .mp4 or .html", options.out));
}

void check_options(const PlayOptions& options, Target target) {
  if (options.out == "-") throw InputError("--out -: a film is a file or a folder");
  if (options.format != "png" && options.format != "exr") {
    throw InputError(fmt::format("--format {}: png or exr", options.format));
  }
  if (options.fps && !(*options.fps > 0.0 && *options.fps <= 1000.0)) {
    throw InputError(fmt::format("--fps {}: not in (0, 1000]", *options.fps));
  }
  if (options.ev100 && !(std::abs(*options.ev100) <= 100.0)) {
    throw InputError(fmt::format("--exposure {}: not in -100..100", *options.ev100));
  }
  if (options.request.width < 0 || options.request.height < 0) {
    throw InputError("--width and --height must be positive");
  }
  if (target == Target::Page && (options.request.width > 0 || options.request.height > 0)) {
    throw InputError("--width and --height are for frames and films, not for a page");
  }
  if (target == Target::Page && options.fps) {
    throw InputError("--fps is for frames and films: a page follows the clock");
  }
  if (target == Target::Film) check_can_write_films();
  if (target == Target::Frames) {
    const fs::path folder = fs::absolute(options.out);
    if (!fs::is_directory(folder) && !fs::is_directory(folder.parent_path())) {
      throw InputError(
          fmt::format("--out {}: no folder {}", options.out, folder.parent_path().string()));
    }
  } else {
    check_can_write(options.out);
  }
}

/// The frames of the store that are shown, one a picture: the last that has begun.
std::vector<std::size_t> chosen_frames(const PlayOptions& options, const PointStore& store) {
  const double rate = store.header().path.frames_per_s;
  const std::size_t frames = store.frames_done();
  const double end = static_cast<double>(frames - 1) / rate;
  const double from = options.from_s.value_or(0.0), to = std::min(options.to_s.value_or(end), end);
  if (!(from >= 0.0 && from <= to)) {
    throw InputError(fmt::format("--from {} --to {}: not within the film, 0 to {:.6g} s", from,
                                 options.to_s.value_or(end), end));
  }
  constexpr double kSlack = 1e-6;  // of a frame: times that are written with few digits
  const double fps = options.fps.value_or(rate);
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0;; ++k) {
    const double time = from + static_cast<double>(k) / fps;
    if (time > to + kSlack / rate) return chosen;
    chosen.push_back(std::min(frames - 1, static_cast<std::size_t>(time * rate + kSlack)));
  }
}

FilmTone tone_of(const PlayOptions& options, FramePlayer& player) {
  FilmTone tone = film_tone(player);
  if (options.ev100) tone.exposure = 1.0 / (1.2 * std::exp2(*options.ev100));
  return tone;
}

Image8 screen_picture(const Image& image, const FilmTone& tone, bool is_false_colour) {
  if (is_false_colour) return false_colour(image, tone.scale);
  ToneMapOptions how;
  how.ev100 = -std::log2(1.2 * tone.exposure);
  return tone_map(image, how);
}

void write_frames(const PlayOptions& options, FramePlayer& player, const FilmTone& tone,
                  const std::vector<std::size_t>& frames, Progress& progress) {
  fs::create_directory(options.out);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    progress.stop_if_cancelled();
    const Image image = player.frame(frames[k]);
    const fs::path file = fs::path(options.out) / fmt::format("frame_{:05}.{}", k, options.format);
    if (options.format == "exr") {
      write_exr(file, image, {.title = options.store, .time = {}, .units = "cd/m2"});
    } else {
      write_png(file, screen_picture(image, tone, options.is_false_colour));
    }
    progress.advance(1);
  }
}

void write_film(const PlayOptions& options, const PointStore& store, FramePlayer& player,
                const FilmTone& tone, const std::vector<std::size_t>& frames, Progress& progress) {
  const PerspectiveView view = player.view(0);
  FilmWriter film(options.out, view.width, view.height,
                  options.fps.value_or(store.header().path.frames_per_s));
  for (const std::size_t frame : frames) {
    progress.stop_if_cancelled();
    film.add(screen_picture(player.frame(frame), tone, options.is_false_colour));
    progress.advance(1);
  }
  film.close();
}

std::string told_of(const PointStore& store) {
  const std::size_t all = store.header().path.size();
  if (store.frames_done() == all) return "";
  return fmt::format("The store is cut off: {} of {} frames can be played.", store.frames_done(),
                     all);
}

int play(const PlayOptions& options, const CommandContext& context) {
  const Target target = target_of(options);
  check_options(options, target);
  const auto start = std::chrono::steady_clock::now();
  const PointStore store(options.store);
  FramePlayer player(store, options.request);
  const std::vector<std::size_t> frames = chosen_frames(options, store);
  const FilmTone tone = tone_of(options, player);
  const std::string told = told_of(store);
  if (!told.empty()) say(context.options, options.store + ": " + told);
  if (target == Target::Page) {
    const std::size_t count = frames.back() - frames.front() + 1;
    write_viewer_page(options.out, store,
                      {.title = fs::path(options.store).filename().string(),
                       .told = told,
                       .tone = tone,
                       .first_frame = frames.front(),
                       .frames = count,
                       .lighting = options.request.lighting},
                      context.progress);
  } else {
    context.progress.begin("frames", frames.size());
    if (target == Target::Film) write_film(options, store, player, tone, frames, context.progress);
    if (target == Target::Frames) write_frames(options, player, tone, frames, context.progress);
    context.progress.end(fmt::format("{} frames", frames.size()));
  }
  if (context.options.json) {
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    const nlohmann::ordered_json json{{"seconds", time.count()},
                                      {"frames", frames.size()},
                                      {"frames_in_store", store.header().path.size()},
                                      {"frames_complete", store.frames_done()},
                                      {"points", store.point_count()},
                                      {"ev100", -std::log2(1.2 * tone.exposure)}};
    fmt::print("{}\n", json.dump(2));
  }
  return kDone;
}

}  // namespace

CommandBody make_play_command(OptionList& app) {
  const auto options = std::make_shared<PlayOptions>();  // outlives this call
  app.add_option("STORE", options->store, "store of points (.tkpts, or .tkpts.part)").required();
  app.add_option("--out", options->out,
                 "folder for frames, a film .mp4 (needs ffmpeg), or one web page .html")
      .required();
  app.add_option("--format", options->format, "frames as png or exr, cd/m2 (default png)");
  app.add_option("--width", options->request.width, "pixels; default as gathered");
  app.add_option("--height", options->request.height, "pixels; default as gathered");
  app.add_option("--fps", options->fps, "pictures a second of the film (default as gathered)");
  app.add_option("--exposure", options->ev100,
                 "exposure value at ISO 100; default: middle grey is the film's geometric mean");
  app.add_flag("--false-colour,--false-color", options->is_false_colour,
               "luminance as colours, one scale for the whole film");
  app.add_option("--from", options->from_s, "time in the film to begin at, seconds");
  app.add_option("--to", options->to_s, "time in the film to end at, seconds");
  app.add_option("--lighting", options->request.lighting,
                 "which sun and sky of the store, from 0 (default 0)");
  return [options](const CommandContext& context) { return play(*options, context); };
}

}  // namespace tenku
