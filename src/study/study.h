/// What a study asks for: the content of a study file, before anything of it is done.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/units.h"
#include "core/vec3.h"
#include "illuminance/light_method.h"
#include "scene/read_scene.h"
#include "site/location.h"
#include "sky_models/sky_partition.h"
#include "view/mirror_method.h"
#include "visibility/gl_context.h"

namespace tenku {

/// The scene file and how to read it.
struct StudyScene {
  std::filesystem::path file;
  std::string building_lod;  ///< empty: the highest of each object; or `1`, `2.2`
  std::optional<std::filesystem::path> materials;
  std::string crs;              ///< `EPSG:N`, in place of what the file says; or empty
  std::string ground = "auto";  ///< `auto`, `none`, or a height in the coordinates of the file
  std::vector<std::filesystem::path> terrain;  ///< elevation models beside the scene
  std::string on_terrain = "auto";             ///< `auto`, `keep` or `move`
  std::optional<PlaceLookedAt> around;
  std::string up;                ///< `y`, `z`, or empty: by the format
  double scale = 1.0;            ///< metres per unit of the file
  Angle rotate;                  ///< clockwise, seen from above
  std::optional<Location> site;  ///< in place of the scene's own georeference
};

/// When, and the sun.
struct StudyTime {
  std::string at;    ///< ISO 8601; empty only where the sun is given directly
  std::string zone;  ///< IANA name, `solar` for mean solar time at the site, or empty
  std::optional<Angle> sun_altitude, sun_azimuth;  ///< both or neither
};

struct StudySky {
  std::string model = "cie:12";                ///< as `--sky`; file names in it are resolved
  std::optional<Illuminance> sky_illuminance;  ///< unobstructed, horizontal, diffuse
  std::optional<Illuminance> sun_illuminance;  ///< direct normal; 0: no sun
};

struct StudyCalculation {
  double tolerance_percent = 2.0;  ///< of each value
  int bounces = 5;
  std::uint64_t seed = 1;
  EngineChoice engine = EngineChoice::Auto;
  Detail detail = Detail::Budget;
  Reflection reflection = Reflection::Auto;
  double mu = 1.0;     ///< of `Detail::Paper`
  std::string decide;  ///< as `--decide`, checked; empty: nothing
  GlPlatform gl = GlPlatform::Auto;
  std::optional<PartitionRequest> partition;  ///< sky elements by hand; else slices
};

enum class ViewKind { LuminanceImage, IlluminanceImage, FalseColour };

/// A perspective view.
struct StudyView {
  std::string name;
  std::optional<Vec3> eye, target;  ///< in the coordinates of the scene file; both or neither
  Angle field_of_view = Angle::degrees(50.0);  ///< horizontal
  std::array<int, 2> size{960, 640};           ///< pixels, width and height
  ViewKind show = ViewKind::LuminanceImage;
  std::vector<std::string> formats{"png"};  ///< of `png`, `exr`, `hdr`, each once
  MirrorOptions mirrors;
  std::string background;  ///< `cube:FOLDER` or `image:FILE`, the path whole; empty: the sky
  Luminance background_white{10'000.0};
};

/// Illuminance of the surfaces of the scene.
struct StudyField {
  std::string name;
  std::vector<std::string> surfaces{"ground", "roofs", "walls"};
  double spacing_m = 2.0;
  std::size_t most_sensors = 5'000'000;  ///< beyond, the spacing is widened
};

/// Illuminance at sensors from a file.
struct StudySensors {
  std::string name;
  std::filesystem::path file;
};

/// False-colour map of the illuminance of the ground, seen from above.
struct StudyPlan {
  double spacing_m = 1.0;
  std::optional<Illuminance> lowest, highest;  ///< ends of the colour scale; else by the values
};

struct StudyReport {
  std::string title, author;
  bool sun_path = true;
};

/// A whole study.
///
/// Frame    points are in the coordinates of the scene file; paths are resolved against the
///          folder of the study file.
struct Study {
  std::filesystem::path file;  ///< the study file
  StudyScene scene;
  StudyTime time;
  StudySky sky;
  StudyCalculation calculation;
  std::vector<StudyView> views;
  std::vector<StudyField> fields;
  std::vector<StudySensors> sensors;
  std::optional<StudyPlan> plan;
  std::optional<StudyReport> report;
};

}  // namespace tenku
