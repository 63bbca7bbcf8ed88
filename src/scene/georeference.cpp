#include "scene/georeference.h"

#include <fmt/format.h>
#include <proj.h>

#include <GeographicLib/Geodesic.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/handle.h"
#include "scene/axis_order.h"

namespace tenku {
namespace {

using Context = Handle<PJ_CONTEXT, &proj_context_destroy>;
using Projection = Handle<PJ, &proj_destroy>;

Context make_context() {
  Context context(proj_context_create());
  if (!context) throw ResourceError("PROJ could not be started");
  proj_log_level(context.get(), PJ_LOG_NONE);
  return context;
}

bool all_digits(const std::string& text) {
  for (const char c : text) {
    if (std::isdigit(static_cast<unsigned char>(c)) == 0) return false;
  }
  return !text.empty();
}

/// The German surveys' names of their plane systems: `DE_DHDN_3GK4`, `ETRS89_UTM32`. Empty for
/// others.
std::string adv_name(const std::string& text) {
  constexpr std::string_view kPrefix = "urn:adv:crs:";
  if (!text.starts_with(kPrefix)) return "";
  const std::string plane = text.substr(kPrefix.size(), text.find('*') - kPrefix.size());
  static const std::map<std::string, int> kCodes{
      {"DE_DHDN_3GK2", 31466}, {"DE_DHDN_3GK3", 31467}, {"DE_DHDN_3GK4", 31468},
      {"DE_DHDN_3GK5", 31469}, {"ETRS89_UTM31", 25831}, {"ETRS89_UTM32", 25832},
      {"ETRS89_UTM33", 25833},
  };
  const auto code = kCodes.find(plane);
  return code == kCodes.end() ? "" : "EPSG:" + std::to_string(code->second);
}

/// The plane part of Japan's plane rectangular systems I to XIII with heights, EPSG:10162 to 10174,
/// which older registries do not have; other names as they are.
std::string without_japanese_heights(const std::string& name) {
  constexpr int kFirst = 10162, kLast = 10174, kFirstPlane = 6669;
  const auto colon = name.rfind(':');
  const std::string digits = name.substr(colon == std::string::npos ? 0 : colon + 1);
  if (name.find("EPSG") == std::string::npos || !all_digits(digits) || digits.size() != 5)
    return name;
  const int code = std::stoi(digits);
  return code < kFirst || code > kLast ? name
                                       : "EPSG:" + std::to_string(code - kFirst + kFirstPlane);
}

/// `http://www.opengis.net/def/crs/EPSG/0/6677` as `EPSG:6677`; PROJ reads names and URNs itself.
std::string proj_name(const std::string& text) {
  if (all_digits(text)) return "EPSG:" + text;
  if (std::string adv = adv_name(text); !adv.empty()) return adv;
  const auto at = text.find("/def/crs/");
  if (at == std::string::npos) return text;
  const std::string rest = text.substr(at + 9);
  const auto slash = rest.find('/'), last = rest.rfind('/');
  if (slash == std::string::npos || last == slash) return text;
  return rest.substr(0, slash) + ":" + rest.substr(last + 1);
}

/// An identifier (`EPSG:1`, a URN, both also compound), `+proj` or WKT. In what is none of these
/// PROJ looks for a title, which takes tenths of a second a name.
bool is_formal(const std::string& name) {
  if (name.starts_with('+') || name.find('[') != std::string::npos) return true;
  if (name.find(':') == std::string::npos) return false;
  return std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view(":,+-_.").find(static_cast<char>(c)) != std::string_view::npos;
  });
}

Projection create(PJ_CONTEXT* context, const std::string& text) {
  const std::string name = without_japanese_heights(proj_name(text));
  Projection crs(is_formal(name) ? proj_create(context, name.c_str()) : nullptr);
  if (!crs || proj_is_crs(crs.get()) == 0) {
    throw InputError("'" + text +
                     "' is not a coordinate reference system that PROJ knows; give "
                     "one with --crs EPSG:N");
  }
  return crs;
}

/// The horizontal part of a compound CRS; the CRS itself otherwise.
Projection horizontal_part(PJ_CONTEXT* context, Projection crs) {
  const PJ_TYPE type = proj_get_type(crs.get());
  if (type == PJ_TYPE_COMPOUND_CRS) {
    return horizontal_part(context, Projection(proj_crs_get_sub_crs(context, crs.get(), 0)));
  }
  if (type == PJ_TYPE_BOUND_CRS) {
    return horizontal_part(context, Projection(proj_get_source_crs(context, crs.get())));
  }
  return crs;
}

double axis_metres(PJ_CONTEXT* context, const PJ* crs) {
  const Projection system(proj_crs_get_coordinate_system(context, crs));
  double factor = 1.0;
  if (system) {
    proj_cs_get_axis_info(context, system.get(), 0, nullptr, nullptr, nullptr, &factor, nullptr,
                          nullptr, nullptr);
  }
  return factor;
}

std::string id_of(const PJ* crs, const std::string& otherwise) {
  const char* authority = proj_get_id_auth_name(crs, 0);
  const char* code = proj_get_id_code(crs, 0);
  if (authority == nullptr || code == nullptr) return otherwise;
  return std::string(authority) + ":" + code;
}

struct Degrees {
  double longitude, latitude;
};

