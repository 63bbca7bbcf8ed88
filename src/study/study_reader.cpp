#include "study/study_reader.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <set>
#include <system_error>

#include "core/error.h"
#include "illuminance/decision.h"
#include "study/toml_section.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string_view>;

struct KnownTable {
  std::string_view name;
  Words keys;
};

// docs/study.md has the same tables and keys; a test compares them.
const std::vector<KnownTable>& known_tables() {
  static const std::vector<KnownTable> kTables{
      {"scene",
       {"file", "lod", "materials", "crs", "ground", "terrain", "on_terrain", "around", "up",
        "scale", "rotate_deg"}},
      {"site", {"latitude_deg", "longitude_deg", "elevation_m"}},
      {"time", {"at", "zone"}},
      {"sun", {"altitude_deg", "azimuth_deg", "illuminance_lx"}},
      {"sky", {"model", "illuminance_lx"}},
      {"calculation",
       {"tolerance_percent", "bounces", "seed", "engine", "reflection", "gl", "lod", "mu",
        "partition", "elements", "energy_threshold_lx", "decide"}},
      {"view",
       {"name", "eye", "target", "fov_deg", "size", "show", "files", "mirrors", "depth",
        "background", "background_white_cd_m2"}},
      {"illuminance", {"name", "surfaces", "spacing_m", "most_sensors"}},
      {"sensors", {"name", "file"}},
      {"plan", {"spacing_m", "lowest_lx", "highest_lx"}},
      {"report", {"title", "author", "sun_path"}},
  };
  return kTables;
}

const Words& keys_of(std::string_view table) {
  const auto& all = known_tables();
  return std::find_if(all.begin(), all.end(), [&](const auto& t) { return t.name == table; })->keys;
}

TomlSection section(const TomlSection& document, std::string_view name) {
  TomlSection result = document.table(name);
  result.refuse_unknown_keys(keys_of(name));
  return result;
}

std::vector<TomlSection> sections(const TomlSection& document, std::string_view name) {
  std::vector<TomlSection> result = document.tables(name);
  for (const TomlSection& each : result) each.refuse_unknown_keys(keys_of(name));
  return result;
}

std::optional<Angle> angle(const TomlSection& section, std::string_view key, NumberRange range) {
  const auto value = section.number(key, range);
  return value ? std::optional(Angle::degrees(*value)) : std::nullopt;
}

std::optional<Illuminance> illuminance(const TomlSection& section, std::string_view key,
                                       NumberRange range = {0.0, 1e7}) {
  const auto value = section.number(key, range);
  return value ? std::optional(Illuminance(*value)) : std::nullopt;
}

void refuse_one_without_other(const TomlSection& section, std::string_view a, std::string_view b) {
  if (section.has(a) == section.has(b)) return;
  const auto& given = section.has(a) ? a : b;
  const auto& absent = section.has(a) ? b : a;
  section.refuse(given, std::string(given) + " needs " + std::string(absent) + " beside it");
}

// A height is kept as text, as the command line has it.
std::string ground_of(const TomlSection& in) {
  const auto text = in.text_or_number("ground", {-12000.0, 10000.0});
  if (!text) return "auto";
  const bool is_number = text->find_first_not_of("+-.0123456789e") == std::string::npos;
  if (*text != "auto" && *text != "none" && !is_number) {
    in.refuse("ground", "ground in [scene] must be 'auto', 'none' or a height in metres");
  }
  return *text;
}

std::optional<PlaceLookedAt> around_of(const TomlSection& in) {
  const auto point = in.point("around");
  if (!point) return std::nullopt;
  const PlaceLookedAt place{point->x, point->y, point->z};
  if (!(place.half_m > 0.0)) in.refuse("around", "the last is a distance in metres, above 0");
  return place;
}

StudyScene scene_of(const TomlSection& in, const fs::path& folder) {
  static constexpr std::array<std::string_view, 2> kUp{"y", "z"};
  static constexpr std::array<std::string_view, 3> kOnTerrain{"auto", "keep", "move"};
  StudyScene scene;
  if (const auto file = in.text("file")) scene.file = folder / *file;
  const std::string lod = in.text_or_number("lod", {0.0, 9.0}).value_or("highest");
  if (lod != "highest") scene.building_lod = lod;
  if (const auto file = in.text("materials")) scene.materials = folder / *file;
  scene.crs = in.text("crs").value_or("");
  scene.ground = ground_of(in);
  if (const auto file = in.text("terrain")) scene.terrain = {folder / *file};
  scene.on_terrain = in.choice("on_terrain", kOnTerrain).value_or("auto");
  scene.around = around_of(in);
  scene.up = in.choice("up", kUp).value_or("");
  scene.scale = in.number("scale", {0.0, 1e6, true}).value_or(1.0);
  scene.rotate = angle(in, "rotate_deg", {-360.0, 360.0}).value_or(Angle());
  return scene;
}

