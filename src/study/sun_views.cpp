#include "study/sun_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/csv.h"
#include "core/error.h"
#include "core/parallel.h"

namespace tenku {
namespace {

constexpr int kDiscPoints = 61;
constexpr double kGoldenAngle = 2.399963229728653;  // radians: pi (3 - sqrt 5)
constexpr double kNear = 1e-3;                      // m: a ray ends that much before the panel
constexpr Angle kMargin = Angle::degrees(0.1);      // of the quick test

/// The sun at one of the closely spaced instants.
struct FineSun {
  CivilTime time;
  int day = 0;
  SolarDisc disc;
};

/// What an observer sees of the sun in a panel at one instant.
struct Glimpse {
  double share = 0.0, luminance = 0.0;
  Vec3 toward;  ///< sum of the directions
};

Illuminance between(const std::vector<SunMoment>& moments, std::size_t before, double seconds) {
  const Illuminance a = moments[before].sun.normal_illuminance;
  if (before + 1 >= moments.size() || moments[before + 1].day != moments[before].day) return a;
  const double t = std::clamp(seconds / moments[before].step_s, 0.0, 1.0);
  return a + t * (moments[before + 1].sun.normal_illuminance - a);
}

/// Half a step before each moment to half a step after it.
std::vector<FineSun> fine_suns(const std::vector<SunMoment>& moments,
                               const std::function<SunInSky(const CivilTime&)>& sun_at) {
  std::vector<FineSun> fine;
  for (std::size_t m = 0; m < moments.size(); ++m) {
    const SunMoment& moment = moments[m];
    if (!moment.time) continue;
    const int steps = std::max(1, static_cast<int>(std::lround(moment.step_s / kViewStep_s)));
    for (int k = 0; k < steps; ++k) {
      const double after = moment.step_s * ((k + 0.5) / steps - 0.5);
      FineSun sun{on_clock_of(*moment.time, later_by(moment.time->instant, after)), moment.day,
                  moment.sun};
      const bool is_earlier = after < 0.0 && m > 0 && moments[m - 1].day == moment.day;
      sun.disc.normal_illuminance = is_earlier ? between(moments, m - 1, moment.step_s + after)
                                               : between(moments, m, std::max(0.0, after));
      fine.push_back(std::move(sun));
    }
  }
  parallel_for(fine.size(), 16, [&](IndexRange range) {
    for (std::size_t k = range.begin; k < range.end; ++k) {
      fine[k].disc.direction = sun_at(fine[k].time).direction;
    }
  });
  return fine;
}

Vec3 on_disc(const SolarDisc& disc, const TangentFrame& frame, int k) {
  const double r = std::tan(disc.angular_radius.in_radians()) * std::sqrt((k + 0.5) / kDiscPoints);
  return normalized(disc.direction + r * std::cos(kGoldenAngle * k) * frame.tangent +
                    r * std::sin(kGoldenAngle * k) * frame.bitangent);
}

bool holds(const MirrorPart& part, Vec3 p) {
  for (std::size_t k = 0; k < part.corners.size(); ++k) {
    const Vec3 a = part.corners[k], b = part.corners[(k + 1) % part.corners.size()];
    if (dot(cross(b - a, p - a), part.normal) < 0.0) return false;
  }
  return true;
}

/// One eye and one flat part of a panel.
class MirroredEye {
 public:
  MirroredEye(const LitScene& lit, const Material& material, const SunObserver& observer,
              const MirrorPart& part)
      : lit_(lit), material_(material), observer_(observer), part_(part) {
    from_ = observer.eye;
    if (observer.facing && !observer.sees_all_round) from_ = from_ + kNear * *observer.facing;
    height_ = dot(part.normal, observer.eye - part.corners[0]);
    eye_ = observer.eye - 2.0 * height_ * part.normal;
    const Extent box = extent_of(part.corners);
    middle_ = box.middle();
    radius_ = 0.5 * length(box.size());
  }

  /// A quick no; yes may be wrong.
  bool may_see(const SolarDisc& sun) const {
    if (!(std::abs(height_) > kNear) || dot(part_.normal, sun.direction) * height_ <= 0.0) {
      return false;
    }
    const Vec3 to = middle_ - eye_;
    const double far = length(to);
    if (far <= radius_) return true;
    const Angle wide = Angle::radians(std::asin(radius_ / far)) + sun.angular_radius + kMargin;
    return angle_between(to, sun.direction) <= wide;
  }

