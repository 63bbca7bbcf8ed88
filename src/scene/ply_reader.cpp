#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/error.h"
#include "scene/byte_cursor.h"
#include "scene/input_file.h"
#include "scene/mesh_readers.h"
#include "scene/text_cursor.h"

namespace tenku {
namespace {

enum class Number { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float, Double };

struct NumberName {
  std::string_view old_name, name;
  Number number;
};
constexpr std::array<NumberName, 8> kNumbers{{{"char", "int8", Number::Int8},
                                              {"uchar", "uint8", Number::Uint8},
                                              {"short", "int16", Number::Int16},
                                              {"ushort", "uint16", Number::Uint16},
                                              {"int", "int32", Number::Int32},
                                              {"uint", "uint32", Number::Uint32},
                                              {"float", "float32", Number::Float},
                                              {"double", "float64", Number::Double}}};

struct Property {
  std::string name;
  Number number = Number::Float;
  bool is_list = false;
  Number count = Number::Uint8;
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

/// Values of one element in turn, whatever the encoding.
class PlyReader {
 public:
  PlyReader(const std::string& bytes, const std::string& file)
      : file_(file), text_(bytes, file_), bytes_("") {
    read_header(bytes);
  }

  RawScene read(Progress& progress);

 private:
  void read_header(const std::string& bytes);
  void read_format();
  void read_property();
  Number number_named(std::string_view name);
  void read_element(const Element& element, Progress& progress);
  void read_vertex(const Element& element);
  void read_face(const Element& element);
  void pass_over(const Element& element);
  double value(Number number);
  std::size_t list_length(const Property& property);
  double binary_value(Number number);
  template <class T>
  double binary();
  [[noreturn]] void refuse(const std::string& what) const;