std::optional<Location> site_of(const TomlSection& in) {
  if (!in.is_there()) return std::nullopt;
  Location site;
  const auto latitude = angle(in, "latitude_deg", {-90.0, 90.0});
  const auto longitude = angle(in, "longitude_deg", {-180.0, 360.0});
  if (!latitude || !longitude) in.refuse("", "[site] needs latitude_deg and longitude_deg");
  site.latitude = *latitude;
  site.longitude = *longitude;
  site.elevation_m = in.number("elevation_m", {-12000.0, 100000.0}).value_or(0.0);
  return site;
}

StudyTime time_of(const TomlSection& time, const TomlSection& sun) {
  StudyTime result;
  result.at = time.time("at").value_or("");
  result.zone = time.text("zone").value_or("");
  result.sun_altitude = angle(sun, "altitude_deg", {-90.0, 90.0});
  result.sun_azimuth = angle(sun, "azimuth_deg", {-360.0, 360.0});
  refuse_one_without_other(sun, "altitude_deg", "azimuth_deg");
  return result;
}

StudySky sky_of(const TomlSection& in, const TomlSection& sun, const fs::path& folder) {
  StudySky sky;
  sky.model = in.text("model").value_or(sky.model);
  for (const std::string kind : {"weather:", "image:"}) {
    if (sky.model.rfind(kind, 0) == 0) {
      sky.model = kind + (folder / sky.model.substr(kind.size())).string();
    }
  }
  sky.sky_illuminance = illuminance(in, "illuminance_lx");
  sky.sun_illuminance = illuminance(sun, "illuminance_lx");
  return sky;
}

std::optional<PartitionRequest> partition_of(const TomlSection& in) {
  const auto method = in.text("partition");
  const auto elements = in.integer("elements", {1, 1e6});
  const auto threshold = in.number("energy_threshold_lx", {0.0, 1e7, true});
  if (!method && !elements && !threshold) return std::nullopt;
  try {
    PartitionRequest request = parse_partition(method.value_or("adaptive"));
    if (elements) request.elements = static_cast<std::size_t>(*elements);
    request.energy_threshold_lux = threshold;
    check_partition(request);
    return request;
  } catch (const InputError& error) {
    in.refuse(method ? "partition" : "elements", error.what());
  }
}

std::string decide_of(const TomlSection& in) {
  const std::string text = in.text("decide").value_or("");
  try {
    if (in.has("decide")) decision_threshold(text);
  } catch (const InputError& error) {
    in.refuse("decide", error.what());
  }
  return text;
}

StudyCalculation calculation_of(const TomlSection& in) {
  static constexpr std::array<std::string_view, 3> kEngines{"auto", "rays", "shadow-maps"};
  static constexpr std::array<std::string_view, 3> kPlatforms{"auto", "osmesa", "egl"};
  static constexpr std::array<std::string_view, 3> kReflections{"auto", "radiosity", "paths"};
  static constexpr std::array<std::string_view, 3> kDetails{"off", "paper", "budget"};
  StudyCalculation result;
  result.tolerance_percent =
      in.number("tolerance_percent", {0.0, 100.0, true}).value_or(result.tolerance_percent);
  result.bounces = static_cast<int>(in.integer("bounces", {0, 1000}).value_or(result.bounces));
  result.seed = static_cast<std::uint64_t>(in.integer("seed", {0, 9007199254740992.0}).value_or(1));
  if (const auto name = in.choice("engine", kEngines)) result.engine = engine_named(*name);
  if (const auto name = in.choice("gl", kPlatforms)) result.gl = gl_platform_named(*name);
  if (const auto name = in.choice("reflection", kReflections)) {
    result.reflection = reflection_named(*name);
  }
  if (const auto name = in.choice("lod", kDetails)) result.detail = detail_named(*name);
  result.mu = in.number("mu", {0.0, 1e9, true}).value_or(result.mu);
  result.partition = partition_of(in);
  result.decide = decide_of(in);
  return result;
}

