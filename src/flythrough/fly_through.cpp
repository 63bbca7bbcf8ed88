#include "flythrough/fly_through.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <system_error>

#include "core/error.h"
#include "core/stopwatch.h"
#include "flythrough/chunk_cache.h"
#include "flythrough/chunk_cuts.h"
#include "flythrough/closest_approach.h"
#include "flythrough/point_codec.h"
#include "flythrough/point_gather.h"

namespace tenku {
namespace fs = std::filesystem;
namespace {

constexpr const char* kPlanSetting = "light";

/// The one that is written, or an account of what another store differs in.
void check_same(const StoreHeader& kept, const StoreHeader& wanted, const std::string& name) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(name + " cannot be resumed: " + what);
  };
  if (kept.scene_sha256 != wanted.scene_sha256) {
    refuse("it was made from another scene, " + kept.scene + " with SHA-256 " +
           kept.scene_sha256.substr(0, 12) + ", and this one has " +
           wanted.scene_sha256.substr(0, 12));
  }
  for (const auto& [key, value] : wanted.settings) {
    if (kept.setting(key) != value) {
      refuse(key + " was '" + kept.setting(key) + "', and now is '" + value + "'");
    }
  }
  const auto differs = [](const CameraFrame& a, const CameraFrame& b) {
    return a.eye != b.eye || a.target != b.target || a.time_s != b.time_s;
  };
  const CameraPath &a = kept.path, &b = wanted.path;
  if (a.width != b.width || a.height != b.height ||
      !std::equal(a.frames.begin(), a.frames.end(), b.frames.begin(), b.frames.end(),
                  [&](const auto& x, const auto& y) { return !differs(x, y); })) {
    refuse("its camera path is another");
  }
}

/// Carries a request out.
class FlyThrough {
 public:
  FlyThrough(const FlyThroughRequest& request, const Engines& engines, const DaylightSource& source,
             Progress& progress)
      : request_(request),
        engines_(engines),
        source_(source),
        progress_(progress),
        // As it will be read back, so that a resumed run sees the same path.
        header_(unpacked_header(packed(request.header))) {}

  FlyThroughResult run() {
    open();
    result_.frames_before = frame_;
    ChunkCache cache(*store_, request_.points_in_memory);
    while (frame_ < header_.path.size()) {
      const std::size_t first_chunk = chunks_done_;
      const StoredPoints points = gather_batch(cache, first_chunk);
      write_batch(points, first_chunk);
      store_->end_frames(frame_);
      chunks_done_ = store_->chunks().size();
    }
    return finish();
  }

 private:
  void open() {
    const fs::path part = part_of(request_.file);
    if (request_.resume && fs::exists(part)) {
      const PointStore kept(part);
      check_same(kept.header(), header_, part.string());
      take_up(kept);
      store_.emplace(part);
      return;
    }
    if (request_.resume && fs::exists(request_.file)) {
      throw InputError(request_.file.string() + " is complete: there is nothing to resume");
    }
    plan_ = make_plan();
    header_.settings.push_back({kPlanSetting, text_of(plan_)});
    create(part);
  }

  /// The file gets its name once its header is whole: what bears it can always be resumed.
  void create(const fs::path& part) {
    const bool is_device = part == request_.file;
    const fs::path young = is_device ? part : fs::path(part.string() + ".new");
    try {
      store_.emplace(young, header_);
      store_->add_lighting(request_.lighting);
      if (!is_device) fs::rename(young, part);
    } catch (...) {
      std::error_code ignored;
      if (!is_device) fs::remove(young, ignored);
      throw;
    }
  }

  void take_up(const PointStore& kept) {
    plan_ = plan_of(kept.header().setting(kPlanSetting));
    frame_ = kept.frames_done();
    chunks_done_ = kept.chunks_done();
    for (std::size_t c = 0; c < kept.chunks().size(); ++c) is_lit_.push_back(kept.has_light(c, 0));
  }

  /// By the points of the middle frame, or of another where that has none.
  PointLightPlan make_plan() {
    StoredPoints points;
    const std::size_t n = header_.path.size();
    for (const std::size_t f : {n / 2, std::size_t{0}, n - 1}) {
      if (!points.empty()) break;
      points =
          gather_frame(header_.path.view(f), request_.rule, engines_.rays(), {}, progress_).points;
    }
    return plan_point_light(points, engines_, source_, request_.light, request_.method, progress_);
  }

  static void append(const StoredPoints& some, StoredPoints& all) {
    const auto join = [](const auto& from, auto& to) {
      to.insert(to.end(), from.begin(), from.end());
    };
    join(some.position, all.position);
    join(some.normal, all.normal);
    join(some.footprint_m, all.footprint_m);
    join(some.object, all.object);
    join(some.material, all.material);
    join(some.is_edge, all.is_edge);
    join(some.borders, all.borders);
  }