  std::string file_;
  TextCursor text_;
  ByteCursor bytes_;
  bool is_ascii_ = false;
  std::endian order_ = std::endian::little;
  std::vector<Element> elements_;
  const Element* element_ = nullptr;  ///< being read
  std::size_t index_ = 0;             ///< of the one of its kind
  RawScene raw_;
};

void PlyReader::refuse(const std::string& what) const {
  const std::string where = element_ == nullptr
                                ? ""
                                : element_->name + " " + std::to_string(index_ + 1) + " of " +
                                      std::to_string(element_->count) + ": ";
  throw InputError(file_ + ": " + where + what);
}

Number PlyReader::number_named(std::string_view name) {
  for (const NumberName& row : kNumbers) {
    if (row.name == name || row.old_name == name) return row.number;
  }
  text_.refuse(quoted(name) + " is not a type of PLY");
}

void PlyReader::read_format() {
  const std::string_view format = text_.word();
  is_ascii_ = format == "ascii";
  order_ = format == "binary_big_endian" ? std::endian::big : std::endian::little;
  if (!is_ascii_ && format != "binary_big_endian" && format != "binary_little_endian") {
    text_.refuse(quoted(format) + " is not a format of PLY");
  }
}

void PlyReader::read_property() {
  if (elements_.empty()) text_.refuse("a property stands before all elements");
  Property property;
  const std::string_view type = text_.word();
  property.is_list = type == "list";
  if (property.is_list) {
    property.count = number_named(text_.word());
    property.number = number_named(text_.word());
  } else {
    property.number = number_named(type);
  }
  property.name = text_.word();
  elements_.back().properties.push_back(property);
}

void PlyReader::read_header(const std::string& bytes) {
  if (text_.word() != "ply")
    throw InputError(file_ + ": this is not PLY: it does not begin with 'ply'");
  bool has_format = false;
  for (text_.next_line(); !text_.at_end(); text_.next_line()) {
    const std::string_view keyword = text_.word();
    if (keyword == "end_header") {
      if (!has_format) text_.refuse("the header names no format");
      const auto line_end =
          bytes.find('\n', static_cast<std::size_t>(keyword.data() - bytes.data()));
      const std::string_view all = bytes;
      bytes_ = ByteCursor(line_end == std::string::npos ? "" : all.substr(line_end + 1), order_);
      text_.next_line();
      return;
    }
    if (keyword == "format") {
      read_format();
      has_format = true;
    } else if (keyword == "element") {
      const std::string name(text_.word());
      const double count = text_.number();
      if (!(count >= 0.0 && count < kNone && count == std::floor(count))) {
        text_.refuse("the number of elements is not a whole number");
      }
      elements_.push_back({name, static_cast<std::size_t>(count), {}});
    } else if (keyword == "property") {
      read_property();
    }
  }
  throw InputError(file_ + " is cut off: the header does not end");
}

template <class T>
double PlyReader::binary() {
  const auto number = bytes_.next<T>();
  if (!number) refuse("cut off");
  return static_cast<double>(*number);
}

double PlyReader::binary_value(Number number) {
  switch (number) {
    case Number::Int8:
      return binary<std::int8_t>();
    case Number::Uint8:
      return binary<std::uint8_t>();
    case Number::Int16:
      return binary<std::int16_t>();
    case Number::Uint16:
      return binary<std::uint16_t>();
    case Number::Int32:
      return binary<std::int32_t>();
    case Number::Uint32:
      return binary<std::uint32_t>();
    case Number::Float:
      return binary<float>();
    case Number::Double:
      return binary<double>();
  }
  return 0.0;
}

double PlyReader::value(Number number) {
  if (!is_ascii_) return binary_value(number);
  while (text_.line_is_done()) {
    if (text_.at_end()) refuse("cut off");
    text_.next_line();
  }
  return text_.number();
}

std::size_t PlyReader::list_length(const Property& property) {
  const double length = value(property.count);
  if (!(length >= 0.0 && length < kNone)) refuse("a list has a length below 0");
  return static_cast<std::size_t>(length);
}

void PlyReader::read_vertex(const Element& element) {
  Vec3 point{};
  for (const Property& property : element.properties) {
    const std::size_t values = property.is_list ? list_length(property) : 1;
    for (std::size_t k = 0; k < values; ++k) {
      const double number = value(property.number);
      if (property.name == "x") point.x = number;
      if (property.name == "y") point.y = number;
      if (property.name == "z") point.z = number;
    }
  }
  if (!is_finite(point)) refuse("a coordinate is not finite");
  raw_.scene.vertices.push_back(point);
}

void PlyReader::read_face(const Element& element) {
  Surfaces& surfaces = raw_.scene.surfaces;
  bool has_indices = false;
  for (const Property& property : element.properties) {
    const bool is_wanted = property.is_list && !has_indices &&
                           (property.name == "vertex_indices" || property.name == "vertex_index");
    const std::size_t values = property.is_list ? list_length(property) : 1;
    for (std::size_t k = 0; k < values; ++k) {
      const double number = value(property.number);
      if (!is_wanted) continue;
      if (!(number >= 0.0 && number < static_cast<double>(raw_.scene.vertices.size()))) {
        refuse("a vertex index is out of range: there are " +
               std::to_string(raw_.scene.vertices.size()) + " vertices before it");
      }
      surfaces.vertex.push_back(static_cast<std::uint32_t>(number));
    }
    has_indices |= is_wanted;
  }
  if (!has_indices) refuse("faces have no list 'vertex_indices'");
  end_ring(surfaces);
  end_surface(surfaces, {});
}

void PlyReader::pass_over(const Element& element) {
  for (const Property& property : element.properties) {
    const std::size_t values = property.is_list ? list_length(property) : 1;
    for (std::size_t k = 0; k < values; ++k) value(property.number);
  }
}

void PlyReader::read_element(const Element& element, Progress& progress) {
  constexpr std::size_t kOften = 1U << 16U;
  const bool is_vertex = element.name == "vertex", is_face = element.name == "face";
  if (!is_vertex && !is_face && element.count > 0) {
    raw_.findings.add({"ignored_element", Severity::Note, "", file_,
                       "elements '" + element.name + "' are ignored", "only polygons are read"});
  }
  // Elements of nothing would be counted without end.
  if (element.properties.empty()) return;
  element_ = &element;
  for (std::size_t k = 0; k < element.count; ++k) {
    if (k % kOften == 0) progress.stop_if_cancelled();
    index_ = k;
    if (is_vertex) {
      read_vertex(element);
    } else if (is_face) {
      read_face(element);
    } else {
      pass_over(element);
    }
  }
}

RawScene PlyReader::read(Progress& progress) {
  raw_.scene.format = "PLY";
  raw_.is_mesh = true;
  raw_.scene.lods = {""};
  raw_.scene.objects.push_back({"default", ""});
  raw_.is_building.push_back(0);
  for (const Element& element : elements_) read_element(element, progress);
  return std::move(raw_);
}

}  // namespace

RawScene read_ply(const std::filesystem::path& path, Progress& progress) {
  const std::string bytes = read_input_file(path);
  return PlyReader(bytes, path.string()).read(progress);
}

}  // namespace tenku