// Names become names of files.
std::string name_of(const TomlSection& in, const std::string& otherwise,
                    std::set<std::string>& taken) {
  std::string name = in.text("name").value_or(otherwise);
  const auto fits = [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_';
  };
  if (name.size() > 100 || !std::all_of(name.begin(), name.end(), fits)) {
    in.refuse("name", "a name becomes the name of a file: letters, digits, '-' and '_', up to 100");
  }
  if (!taken.insert(name).second) {
    in.refuse("name", "the name '" + name + "' is taken by another output; give each its own");
  }
  return name;
}

ViewKind view_kind_named(const std::string& name) {
  if (name == "illuminance") return ViewKind::IlluminanceImage;
  return name == "falsecolor" ? ViewKind::FalseColour : ViewKind::LuminanceImage;
}

/// `cube:FOLDER` or `image:FILE` with the path taken from the folder of the study.
std::string background_of(const TomlSection& in, const fs::path& folder) {
  const auto text = in.text("background");
  if (!text) return "";
  const std::size_t colon = text->find(':');
  const std::string kind = text->substr(0, colon);
  if (colon == std::string::npos || (kind != "cube" && kind != "image")) {
    in.refuse("background", "background in [view] must be cube:FOLDER or image:FILE");
  }
  return kind + ":" + (folder / text->substr(colon + 1)).string();
}

void read_mirrors(const TomlSection& in, const fs::path& folder, StudyView& view) {
  static constexpr std::array<std::string_view, 4> kMethods{"auto", "beams", "rays", "off"};
  if (const auto name = in.choice("mirrors", kMethods)) {
    view.mirrors.method = mirror_method_named(*name);
  }
  view.mirrors.depth = static_cast<int>(in.integer("depth", {0, 64}).value_or(view.mirrors.depth));
  view.mirrors.light_all = view.show == ViewKind::IlluminanceImage;
  view.background = background_of(in, folder);
  if (const auto white = in.number("background_white_cd_m2", {0.0, 1e12, true})) {
    view.background_white = Luminance(*white);
  }
}

StudyView view_of(const TomlSection& in, const fs::path& folder, std::set<std::string>& taken) {
  static constexpr std::array<std::string_view, 3> kShow{"luminance", "illuminance", "falsecolor"};
  static constexpr std::array<std::string_view, 3> kFormats{"png", "exr", "hdr"};
  StudyView view;
  view.name = name_of(in, "view", taken);
  view.eye = in.point("eye");
  view.target = in.point("target");
  refuse_one_without_other(in, "eye", "target");
  if (view.eye && *view.eye == *view.target) in.refuse("target", "target is where eye is");
  view.field_of_view = angle(in, "fov_deg", {1.0, 170.0}).value_or(view.field_of_view);
  if (const auto size = in.numbers("size", 2, {1, 16384})) {
    if (!((*size)[0] == static_cast<int>((*size)[0]) &&
          (*size)[1] == static_cast<int>((*size)[1]))) {
      in.refuse("size", "size in [view] must be whole numbers of pixels");
    }
    view.size = {static_cast<int>((*size)[0]), static_cast<int>((*size)[1])};
  }
  view.show = view_kind_named(in.choice("show", kShow).value_or("luminance"));
  view.formats = in.choice_list("files", kFormats).value_or(view.formats);
  read_mirrors(in, folder, view);
  return view;
}

StudyField field_of(const TomlSection& in, std::set<std::string>& taken) {
  static constexpr std::array<std::string_view, 4> kSurfaces{"ground", "roofs", "walls", "windows"};
  StudyField field;
  field.name = name_of(in, "illuminance", taken);
  field.surfaces = in.choice_list("surfaces", kSurfaces).value_or(field.surfaces);
  field.spacing_m = in.number("spacing_m", {0.01, 1000.0}).value_or(field.spacing_m);
  if (const auto most = in.number("most_sensors", {100.0, 5e7})) {
    field.most_sensors = static_cast<std::size_t>(*most);
  }
  return field;
}

StudySensors sensors_of(const TomlSection& in, const fs::path& folder,
                        std::set<std::string>& taken) {
  const auto file = in.text("file");
  if (!file) in.refuse("", "[[sensors]] needs a file");
  return {name_of(in, "sensors", taken), folder / *file};
}

