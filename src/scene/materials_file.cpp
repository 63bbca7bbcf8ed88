#include <toml++/toml.h>

#include <array>
#include <cmath>

#include "core/error.h"
#include "core/suggest.h"
#include "scene/input_file.h"
#include "scene/materials.h"

namespace tenku {
namespace {

constexpr std::array<std::string_view, 6> kKeys{"reflectance", "mirror",        "mirror_index",
                                                "index",       "transmittance", "emission_lm_m2"};

/// One value of a materials file, and where it stands.
struct Entry {
  const std::string& file;
  std::string material;
  std::string_view key;
  const toml::node& node;

  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(file + ", line " + std::to_string(node.source().begin.line) + ": " + material +
                     "." + std::string(key) + " " + what);
  }
};

double number_of(const Entry& entry, const toml::node& node) {
  const auto value = node.value<double>();
  if (!value || !std::isfinite(*value)) entry.refuse("should be a finite number");
  return *value;
}

Rgb colour_of(const Entry& entry) {
  const toml::array* channels = entry.node.as_array();
  if (channels == nullptr) return Rgb::grey(number_of(entry, entry.node));
  if (channels->size() != 3) entry.refuse("should be one number or [r, g, b]");
  return {number_of(entry, (*channels)[0]), number_of(entry, (*channels)[1]),
          number_of(entry, (*channels)[2])};
}

std::string text_of(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%g", value);
  return buffer;
}

double checked(const Entry& entry, double value, double least, double most, const char* range) {
  if (!(value >= least && value <= most)) {
    entry.refuse("= " + text_of(value) + " is outside " + range);
  }
  return value;
}

Rgb reflectance_of(const Entry& entry) {
  const Rgb colour = colour_of(entry);
  for (const double channel : {colour.r, colour.g, colour.b}) {
    if (!(channel >= 0.0 && channel < 1.0)) {
      entry.refuse("= " + text_of(channel) + " is outside [0, 1)");
    }
  }
  return colour;
}

void set_mirror(Material& material, const Entry& entry) {
  const Rgb colour = colour_of(entry);
  for (const double c : {colour.r, colour.g, colour.b}) checked(entry, c, 0.0, 1.0, "[0, 1]");
  const bool is_grey = colour.r == colour.g && colour.g == colour.b;
  material.mirror = is_grey ? colour.r : luminance_of(colour);
  if (!is_grey) material.mirror_tint = (1.0 / material.mirror) * colour;
}

void set_value(Material& material, const Entry& entry) {
  if (entry.key == "reflectance") {
    material.reflectance = reflectance_of(entry);
  } else if (entry.key == "mirror") {
    set_mirror(material, entry);
  } else if (entry.key == "mirror_index") {
    material.mirror_index = checked(entry, number_of(entry, entry.node), 1.0, 10.0, "[1, 10]");
  } else if (entry.key == "index") {
    material.index = checked(entry, number_of(entry, entry.node), 1.0, 10.0, "[1, 10]");
  } else if (entry.key == "transmittance") {
    material.transmittance = checked(entry, number_of(entry, entry.node), 0.0, 1.0, "[0, 1]");
  } else if (entry.key == "emission_lm_m2") {
    const Rgb colour = colour_of(entry);
    for (const double c : {colour.r, colour.g, colour.b}) checked(entry, c, 0.0, 1e9, "[0, 1e9]");
    material.emission_lm_m2 = colour;
  } else {
    entry.refuse("is not a property of a material" + suggestion(entry.key, kKeys));
  }
}

/// What a table says; the rest is as for the surface type of that name. A pane and a mirror have no
/// diffuse reflection unless it is given.
Material material_of(const std::string& file, const std::string& name, const toml::table& table) {
  Material material = default_material(surface_type_named(name).value_or(SurfaceType::Unknown));
  material.name = name;
  for (const auto& [key, node] : table) {
    set_value(material, {file, name, key.str(), node});
  }
  if (material.mirror_index > 0.0 && !table.contains("mirror")) {
    // Both faces of a pane, between which light goes to and fro.
    const double face = std::pow((material.mirror_index - 1.0) / (material.mirror_index + 1.0), 2);
    material.mirror = 2.0 * face / (1.0 + face);
  }
  if (!table.contains("reflectance") && (material.is_glass() || material.mirror > 0.0)) {
    material.reflectance = Rgb{};
  }
  if (table.contains("index") && table.contains("transmittance")) {
    throw InputError(file + ": " + name + " has both 'index' and 'transmittance'; give one");
  }
  return material;
}

}  // namespace

std::map<std::string, Material> read_materials(const std::filesystem::path& path) {
  const std::string file = path.string(), text = read_input_file(path);
  toml::table root;
  try {
    root = toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw InputError(file + ", line " + std::to_string(error.source().begin.line) + ": " +
                     std::string(error.description()));
  }
  std::map<std::string, Material> materials;
  for (const auto& [key, node] : root) {
    const toml::table* table = node.as_table();
    if (table == nullptr) {
      throw InputError(file + ", line " + std::to_string(node.source().begin.line) + ": '" +
                       std::string(key.str()) + "' should be a table, as in [wall]");
    }
    materials.emplace(key.str(), material_of(file, std::string(key.str()), *table));
  }
  return materials;
}

}  // namespace tenku
