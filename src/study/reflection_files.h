/// Reflected sunlight as files.
#pragma once

#include <filesystem>
#include <string>

#include "output/field_writer.h"
#include "output/table_writer.h"
#include "study/reflected_sun.h"

namespace tenku {

/// A row for each polygon.
///
/// Shape    `time,from,to,object,surface_type,lux,area_m2,blur_m,mirrors,panels,x,y,z,polygon`:
///          `from` and `to` are half a step before and after; `panels` are apart by blanks; x, y, z
///          is the middle and `polygon` the outline (`POLYGON Z` of OGC 06-103r4), both in the
///          coordinates of the scene file.
CsvTable polygon_table(const ReflectedSun& sun, const LitScene& lit);

/// A row for each panel.
///
/// Shape    `panel,x,y,z,area_m2,azimuth_deg,tilt_deg,first,last,minutes,most_lux,most_lm,
///          thrown_lmh,reflectance,least_lit`. The azimuth is that of the front side; `tilt_deg` is
///          0 for one that faces up and 90 for a wall.
CsvTable panel_table(const ReflectedSun& sun, const LitScene& lit);

/// A row for each time during which a panel throws light on an object.
///
/// Shape    `panel,object,from,to,most_lux,most_area_m2`
CsvTable window_table(const ReflectedSun& sun, const LitScene& lit);

/// The polygons as GeoJSON: features with the columns of `polygon_table` as properties.
///
/// Longitudes, latitudes and heights where the scene knows its place, as RFC 7946 asks; else the
/// coordinates of the scene file. Rings run counter-clockwise on the map; walls have no area there.
std::string geojson_of(const ReflectedSun& sun, const LitScene& lit);

/// The polygons with cell arrays `lux`, `blur_m`, `mirrors`, `panel_count`, codes `time`,
/// `object_id`, `surface_type` and `panel` (the first of them), and what leads back to the file.
FieldMesh reflection_field(const ReflectedSun& sun, const LitScene& lit);

/// Whether `write_reflections` knows the ending: .csv, .geojson, .json, .vtp; or `-`, a table.
bool is_reflection_output(const std::filesystem::path& path);
/// @throws InputError, ResourceError as the writers do
void write_reflections(const std::filesystem::path& path, const ReflectedSun& sun,
                       const LitScene& lit);

}  // namespace tenku