std::optional<StudyPlan> plan_of(const TomlSection& in) {
  if (!in.is_there()) return std::nullopt;
  StudyPlan plan;
  plan.spacing_m = in.number("spacing_m", {0.01, 1000.0}).value_or(plan.spacing_m);
  plan.lowest = illuminance(in, "lowest_lx");
  plan.highest = illuminance(in, "highest_lx", {0.0, 1e7, true});
  if (plan.lowest && plan.highest && !(*plan.highest > *plan.lowest)) {
    in.refuse("highest_lx", "highest_lx must be above lowest_lx");
  }
  return plan;
}

std::optional<StudyReport> report_of(const TomlSection& in) {
  if (!in.is_there()) return std::nullopt;
  return StudyReport{in.text("title").value_or(""), in.text("author").value_or(""),
                     in.boolean("sun_path").value_or(true)};
}

std::string text_of_file(const fs::path& path) {
  constexpr std::uintmax_t kLargest = 1 << 20;  // bytes: a study of that size is a mistake
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw InputError(path.string() + ": there is no such file");
  if (fs::is_directory(status)) throw InputError(path.string() + " is a folder, not a study file");
  std::ifstream in(path, std::ios::binary);
  std::string text(kLargest + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad() || (!in && !in.eof())) throw InputError(path.string() + ": it cannot be read");
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() > kLargest) throw InputError(path.string() + " is over 1 MiB: no study file");
  if (text.empty()) throw InputError(path.string() + " is empty");
  return text;
}

void apply_overrides(Study& study, const StudyOverrides& overrides, const TomlSection& document) {
  if (!overrides.time.empty()) study.time.at = overrides.time;
  if (overrides.scene.empty()) return;
  const auto refuse_if = [](bool given, const TomlSection& in, std::string_view key) {
    if (given) {
      in.refuse(key, "this belongs to the study's own scene; take it out to use another scene");
    }
  };
  const TomlSection scene = document.table("scene");
  refuse_if(scene.has("crs"), scene, "crs");
  refuse_if(study.scene.ground != "auto" && study.scene.ground != "none", scene, "ground");
  refuse_if(!study.scene.terrain.empty(), scene, "terrain");
  refuse_if(study.scene.site.has_value(), document, "site");
  for (const TomlSection& view : document.tables("view")) refuse_if(view.has("eye"), view, "eye");
  study.scene.file = overrides.scene;
}

void check_whole(const Study& study, const TomlSection& document) {
  if (study.scene.file.empty())
    document.refuse("scene", "file in [scene] is missing, and --scene is not given");
  if (study.time.at.empty() && !study.time.sun_altitude) {
    document.refuse("time", "the study needs a time, at in [time], or the sun's place in [sun]");
  }
}

}  // namespace

std::vector<std::string> study_keys() {
  std::vector<std::string> result;
  for (const KnownTable& table : known_tables()) {
    for (const std::string_view key : table.keys) {
      result.push_back(std::string(table.name) + "." + std::string(key));
    }
  }
  return result;
}

Study read_study(const fs::path& path, const StudyOverrides& overrides) {
  const TomlSection document = TomlSection::parse(text_of_file(path), path.string());
  Words tables;
  for (const KnownTable& table : known_tables()) tables.push_back(table.name);
  document.refuse_unknown_keys(tables);

  const fs::path folder = path.parent_path();
  const TomlSection sun = section(document, "sun");
  Study study;
  study.file = path;
  study.scene = scene_of(section(document, "scene"), folder);
  study.scene.site = site_of(section(document, "site"));
  study.time = time_of(section(document, "time"), sun);
  study.sky = sky_of(section(document, "sky"), sun, folder);
  study.calculation = calculation_of(section(document, "calculation"));
  std::set<std::string> names{"plan", "report", "manifest", "sun-path"};
  for (const auto& in : sections(document, "view"))
    study.views.push_back(view_of(in, folder, names));
  for (const auto& in : sections(document, "illuminance")) {
    study.fields.push_back(field_of(in, names));
  }
  for (const auto& in : sections(document, "sensors")) {
    study.sensors.push_back(sensors_of(in, folder, names));
  }
  study.plan = plan_of(section(document, "plan"));
  study.report = report_of(section(document, "report"));
  apply_overrides(study, overrides, document);
  check_whole(study, document);
  return study;
}

}  // namespace tenku
