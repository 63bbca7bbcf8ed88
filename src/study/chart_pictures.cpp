#include "study/chart_pictures.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>

#include "flythrough/fly_through.h"
#include "flythrough/playback.h"
#include "flythrough/store_lighting.h"
#include "sky_models/sky_partition.h"
#include "study/scene_reflection.h"
#include "view/tone_map.h"
#include "view/view_render.h"

namespace tenku {
namespace {

constexpr int kFrames = 8;         // of a film
constexpr double kArc_deg = 20.0;  // that its camera goes
constexpr int kDeepest = 8;        // mirrors in a row, of the reference

/// How luminance becomes codes: by the exposure of the first picture.
class SharedTone {
 public:
  Image8 shown(const Image& luminance) {
    std::call_once(once_, [&] {
      // Of `ToneMapOptions::ev100`: white is 1.2 * 2^EV.
      tone_.ev100 = std::log2(1.0 / (1.2 * exposure_of(luminance, {})));
    });
    return tone_map(luminance, tone_);
  }

 private:
  std::once_flag once_;
  ToneMapOptions tone_;
};

void append_codes(const Image8& picture, std::vector<double>& codes) {
  for (const Rgb8 p : picture.pixels) codes.insert(codes.end(), {1.0 * p.r, 1.0 * p.g, 1.0 * p.b});
}

/// Codes of a picture, and by how much its intervals would change them.
void append(const RenderedView& view, SharedTone& tone, SensorValues& values) {
  const Image8 shown = tone.shown(view.luminance);
  Image brighter = view.luminance;
  for (std::size_t p = 0; p < brighter.pixels.size(); ++p) {
    if (!(view.illuminance_lux[p] > 0.0)) continue;
    const double share = view.error_lux[p] / view.illuminance_lux[p];
    brighter.pixels[p] = (1.0 + share) * brighter.pixels[p];
  }
  std::vector<double> codes;
  append_codes(tone.shown(brighter), codes);
  const std::size_t begin = values.lux.size();
  append_codes(shown, values.lux);
  for (std::size_t k = 0; k < codes.size(); ++k) {
    values.error_lux.push_back(codes[k] - values.lux[begin + k]);
  }
  values.width = shown.width;
}

/// One way to a picture.
struct PictureWay {
  double tolerance_pct = 2.0;
  LightMethod method;
  MirrorOptions mirrors;
  std::optional<PartitionRequest> partition;
};

RenderedView rendered(const LitScene& lit, const ChartView& view, const PictureWay& way,
                      std::uint64_t seed, Progress& progress) {
  const DaylightSource source = daylight_of(lit.sky(), way.partition);
  ViewRequest request;
  request.view = view.view;
  request.tolerance_pct = way.tolerance_pct;
  request.bounces = view.bounces;
  request.seed = seed;
  request.method = way.method;
  request.mirrors = way.mirrors;
  request.mirrors.light_all = false;
  SceneReflection reflection(lit, Reflection::Auto);
  IlluminanceOptions of_light;
  of_light.tolerance_pct = way.tolerance_pct;
  of_light.bounces = view.bounces;
  of_light.seed = seed;
  request.reflection = reflection.finder(of_light, way.method);
  return render_view(request, lit.engines(), source, lit.sky().model.get(), progress);
}

/// Settings and a reference that show the same view.
class PictureList {
 public:
  PictureList(const LitScene& lit, const ChartView& view, std::uint64_t seed, std::string stage,
              std::vector<ChartSetting>& settings, std::vector<ChartReference>& references)
      : lit_(lit),
        view_(view),
        seed_(seed),
        stage_(std::move(stage)),
        settings_(settings),
        references_(references) {}

  void hold_against(const std::string& name, const PictureWay& way) {
    references_.push_back(
        {name,
         {4.0, 2.0, 1.0, 0.5},
         [this_ = *this, way](double tolerance, std::uint64_t seed, Progress& progress) {
           PictureWay finer = way;
           finer.tolerance_pct = tolerance;
           return this_.values(finer, seed, progress);
         }});
  }

