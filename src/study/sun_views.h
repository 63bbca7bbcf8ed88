/// When an observer has the reflected sun in view.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "output/table_writer.h"
#include "study/reflected_sun.h"

namespace tenku {

/// A place from which one looks.
struct SunObserver {
  std::string name;
  Vec3 eye;                     ///< local
  std::optional<Vec3> facing;   ///< unit; of a window its outer normal, on a path the way ahead
  bool sees_all_round = false;  ///< else only what lies before `facing`'s plane
};

/// Reads `name,x,y,z[,nx,ny,nz]`: points, or windows with their outer normals, in the coordinates
/// of the scene file.
/// @throws InputError naming file and line
std::vector<SunObserver> read_observers(const std::filesystem::path& path, const FileFrame& frame);

/// Reads `x,y,z`, the corners of a path of the eye, and puts an observer on it every `step_m`
/// metres: `path 0 m`, `path 5 m` ...
/// @throws InputError naming file and line, if there are not two corners, or the step is not in
///         0.01 .. 1000 m
std::vector<SunObserver> read_path(const std::filesystem::path& path, const FileFrame& frame,
                                   double step_m);

/// A time during which an observer sees the sun in a panel.
struct SunView {
  std::uint32_t observer = 0, panel = 0;
  CivilTime from, to;
  Angle azimuth, altitude;     ///< of where it is seen, when most of the disc is
  std::optional<Angle> angle;  ///< from `facing`, the smallest
  Luminance most{};            ///< of the disc in the panel
  double most_share = 0.0;     ///< of the disc that is seen at once
};

/// How finely time is gone through.
inline constexpr double kViewStep_s = 30.0;

/// Follows the sun from instant to instant every 30 s and mirrors the eye in each panel: the sun is
/// in view while part of its disc lies in the panel as the mirrored eye sees it and rays find both
/// ways free. One mirror; light that met two is not looked for.
///
/// Error    beginning and end within 30 s, while the sun goes 0.13 degrees; the share of the disc
///          from 61 points. Views of under 2 % of the disc, and panels that look thinner than 0.07
///          degrees, can be missed.
/// @param sun  its moments must have times; those of one day are joined
/// @param direction_at  the sun's direction at an instant
std::vector<SunView> sun_views(const ReflectedSun& sun, const LitScene& lit,
                               const std::vector<SunObserver>& observers,
                               const std::function<SunInSky(const CivilTime&)>& sun_at,
                               Progress& progress);

/// A row for each view.
///
/// Shape    `observer,panel,from,to,azimuth_deg,altitude_deg,angle_deg,luminance_cd_m2,disc_share`
CsvTable view_table(const std::vector<SunView>& views, const ReflectedSun& sun,
                    const std::vector<SunObserver>& observers);

}  // namespace tenku
