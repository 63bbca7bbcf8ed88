#include "scene/placement.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "scene/axis_order.h"
#include "scene/repair.h"

namespace tenku {
namespace {

constexpr double kFar_m = 20000.0;      // float has 2 mm at this distance
constexpr double kHighest_m = 10000.0;  // no ground is higher; heights beyond are offsets
constexpr double kDegreesBeyond = 2.0;  // tolerance about the area of use of a CRS

Vec3 rounded(Vec3 p) { return {std::round(p.x), std::round(p.y), std::round(p.z)}; }

/// Between file, grid (easting, northing, height; still in the grid's units) and back.
struct GridMap {
  GridAxes axes;
  double scale;

  Vec3 to_grid(Vec3 file) const {
    return scale * Vec3{dot(axes.easting, file), dot(axes.northing, file), dot(axes.height, file)} +
           axes.offset;
  }
  Vec3 to_file(Vec3 grid) const {
    const Vec3 p = (1.0 / scale) * (grid - axes.offset);
    return p.x * axes.easting + p.y * axes.northing + p.z * axes.height;
  }
};

/// Turned clockwise seen from above, then scaled; heights scaled apart.
FileFrame frame_of(const GridMap& map, Vec3 grid_origin, Angle clockwise, double across,
                   double upward) {
  const double c = map.scale * across * std::cos(clockwise.in_radians());
  const double s = map.scale * across * std::sin(clockwise.in_radians());
  const GridAxes& a = map.axes;
  return FileFrame::affine(map.to_file(grid_origin),
                           {c * a.easting + s * a.northing, -s * a.easting + c * a.northing,
                            map.scale * upward * a.height});
}

bool contains(const Crs& crs, double latitude, double longitude, double beyond = kDegreesBeyond) {
  const bool wraps = crs.west > crs.east;  // across the date line
  const bool is_east = longitude >= crs.west - beyond, is_west = longitude <= crs.east + beyond;
  return (wraps ? is_east || is_west : is_east && is_west) && latitude >= crs.south - beyond &&
         latitude <= crs.north + beyond;
}

double median(const std::vector<Vec3>& points, double Vec3::*coordinate) {
  std::vector<double> values;
  values.reserve(points.size());
  for (const Vec3 p : points) values.push_back(p.*coordinate);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Drops surfaces with a vertex that is degrees away from most: a projection of the scene cannot
/// hold them.
void drop_misplaced(RawScene& raw) {
  Scene& scene = raw.scene;
  const Vec3 middle{median(scene.vertices, &Vec3::x), median(scene.vertices, &Vec3::y), 0.0};
  const auto is_misplaced = [&](std::uint32_t v) {
    const Vec3 p = scene.vertices[v];
    return std::abs(p.x - middle.x) > kDegreesBeyond || std::abs(p.y - middle.y) > kDegreesBeyond;
  };
  const std::size_t dropped = drop_surfaces(raw, [&](std::size_t s) {
    const Surfaces& surfaces = scene.surfaces;
    const auto first = surfaces.vertex.begin() + surfaces.first_vertex[surfaces.first_ring[s]];
    const auto last = surfaces.vertex.begin() + surfaces.first_vertex[surfaces.first_ring[s + 1]];
    if (std::none_of(first, last, is_misplaced)) return false;
    raw.findings.add({"misplaced_surface", Severity::Error, raw.object_of(s), "",
                      "a vertex lies more than 2 degrees from most of the scene", "left out"});
    return true;
  });
  if (dropped == 0) return;
  merge_vertices(raw);
  scene.extent = extent_of(scene.vertices);
}

void place_geographic(RawScene& raw, const Crs& crs, const ReadOptions& options) {
  if (options.scale != 1.0) throw InputError("--scale makes no sense for coordinates in degrees");
  drop_misplaced(raw);
  const Extent box = raw.scene.extent;
  Vec3 centre = 0.5 * (box.min + box.max);
  centre = {1e-6 * std::round(1e6 * centre.x), 1e-6 * std::round(1e6 * centre.y), 0.0};
  const bool latitude_first = is_latitude_first(crs, centre, raw.has_registry_axes);
  raw.findings.add(
      {"degrees", Severity::Note, "", "", "the coordinates are degrees (" + crs.id + ")",
       latitude_first ? "read as latitude, longitude" : "read as longitude, latitude"});
  const double latitude = latitude_first ? centre.x : centre.y;
  const double longitude = latitude_first ? centre.y : centre.x;
  raw.scene.frame = FileFrame::geographic(centre, latitude_first, options.rotate);
  raw.scene.map_frame =
      FileFrame::geographic(latitude_first ? Vec3{centre.y, centre.x, centre.z} : centre, false);
  Georeference where;
  where.crs = crs.id;
  where.name = crs.name;
  where.origin = {Angle::degrees(latitude), Angle::degrees(longitude), 0.0};
  raw.scene.georeference = where;
}

Vec3 grid_centre(const RawScene& raw, const GridMap& map) {
  const Extent& box = raw.scene.extent;
  Vec3 centre = rounded(map.to_grid(0.5 * (box.min + box.max)));
  if (std::abs(centre.z) < kHighest_m) centre.z = 0.0;
  return centre;
}

/// A file whose reference system has the axes of a registry that has northing first: easting and
/// northing change places, unless only that order lies where the system is used.
void choose_grid_axes(RawScene& raw, const Crs& crs, GridMap& map) {
  if (!raw.has_registry_axes || raw.axes_are_given || !is_northing_first(crs.id)) return;
  const auto is_inside = [&](const GridMap& candidate) {
    try {
      const Location at = crs.at(grid_centre(raw, candidate)).origin;
      return contains(crs, at.latitude.in_degrees(), at.longitude.in_degrees(), 0.0);
    } catch (const InputError&) {
      return false;
    }
  };
  GridMap swapped = map;
  std::swap(swapped.axes.easting, swapped.axes.northing);
  const bool as_registered = is_inside(swapped) || !is_inside(map);
  raw.findings.add({"axis_order", as_registered ? Severity::Note : Severity::Warning, "", "",
                    crs.id + " has northing before easting",
                    as_registered
                        ? "read so; --crs " + crs.id + " reads x east, y north"
                        : "read as easting, northing: the other order is outside its area"});
  if (as_registered) map = swapped;
}

void place_projected(RawScene& raw, const Crs& crs, const GridMap& map, Angle rotate) {
  const Vec3 origin = grid_centre(raw, map);
  const Georeference where = crs.at(origin);
  raw.scene.frame = frame_of(map, origin, where.grid_convergence + rotate,
                             where.metres_per_unit / where.point_scale, where.metres_per_unit);
  raw.scene.map_frame = frame_of({GridAxes{}, 1.0}, origin, where.grid_convergence,
                                 where.metres_per_unit / where.point_scale, where.metres_per_unit);
  raw.scene.georeference = where;
  const Location& at = where.origin;
  if (!contains(crs, at.latitude.in_degrees(), at.longitude.in_degrees())) {
    raw.findings.add({"outside_crs_area", Severity::Warning, "", "",
                      "the scene lies outside the area for which " + crs.id + " is made",
                      "check the coordinate reference system; --crs gives another"});
  }
}

void place_without_crs(RawScene& raw, const GridMap& map, Angle rotate) {
  const Extent& box = raw.scene.extent;
  const Vec3 centre = map.to_grid(0.5 * (box.min + box.max));
  Vec3 origin{};
  const bool is_far = std::max(std::abs(centre.x), std::abs(centre.y)) > kFar_m;
  if (!raw.place && (is_far || std::abs(centre.z) > kFar_m)) origin = grid_centre(raw, map);
  raw.scene.frame = frame_of(map, origin, rotate, 1.0, 1.0);
  raw.scene.map_frame = FileFrame::affine(origin, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  if (raw.place) {
    Georeference where;
    where.origin = *raw.place;
    raw.scene.georeference = where;
  }
}

/// A CityGML model has a place on Earth: small numbers under a name that means nothing are degrees,
/// which are not to be read as metres.
void refuse_degrees(const RawScene& raw, const std::string& why) {
  const Extent& box = raw.scene.extent;
  const double largest = std::max(
      {std::abs(box.min.x), std::abs(box.max.x), std::abs(box.min.y), std::abs(box.max.y)});
  if (!raw.scene.format.starts_with("CityGML") || largest > 180.0) return;
  throw InputError(why + "; the coordinates look like degrees");
}

std::optional<Crs> crs_of(RawScene& raw, const ReadOptions& options) {
  if (!options.crs.empty()) return Crs::parse(options.crs);
  if (raw.crs.empty()) return std::nullopt;
  try {
    return Crs::parse(raw.crs);
  } catch (const InputError& error) {
    refuse_degrees(raw, error.what());
    raw.findings.add({"unusable_crs", Severity::Warning, "", "", error.what(),
                      "read as metres, x east, y north, without a place on Earth"});
    return std::nullopt;
  }
}

void place_by_crs(RawScene& raw, const Crs& crs, GridMap map, const ReadOptions& options) {
  try {
    if (crs.geographic) return place_geographic(raw, crs, options);
    choose_grid_axes(raw, crs, map);
    place_projected(raw, crs, map, options.rotate);
  } catch (const InputError& error) {
    if (!options.crs.empty() || options.scale != 1.0) throw;
    refuse_degrees(raw, error.what());
    raw.findings.add({"unusable_crs", Severity::Warning, "", "", error.what(),
                      "read as metres, x east, y north, without a place on Earth"});
    place_without_crs(raw, map, options.rotate);
  }
}

}  // namespace

bool is_latitude_first(const Crs& crs, Vec3 at, bool has_registry_axes) {
  const bool first = contains(crs, at.x, at.y), second = contains(crs, at.y, at.x);
  if (!first && !second) {
    throw InputError("(" + std::to_string(at.x) + ", " + std::to_string(at.y) +
                     ") is no place in " + crs.id + " (" + crs.name + ")");
  }
  // Where both orders are possible a name of the registry decides; else longitude is first.
  return first && (!second || (has_registry_axes && is_northing_first(crs.id)));
}

void place_scene(RawScene& raw, const ReadOptions& options) {
  Scene& scene = raw.scene;
  if (!(options.scale > 0.0) || !std::isfinite(options.scale)) {
    throw InputError("--scale must be a positive number, not " + std::to_string(options.scale));
  }
  scene.extent = extent_of(scene.vertices);
  if (options.up == UpAxis::Y && !raw.axes_are_given) raw.axes = kYUpAxes;
  if (options.up == UpAxis::Z) raw.axes = GridAxes{};
  const GridMap map{raw.axes, options.scale * raw.metres_per_unit};
  // A CRS of the options brings its own manner of naming.
  if (!options.crs.empty())
    raw.has_registry_axes &= options.crs.find("/def/crs/") != std::string::npos;
  const std::optional<Crs> crs = crs_of(raw, options);
  if (crs) {
    place_by_crs(raw, *crs, map, options);
  } else {
    place_without_crs(raw, map, options.rotate);
    if (raw.crs.empty() && !raw.is_mesh && !options.site) {
      raw.findings.add({"missing_crs", Severity::Warning, "", "",
                        "the file names no coordinate reference system",
                        "read as metres, x east, y north; give --crs EPSG:N, or --lat and --lon"});
    }
  }
  scene.is_city |= scene.georeference.has_value();
  if (options.site) {
    if (!scene.georeference) scene.georeference.emplace();
    scene.georeference->origin = *options.site;
  }
  for (Vec3& v : scene.vertices) v = scene.frame.to_local(v);
}

}  // namespace tenku