/// From easting and northing to WGS 84.
class ToDegrees {
 public:
  explicit ToDegrees(const std::string& id) : context_(make_context()), id_(id) {
    const Projection crs = horizontal_part(context_.get(), create(context_.get(), id));
    const Projection wgs84(proj_create(context_.get(), "EPSG:4326"));
    const Projection raw(
        proj_create_crs_to_crs_from_pj(context_.get(), crs.get(), wgs84.get(), nullptr, nullptr));
    if (raw) transformation_.reset(proj_normalize_for_visualization(context_.get(), raw.get()));
    if (!transformation_) throw InputError(id + " cannot be turned into longitude and latitude");
  }

  Degrees operator()(double easting, double northing) const {
    proj_errno_reset(transformation_.get());
    const PJ_COORD out =
        proj_trans(transformation_.get(), PJ_FWD, proj_coord(easting, northing, 0, 0));
    if (!(std::isfinite(out.xy.x) && std::isfinite(out.xy.y) && std::abs(out.xy.y) <= 90.0)) {
      throw InputError("(" + std::to_string(easting) + ", " + std::to_string(northing) +
                       ") is no place in " + id_ + "; is the coordinate reference system right?");
    }
    return {out.xy.x, out.xy.y};
  }

 private:
  Context context_;
  std::string id_;
  Projection transformation_;
};

struct Line {
  double azimuth_deg, length_m;
};

Line geodesic(Degrees from, Degrees to) {
  double length_m = 0.0, azimuth = 0.0, azimuth_end = 0.0;
  GeographicLib::Geodesic::WGS84().Inverse(from.latitude, from.longitude, to.latitude, to.longitude,
                                           length_m, azimuth, azimuth_end);
  // The azimuth half way, where the point asked for lies.
  const double turned = std::remainder(azimuth_end - azimuth, 360.0);
  return {azimuth + 0.5 * turned, length_m};
}

}  // namespace

Crs Crs::parse(const std::string& text) {
  const Context context = make_context();
  const Projection whole = create(context.get(), text);
  Crs crs;
  crs.id = id_of(whole.get(), text);
  crs.name = proj_get_name(whole.get());
  const char* area = nullptr;
  double w = 0, s = 0, e = 0, n = 0;
  if (proj_get_area_of_use(context.get(), whole.get(), &w, &s, &e, &n, &area) != 0 && w > -1000.0) {
    crs.west = w, crs.south = s, crs.east = e, crs.north = n;
  }
  const Projection flat = horizontal_part(context.get(), create(context.get(), text));
  const PJ_TYPE type = proj_get_type(flat.get());
  crs.geographic = type == PJ_TYPE_GEOGRAPHIC_2D_CRS || type == PJ_TYPE_GEOGRAPHIC_3D_CRS;
  if (!crs.geographic && type != PJ_TYPE_PROJECTED_CRS) {
    throw InputError(crs.id + " (" + crs.name +
                     ") is neither a map projection nor latitude and longitude; convert the "
                     "scene to a projected system such as UTM");
  }
  if (!crs.geographic) crs.metres_per_unit = axis_metres(context.get(), flat.get());
  return crs;
}

bool is_northing_first(const std::string& crs) {
  const Context context = make_context();
  const Projection flat = horizontal_part(context.get(), create(context.get(), crs));
  const Projection system(proj_crs_get_coordinate_system(context.get(), flat.get()));
  const char* direction = nullptr;
  if (system) {
    proj_cs_get_axis_info(context.get(), system.get(), 0, nullptr, nullptr, &direction, nullptr,
                          nullptr, nullptr, nullptr);
  }
  return direction != nullptr && std::string_view(direction) == "north";
}

Georeference Crs::at(Vec3 p) const {
  const ToDegrees to_degrees(id);
  const double step = 100.0 / metres_per_unit;
  const Degrees here = to_degrees(p.x, p.y);
  const Line northward = geodesic(to_degrees(p.x, p.y - step), to_degrees(p.x, p.y + step));
  const Line eastward = geodesic(to_degrees(p.x - step, p.y), to_degrees(p.x + step, p.y));
  Georeference where;
  where.crs = id;
  where.name = name;
  where.origin = {Angle::degrees(here.latitude), Angle::degrees(here.longitude), p.z};
  const double quarter_error =
      std::remainder(eastward.azimuth_deg - 90.0 - northward.azimuth_deg, 360.0);
  where.grid_convergence =
      Angle::degrees(std::remainder(northward.azimuth_deg + 0.5 * quarter_error, 360.0));
  where.metres_per_unit = metres_per_unit;
  where.point_scale = 2.0 * 2.0 * step * metres_per_unit / (northward.length_m + eastward.length_m);
  if (!(where.point_scale > 0.5 && where.point_scale < 2.0)) {
    throw InputError("(" + std::to_string(p.x) + ", " + std::to_string(p.y) +
                     ") is too far from the places for which " + id + " is made");
  }
  return where;
}

std::string map_about(const Location& place) {
  return fmt::format("+proj=tmerc +lat_0={:.9f} +lon_0={:.9f} +k=1 +ellps=GRS80 +units=m +type=crs",
                     place.latitude.in_degrees(), place.longitude.in_degrees());
}

}  // namespace tenku