  void add(const std::string& method, const std::string& setting, const std::string& study,
           const PictureWay& way) {
    settings_.push_back({stage_, method, setting, study, references_.size() - 1,
                         [this_ = *this, way](Progress& progress) {
                           return this_.values(way, this_.seed_, progress);
                         }});
  }

 private:
  SensorValues values(const PictureWay& way, std::uint64_t seed, Progress& progress) const {
    SensorValues values;
    append(rendered(lit_, view_, way, seed, progress), *tone_, values);
    return values;
  }

  const LitScene& lit_;
  ChartView view_;
  std::uint64_t seed_;
  std::string stage_;
  std::vector<ChartSetting>& settings_;
  std::vector<ChartReference>& references_;
  std::shared_ptr<SharedTone> tone_ = std::make_shared<SharedTone>();
};

PictureWay by_rays() {
  PictureWay way;
  way.method.engine = EngineChoice::Rays;
  return way;
}

/// The view of each frame, on an arc about the target.
std::vector<ChartView> arc_about(const ChartView& middle) {
  std::vector<ChartView> frames;
  const Vec3 away = middle.view.eye - middle.view.target;
  for (int k = 0; k < kFrames; ++k) {
    const double turn = Angle::degrees(kArc_deg * (k / (kFrames - 1.0) - 0.5)).in_radians();
    const double c = std::cos(turn), s = std::sin(turn);
    ChartView frame = middle;
    frame.view.eye =
        frame.view.target + Vec3{c * away.x - s * away.y, s * away.x + c * away.y, away.z};
    frames.push_back(frame);
  }
  return frames;
}

/// A file that goes when it is no longer wanted.
class PassingFile {
 public:
  PassingFile() {
    static int count = 0;
    path = std::filesystem::temp_directory_path() /
           fmt::format("tenku-chart-{}-{}.tkpts", ::getpid(), count++);
  }
  ~PassingFile() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    std::filesystem::remove(part_of(path), ignored);
  }
  PassingFile(const PassingFile&) = delete;
  PassingFile& operator=(const PassingFile&) = delete;

  std::filesystem::path path;
};

/// Frames played from points that are gathered and lit for it.
SensorValues played(const LitScene& lit, const std::vector<ChartView>& frames, double tolerance_pct,
                    std::uint64_t seed, SharedTone& tone, Progress& progress) {
  const PassingFile file;
  FlyThroughRequest request;
  request.file = file.path;
  for (const Material& m : lit.scene().materials) {
    request.header.materials.push_back({m.name, m.reflectance, m.emission_lm_m2});
  }
  CameraPath& path = request.header.path;
  path.width = frames.front().view.width, path.height = frames.front().view.height;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const PerspectiveView& view = frames[k].view;
    path.frames.push_back(
        {static_cast<double>(k) / path.frames_per_s, view.eye, view.target, view.horizontal_fov});
  }
  request.lighting = lighting_of(lit.sky(), lit.source(), "");
  request.light = {tolerance_pct, frames.front().bounces, seed};
  fly_through(request, lit.engines(), lit.source(), progress);
  const PointStore store(file.path);
  FramePlayer player(store, {});
  SensorValues values;
  values.width = path.width;
  for (std::size_t k = 0; k < player.frames(); ++k) {
    append_codes(tone.shown(player.frame(k)), values.lux);
  }
  return values;
}

}  // namespace

bool has_mirrors(const LitScene& lit) {
  const std::vector<Material>& materials = lit.scene().materials;
  return std::any_of(lit.soup().material.begin(), lit.soup().material.end(),
                     [&](std::uint32_t m) { return materials[m].mirror > 0.0; });
}