  void add_to(Glimpse& glimpse, const SolarDisc& sun) const {
    const TangentFrame frame = tangent_frame(sun.direction);
    for (int k = 0; k < kDiscPoints; ++k) {
      const Vec3 toward_sun = on_disc(sun, frame, k);
      const double across = dot(part_.normal, toward_sun);
      if (across * height_ <= 0.0) continue;
      const Vec3 at = eye_ + (height_ / across) * toward_sun;
      if (!holds(part_, at)) continue;
      const double seen = seen_share(at, toward_sun);
      if (!(seen > 0.0)) continue;
      glimpse.share += 1.0 / kDiscPoints;
      glimpse.luminance += seen * luminance_of(sun) / kDiscPoints;
      glimpse.toward = glimpse.toward + normalized(at - observer_.eye);
    }
  }

 private:
  static double luminance_of(const SolarDisc& sun) {
    const double s = std::sin(sun.angular_radius.in_radians());
    return sun.normal_illuminance.value() / (kPi * s * s);
  }

  /// Share of the luminance that comes by way of a point of the panel; 0 if a way is barred.
  double seen_share(Vec3 at, Vec3 toward_sun) const {
    const Vec3 way = at - from_;
    const double far = length(way) - kNear;
    const Vec3 look = normalized(way);
    if (observer_.facing && !observer_.sees_all_round && dot(*observer_.facing, look) <= 0.0) {
      return 0.0;
    }
    const RayVisibility& rays = lit_.rays();
    const auto hit = rays.first_hit(from_, look);
    if (hit && hit->distance_m < far) return 0.0;
    const Vec3 lifted = at + std::copysign(rays.lift_m() + 0.1 * kNear, height_) * part_.normal;
    if (rays.is_occluded(lifted, toward_sun)) return 0.0;
    return mirrored_share(material_, std::abs(dot(part_.normal, toward_sun))) *
           rays.glass_transmission(from_, look, far) * rays.glass_transmission(lifted, toward_sun);
  }

  const LitScene& lit_;
  const Material& material_;
  const SunObserver& observer_;
  const MirrorPart& part_;
  double height_ = 0.0, radius_ = 0.0;
  Vec3 from_, eye_, middle_;  ///< `from_` is lifted off the window
};

/// What one observer sees in one panel through all instants.
class PanelWatch {
 public:
  PanelWatch(const LitScene& lit, const MirrorPanel& panel, const SunObserver& observer)
      : observer_(observer) {
    for (const MirrorPart& part : panel.parts) {
      eyes_.emplace_back(lit, lit.scene().materials[panel.material], observer, part);
    }
  }

  void append_to(std::vector<SunView>& views, const std::vector<FineSun>& suns, SunView view) {
    bool is_open = false;
    for (std::size_t k = 0; k < suns.size(); ++k) {
      Glimpse glimpse;
      for (const MirroredEye& eye : eyes_) {
        if (eye.may_see(suns[k].disc)) eye.add_to(glimpse, suns[k].disc);
      }
      if (!(glimpse.share > 0.0)) {
        is_open = false;
        continue;
      }
      if (!is_open || suns[k].day != suns[k - 1].day) {
        views.push_back(view);
        views.back().from = suns[k].time;
      }
      is_open = true;
      take(views.back(), glimpse, suns[k].time);
    }
  }

 private:
  void take(SunView& view, const Glimpse& glimpse, const CivilTime& time) const {
    view.to = time;
    const Vec3 toward = normalized(glimpse.toward);
    view.most = std::max(view.most, Luminance(glimpse.luminance / glimpse.share));
    if (observer_.facing) {
      const Angle angle = angle_between(toward, *observer_.facing);
      view.angle = view.angle ? std::min(*view.angle, angle) : angle;
    }
    if (glimpse.share <= view.most_share) return;
    view.most_share = glimpse.share;
    view.azimuth = azimuth_of(toward);
    view.altitude = altitude_of(toward);
  }