  /// Points of frames until they are enough for a batch. Chunks of a batch that was cut off are in
  /// the store, and must not be seen: `first_chunk` and later ones.
  StoredPoints gather_batch(ChunkCache& cache, std::size_t first_chunk) {
    const Stopwatch watch;
    progress_.begin("gathering points", header_.path.size());
    progress_.advance(frame_);
    StoredPoints points;
    std::vector<SplatChunk> fresh;
    fresh.reserve(request_.frames_in_batch);
    for (std::size_t n = 0; n < request_.frames_in_batch && frame_ < header_.path.size() &&
                            points.size() < request_.points_in_batch;
         ++n, ++frame_) {
      progress_.stop_if_cancelled();
      const PerspectiveView view = header_.path.view(frame_);
      const SplatBuffer buffer(view, request_.rule);
      std::vector<const SplatChunk*> shown = cache.shown(buffer, first_chunk);
      for (const SplatChunk& chunk : fresh) {
        if (buffer.may_show(chunk.extent, chunk.finest_m)) shown.push_back(&chunk);
      }
      const GatheredFrame frame =
          gather_frame(view, request_.rule, engines_.rays(), shown, progress_);
      note(frame);
      append(frame.points, points);
      if (!frame.points.empty()) fresh.push_back(splat_chunk(frame.points));
      progress_.advance(1);
    }
    progress_.end(
        fmt::format("{} new points, {} of {} frames", points.size(), frame_, header_.path.size()));
    result_.gather_s += watch.seconds();
    return points;
  }

  void note(const GatheredFrame& frame) {
    result_.rays += frame.rays;
    glass_pixels_ += frame.glass_pixels;
    mirror_pixels_ += frame.mirror_pixels;
    empty_frames_ += frame.surface_pixels == 0;
  }

  void write_batch(const StoredPoints& points, std::size_t first_chunk) {
    const Stopwatch watch;
    const auto cuts = cut_by_space(points, request_.points_in_chunk);
    progress_.begin("lighting points", cuts.size());
    for (std::size_t k = 0; k < cuts.size(); ++k, progress_.advance(1)) {
      const std::size_t chunk = first_chunk + k;
      progress_.stop_if_cancelled();
      if (chunk < is_lit_.size() && is_lit_[chunk]) continue;  // a run before this one did
      const StoredPoints some = points.of(cuts[k]);
      Progress quiet;
      if (chunk >= store_->chunks().size()) store_->add_points(some);
      const PointLight light =
          light_points(some, pixels_at_closest(some, header_.path, request_.rule), engines_,
                       source_, request_.light, plan_, quiet);
      store_->add_light(chunk, 0, light);
    }
    progress_.end(fmt::format("{} points", points.size()));
    result_.light_s += watch.seconds();
  }

  FlyThroughResult finish() {
    result_.frames = header_.path.size();
    result_.chunks = store_->chunks().size();
    for (const ChunkInfo& chunk : store_->chunks()) result_.points += chunk.points;
    result_.bytes = store_->bytes();
    result_.how = text_of(plan_);
    store_.reset();
    const fs::path part = part_of(request_.file);
    if (part != request_.file) {
      std::error_code error;
      fs::rename(part, request_.file, error);
      if (error) {
        throw ResourceError("cannot write " + request_.file.string() + ": " + error.message());
      }
    }
    tell("glass_left_to_frame", glass_pixels_ * 64, "pixels look through panes of glass",
         "points are stored as if the panes were not there; render shows them");
    tell("mirrors_left_to_frame", mirror_pixels_, "pixels show mirrors",
         "points hold what mirrors scatter, not what they reflect; render shows it");
    tell("empty_frames", empty_frames_, "frames show no surface", "nothing");
    return std::move(result_);
  }

  void tell(const char* code, std::size_t count, const char* what, const char* repair) {
    if (count == 0) return;
    Finding finding;
    finding.code = code;
    finding.severity = Severity::Note;
    finding.what = what;
    finding.repair = repair;
    finding.count = count;
    result_.findings.push_back(std::move(finding));
  }

  const FlyThroughRequest& request_;
  const Engines& engines_;
  const DaylightSource& source_;
  Progress& progress_;
  StoreHeader header_;
  PointLightPlan plan_;
  std::optional<PointStoreWriter> store_;
  std::vector<bool> is_lit_;  ///< [chunk], in the store that is resumed
  std::size_t frame_ = 0, chunks_done_ = 0;
  std::size_t glass_pixels_ = 0, mirror_pixels_ = 0, empty_frames_ = 0;
  FlyThroughResult result_;
};

}  // namespace

fs::path part_of(const fs::path& file) {
  std::error_code ignored;
  if (fs::is_character_file(file, ignored)) return file;
  return file.string() + ".part";
}

FlyThroughResult fly_through(const FlyThroughRequest& request, const Engines& engines,
                             const DaylightSource& source, Progress& progress) {
  if (request.header.path.frames.empty()) throw InputError("the camera path has no frames");
  return FlyThrough(request, engines, source, progress).run();
}

}  // namespace tenku