void add_picture_stage(const LitScene& lit, const ChartView& view, std::uint64_t seed,
                       std::vector<ChartSetting>& settings,
                       std::vector<ChartReference>& references) {
  PictureList list(lit, view, seed, "picture", settings, references);
  list.hold_against("a picture, each point by itself", by_rays());
  for (const double tolerance : {20.0, 10.0, 5.0, 2.0}) {
    list.add("budget", tolerance_text(tolerance),
             fmt::format("tolerance_percent = {:.1f}\n", tolerance),
             {.tolerance_pct = tolerance, .method = {}, .mirrors = {}, .partition = {}});
  }
  for (const double mu : {4.0, 1.0}) {
    PictureWay way;
    way.method.detail = Detail::Paper;
    way.method.mu = mu;
    list.add("paper", fmt::format("mu {:g}", mu), fmt::format("lod = \"paper\"\nmu = {:.1f}\n", mu),
             way);
  }
  for (const std::size_t n : {64, 256}) {
    PictureWay way;
    way.method.detail = Detail::Off;
    way.partition = PartitionRequest{};
    way.partition->method = PartitionMethod::Adaptive;
    way.partition->elements = n;
    list.add("off", fmt::format("{} elements", n),
             fmt::format("lod = \"off\"\npartition = \"adaptive\"\nelements = {}\n", n), way);
  }
}

void add_mirror_stage(const LitScene& lit, const ChartView& view, std::uint64_t seed,
                      std::vector<ChartSetting>& settings,
                      std::vector<ChartReference>& references) {
  PictureList list(lit, view, seed, "mirrors", settings, references);
  PictureWay deepest = by_rays();
  deepest.mirrors.method = MirrorMethod::Rays;
  deepest.mirrors.depth = kDeepest;
  list.hold_against(fmt::format("a picture with up to {} mirrors in a row", kDeepest), deepest);
  const std::pair<const char*, MirrorMethod> methods[] = {{"beams", MirrorMethod::Beams},
                                                          {"rays", MirrorMethod::Rays}};
  PictureWay off;
  off.mirrors.method = MirrorMethod::Off;
  list.add("off", "none", "", off);
  for (const auto& [name, method] : methods) {
    for (const int depth : {1, 2, 4}) {
      PictureWay way;
      way.mirrors.method = method;
      way.mirrors.depth = depth;
      list.add(name, fmt::format("depth {}", depth), "", way);
    }
  }
}

void add_fly_through_stage(const LitScene& lit, const ChartView& view, std::uint64_t seed,
                           std::vector<ChartSetting>& settings,
                           std::vector<ChartReference>& references) {
  ChartView small = view;
  small.view.width = std::max(16, view.view.width / 2);
  small.view.height = std::max(16, view.view.height / 2);
  const std::vector<ChartView> frames = arc_about(small);
  const auto tone = std::make_shared<SharedTone>();
  const auto direct = [&lit, frames, tone](double tolerance, std::uint64_t run_seed,
                                           Progress& progress) {
    SensorValues values;
    for (const ChartView& frame : frames) {
      PictureWay way;
      way.tolerance_pct = tolerance;
      append(rendered(lit, frame, way, run_seed, progress), *tone, values);
    }
    return values;
  };
  references.push_back(
      {fmt::format("{} frames, each rendered by itself", kFrames), {4.0, 2.0, 1.0}, direct});
  const std::size_t reference = references.size() - 1;
  for (const double tolerance : {20.0, 10.0, 5.0, 2.0}) {
    settings.push_back({"fly-through", "frame by frame", tolerance_text(tolerance), "", reference,
                        [direct, tolerance, seed](Progress& progress) {
                          return direct(tolerance, seed, progress);
                        }});
  }
  for (const double tolerance : {20.0, 10.0, 5.0, 2.0}) {
    settings.push_back({"fly-through", "points", tolerance_text(tolerance), "", reference,
                        [&lit, frames, tone, tolerance, seed](Progress& progress) {
                          return played(lit, frames, tolerance, seed, *tone, progress);
                        }});
  }
}

}  // namespace tenku