  const SunObserver& observer_;
  std::vector<MirroredEye> eyes_;
};

Vec3 point_of(const CsvInput& csv, std::size_t row, const char* x, const char* y, const char* z) {
  return {csv.number(row, x), csv.number(row, y), csv.number(row, z)};
}

CsvInput table_of_points(const std::filesystem::path& path) {
  CsvInput csv(read_whole_file(path), path.filename().string());
  for (const char* column : {"x", "y", "z"}) csv.require(column);
  return csv;
}

}  // namespace

std::vector<SunObserver> read_observers(const std::filesystem::path& path, const FileFrame& frame) {
  const CsvInput csv = table_of_points(path);
  const bool has_normals = csv.has("nx") || csv.has("ny") || csv.has("nz");
  if (has_normals) {
    for (const char* column : {"nx", "ny", "nz"}) csv.require(column);
  }
  std::vector<SunObserver> observers;
  for (std::size_t row = 0; row < csv.size(); ++row) {
    SunObserver observer;
    observer.name = csv.has("name") ? csv.text(row, "name") : fmt::format("observer {}", row + 1);
    observer.eye = frame.to_local(point_of(csv, row, "x", "y", "z"));
    if (has_normals && !csv.text(row, "nx").empty()) {
      const Vec3 normal = point_of(csv, row, "nx", "ny", "nz");
      if (!(length(normal) > 0.0)) throw InputError(csv.where(row) + ": the normal is zero");
      observer.facing = normalized(frame.direction_to_local(normal));
    }
    observers.push_back(std::move(observer));
  }
  if (observers.empty()) throw InputError(path.string() + ": there are no observers in it");
  return observers;
}

std::vector<SunObserver> read_path(const std::filesystem::path& path, const FileFrame& frame,
                                   double step_m) {
  if (!(step_m >= 0.01 && step_m <= 1000.0)) {
    throw InputError(fmt::format("--path-step {} metres is not in 0.01..1000", step_m));
  }
  const CsvInput csv = table_of_points(path);
  std::vector<Vec3> corners;
  for (std::size_t row = 0; row < csv.size(); ++row) {
    corners.push_back(frame.to_local(point_of(csv, row, "x", "y", "z")));
    if (corners.size() > 1 && !(length(corners.back() - corners[corners.size() - 2]) > 0.0)) {
      throw InputError(csv.where(row) + ": the path stands still");
    }
  }
  if (corners.size() < 2) throw InputError(path.string() + ": a path has two points or more");
  std::vector<SunObserver> observers;
  double begun = 0.0, next = 0.0;  // metres from the beginning
  for (std::size_t k = 1; k < corners.size(); ++k) {
    const double far = length(corners[k] - corners[k - 1]);
    const Vec3 ahead = normalized(corners[k] - corners[k - 1]);
    for (; next <= begun + far; next += step_m) {
      observers.push_back({fmt::format("path {:.4g} m", next),
                           corners[k - 1] + (next - begun) * ahead, ahead, true});
    }
    begun += far;
  }
  return observers;
}

std::vector<SunView> sun_views(const ReflectedSun& sun, const LitScene& lit,
                               const std::vector<SunObserver>& observers,
                               const std::function<SunInSky(const CivilTime&)>& sun_at,
                               Progress& progress) {
  const std::vector<FineSun> suns = fine_suns(sun.moments, sun_at);
  std::vector<std::vector<SunView>> each(observers.size());
  progress.begin("observers", observers.size());
  parallel_for(observers.size(), 1, [&](IndexRange range) {
    for (std::size_t o = range.begin; o < range.end; ++o) {
      for (std::size_t p = 0; p < sun.panels.size(); ++p) {
        progress.stop_if_cancelled();
        SunView view;
        view.observer = static_cast<std::uint32_t>(o);
        view.panel = static_cast<std::uint32_t>(p);
        PanelWatch(lit, sun.panels[p], observers[o]).append_to(each[o], suns, view);
      }
      progress.advance(1);
    }
  });
  std::vector<SunView> views;
  for (auto& some : each) views.insert(views.end(), some.begin(), some.end());
  progress.end(fmt::format("{} times of reflected sun in view", views.size()));
  return views;
}

CsvTable view_table(const std::vector<SunView>& views, const ReflectedSun& sun,
                    const std::vector<SunObserver>& observers) {
  CsvTable table(
      "observer,panel,from,to,azimuth_deg,altitude_deg,angle_deg,luminance_cd_m2,disc_share");
  for (const SunView& view : views) {
    table.add(observers[view.observer].name).add(sun.panel_names[view.panel]);
    table.add(iso_local(view.from)).add(iso_local(view.to));
    table.add(view.azimuth.in_degrees()).add(view.altitude.in_degrees());
    if (view.angle) {
      table.add(view.angle->in_degrees());
    } else {
      table.add("");
    }
    table.add(view.most.value()).add(view.most_share);
    table.end_row();
  }
  return table;
}

}  // namespace tenku
