/// A sky as files: its elements to look at in 3D, its luminance as a picture.
#pragma once

#include <filesystem>

#include "output/field_writer.h"
#include "sky_models/make_sky.h"
#include "sky_models/sky_partition.h"
#include "view/image.h"

namespace tenku {

/// The elements as polygons on a dome of radius 1 about the observer.
///
/// Shape    cell arrays `luminance_cd_m2`, `solid_angle_sr` and `illuminance_lux` (what the
///          element gives to an unobstructed horizontal plane), in the order of the elements.
FieldMesh sky_mesh(const Sky& sky, const SkyPartition& partition);

/// The luminance of all directions, cd/m2, without the solar disc: black below the horizon.
///
/// Frame    latitude-longitude, twice as wide as high. The top row is the zenith; the centre
///          column looks north, to its right east, as the sky appears to someone standing under
///          it. `image:FILE` reads this picture back as a sky.
Image sky_panorama(const Sky& sky, int height = 512);

/// The dome as a plan in false colours, with a legend.
///
/// Frame    the zenith in the middle, the horizon on the circle, north up, east to the right, as
///          in a sun-path diagram; distance from the middle is the angle from the zenith. A ring
///          marks the sun, if there is one.
Image8 sky_plan(const Sky& sky, int diameter = 640);

/// Whether `write_sky` knows the ending of `path`: .vtp, .hdr, .exr, .png.
bool is_sky_output(const std::filesystem::path& path);

/// Writes the mesh (.vtp), the panorama (.hdr, .exr) or the plan (.png), by the ending.
/// @throws InputError for another ending, or as the writers do
void write_sky(const std::filesystem::path& path, const Sky& sky, const SkyPartition& partition);

}  // namespace tenku
