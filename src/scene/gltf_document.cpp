#include "scene/gltf_document.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/base64.h"
#include "scene/byte_cursor.h"
#include "scene/input_file.h"

namespace tenku {
namespace {

constexpr std::uint32_t kMagic = 0x46546c67, kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;
/// An accessor without bytes is a list of zeros that could be of any length.
constexpr std::size_t kMostZeros = 10'000'000;

std::string percent_decoded(const std::string& uri) {
  std::string text;
  for (std::size_t k = 0; k < uri.size(); ++k) {
    const bool is_code = uri[k] == '%' && k + 2 < uri.size() &&
                         std::isxdigit(static_cast<unsigned char>(uri[k + 1])) != 0 &&
                         std::isxdigit(static_cast<unsigned char>(uri[k + 2])) != 0;
    if (!is_code) {
      text += uri[k];
      continue;
    }
    text += static_cast<char>(std::stoi(uri.substr(k + 1, 2), nullptr, 16));
    k += 2;
  }
  return text;
}

template <class T>
double number_at(std::string_view bytes, std::size_t offset) {
  return static_cast<double>(ByteCursor(bytes.substr(offset)).next<T>().value_or(T{}));
}

}  // namespace

/// How the elements of an accessor lie in its bytes.
struct GltfDocument::Layout {
  std::size_t component_type = 0, component_size = 0, components = 1, count = 0;
  bool is_normalized = false;

  std::size_t element_size() const { return component_size * components; }
};

GltfDocument::GltfDocument(std::string bytes, const std::string& name, std::filesystem::path folder)
    : source_(name), folder_(std::move(folder)), bytes_(std::move(bytes)) {
  if (bytes_.starts_with("glTF")) {
    read_glb(bytes_);
  } else {
    json_ = parse_json(parser_, bytes_, source_);
  }
  if (!json_.is_object()) source_.refuse("this is not glTF: it is no object");
  const auto asset = JsonSource::member(json_, "asset");
  const std::string version = asset ? source_.text(*asset, "version") : "";
  if (version.empty()) source_.refuse("this is not glTF: there is no 'version' in 'asset'");
  if (!version.starts_with("2."))
    source_.refuse("glTF of version " + version + " is not read: only 2.0");
}

void GltfDocument::read_glb(std::string_view bytes) {
  ByteCursor cursor(bytes);
  cursor.skip(4);
  const auto version = cursor.next<std::uint32_t>(), length = cursor.next<std::uint32_t>();
  if (!version || !length) source_.refuse("cut off in the header of a GLB file");
  if (*version != 2)
    source_.refuse("GLB of version " + std::to_string(*version) + " is not read: only 2");
  if (*length > bytes.size() || *length < 20) {
    source_.refuse("cut off: the header tells " + std::to_string(*length) + " bytes, there are " +
                   std::to_string(bytes.size()));
  }
  cursor = ByteCursor(bytes.substr(12, *length - 12));
  bool has_json = false;
  while (cursor.left() >= 8) {
    const std::size_t size = *cursor.next<std::uint32_t>();
    const std::uint32_t type = *cursor.next<std::uint32_t>();
    if (size > cursor.left())
      source_.refuse("cut off: a chunk of the GLB file is larger than the file");
    const std::string_view chunk = cursor.rest().substr(0, size);
    cursor.skip(size);
    if (type == kJsonChunk && !has_json) {
      json_ = parse_json(parser_, chunk, source_);
      has_json = true;
    } else if (type == kBinaryChunk && has_json && !binary_) {
      binary_ = chunk;
    }
    if (!has_json) break;
  }
  if (!has_json) source_.refuse("this is not GLB: the first chunk is not JSON");
}

JsonElement GltfDocument::item(const char* list, std::size_t index) const {
  const auto [at, is_new] = lists_.try_emplace(list);
  if (is_new) at->second = source_.list(json_, list);
  if (index >= at->second.size()) {
    source_.refuse("there is no item " + std::to_string(index) + " in '" + list + "', which has " +
                   std::to_string(at->second.size()));
  }
  return at->second[index];
}

std::string GltfDocument::load(const std::string& uri) {
  if (uri.starts_with("data:")) {
    const auto comma = uri.find(',');
    if (comma == std::string::npos || !uri.substr(0, comma).ends_with(";base64")) {
      source_.refuse("a 'data:' URI of a buffer is not in base64");
    }
    auto bytes = base64_decoded(std::string_view(uri).substr(comma + 1));
    if (!bytes) source_.refuse("a 'data:' URI of a buffer is damaged");
    return std::move(*bytes);
  }
  const auto colon = uri.find(':');
  if ((colon != std::string::npos && uri.find('/') > colon) || uri.starts_with('/')) {
    source_.refuse("a buffer lies elsewhere ('" + uri.substr(0, 60) +
                   "'); only files beside this one are read");
  }
  const std::filesystem::path file = folder_ / percent_decoded(uri);
  try {
    return read_input_file(file);
  } catch (const std::invalid_argument& error) {
    source_.refuse(std::string("a buffer cannot be had: ") + error.what());
  }
}

std::string_view GltfDocument::buffer(std::size_t index) {
  const JsonElement buffer = item("buffers", index);
  const std::size_t length = source_.whole(buffer, "byteLength");
  std::string_view bytes;
  if (const std::string uri = source_.text(buffer, "uri"); !uri.empty()) {
    const auto [at, is_new] = loaded_.try_emplace(index);
    if (is_new) at->second = load(uri);
    bytes = at->second;
  } else if (index == 0 && binary_) {
    bytes = *binary_;
  } else {
    source_.refuse("buffer " + std::to_string(index) + " has no bytes");
  }
  if (bytes.size() < length) {
    source_.refuse("buffer " + std::to_string(index) + " is cut off: " + std::to_string(length) +
                   " bytes are told, there are " + std::to_string(bytes.size()));
  }
  return bytes.substr(0, length);
}

std::string_view GltfDocument::view(std::size_t buffer_view) {
  const JsonElement view = item("bufferViews", buffer_view);
  const std::string_view bytes = buffer(source_.whole(view, "buffer"));
  const std::size_t offset = source_.whole_if_given(view, "byteOffset").value_or(0);
  const std::size_t length = source_.whole(view, "byteLength");
  if (offset > bytes.size() || length > bytes.size() - offset) {
    source_.refuse("buffer view " + std::to_string(buffer_view) + " reaches out of its buffer");
  }
  return bytes.substr(offset, length);
}

AccessorNumbers GltfDocument::numbers(std::size_t accessor, std::string_view type) {
  const JsonElement item = this->item("accessors", accessor);
  if (source_.text(item, "type") != type) {
    source_.refuse("accessor " + std::to_string(accessor) + " should be of type " +
                   std::string(type) + ", not '" + source_.text(item, "type") + "'");
  }
  Layout layout;
  layout.component_type = source_.whole(item, "componentType");
  layout.components = type == "VEC3" ? 3 : type == "VEC4" ? 4 : 1;
  layout.count = source_.whole(item, "count");
  layout.is_normalized = source_.flag(item, "normalized");
  constexpr std::array<std::size_t, 7> kSizes{1, 1, 2, 2, 0, 4, 4};  // of 5120 to 5126
  const std::size_t row = layout.component_type - 5120;
  if (layout.component_type < 5120 || row >= kSizes.size() || kSizes[row] == 0) {
    source_.refuse("accessor " + std::to_string(accessor) + " is of the unknown component type " +
                   std::to_string(layout.component_type));
  }
  layout.component_size = kSizes[row];
  AccessorNumbers numbers;
  numbers.components = layout.components;
  read_dense(item, layout, numbers);
  if (JsonSource::member(item, "sparse")) read_sparse(item, layout, numbers);
  return numbers;
}

void GltfDocument::read_dense(JsonElement accessor, const Layout& layout,
                              AccessorNumbers& numbers) {
  const auto index = source_.whole_if_given(accessor, "bufferView");
  if (!index) {
    if (layout.count > kMostZeros) source_.refuse("an accessor without bytes has too many zeros");
    numbers.values.assign(layout.count * layout.components, 0.0);
    return;
  }
  const std::string_view bytes = view(*index);
  const std::size_t offset = source_.whole_if_given(accessor, "byteOffset").value_or(0);
  const std::size_t stride = source_.whole_if_given(item("bufferViews", *index), "byteStride")
                                 .value_or(layout.element_size());
  if (stride < layout.element_size() || stride > 65536) {
    source_.refuse("buffer view " + std::to_string(*index) + " has a stride that does not fit");
  }
  if (offset > bytes.size()) source_.refuse("an accessor begins outside its buffer view");
  read_values(bytes.substr(offset), stride, layout, layout.count, nullptr);
  numbers.values.resize(layout.count * layout.components);
  read_values(bytes.substr(offset), stride, layout, layout.count, numbers.values.data());
}

void GltfDocument::read_sparse(JsonElement accessor, const Layout& layout,
                               AccessorNumbers& numbers) {
  const JsonElement sparse = *JsonSource::member(accessor, "sparse");
  const auto indices = JsonSource::member(sparse, "indices"),
             values = JsonSource::member(sparse, "values");
  if (!indices || !values) source_.refuse("a sparse accessor needs 'indices' and 'values'");
  const std::size_t count = source_.whole(sparse, "count");
  const auto bytes_of = [&](JsonElement part) {
    const std::string_view bytes = view(source_.whole(part, "bufferView"));
    const std::size_t offset = source_.whole_if_given(part, "byteOffset").value_or(0);
    if (offset > bytes.size()) source_.refuse("a sparse accessor begins outside its buffer view");
    return bytes.substr(offset);
  };
  Layout whole;
  whole.component_type = source_.whole(*indices, "componentType");
  whole.component_size = whole.component_type == 5121 ? 1 : whole.component_type == 5123 ? 2 : 4;
  if (whole.component_size == 4 && whole.component_type != 5125) {
    source_.refuse("indices of a sparse accessor are not whole numbers");
  }
  const std::string_view at_bytes = bytes_of(*indices), bytes = bytes_of(*values);
  read_values(at_bytes, whole.component_size, whole, count, nullptr);
  read_values(bytes, layout.element_size(), layout, count, nullptr);
  std::vector<double> at(count), replaced(count * layout.components);
  read_values(at_bytes, whole.component_size, whole, count, at.data());
  read_values(bytes, layout.element_size(), layout, count, replaced.data());
  for (std::size_t k = 0; k < count; ++k) {
    if (!(at[k] < static_cast<double>(layout.count))) {
      source_.refuse("an index of a sparse accessor is out of range");
    }
    const auto from = replaced.begin() + static_cast<std::ptrdiff_t>(k * layout.components);
    std::copy_n(from, layout.components,
                numbers.values.begin() + static_cast<std::ptrdiff_t>(
                                             static_cast<std::size_t>(at[k]) * layout.components));
  }
}

/// Without `values` only tells whether the bytes are enough.
void GltfDocument::read_values(std::string_view bytes, std::size_t stride, const Layout& layout,
                               std::size_t count, double* values) const {
  const std::size_t element = layout.element_size();
  if (count > 0 && (bytes.size() < element || (bytes.size() - element) / stride < count - 1)) {
    source_.refuse("an accessor reaches out of its buffer view");
  }
  if (values == nullptr) return;
  constexpr std::array<double, 4> kLargest{127.0, 255.0, 32767.0, 65535.0};
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t c = 0; c < layout.components; ++c) {
      const std::size_t at = k * stride + c * layout.component_size;
      double value = 0.0;
      switch (layout.component_type) {
        case 5120:
          value = number_at<std::int8_t>(bytes, at);
          break;
        case 5121:
          value = number_at<std::uint8_t>(bytes, at);
          break;
        case 5122:
          value = number_at<std::int16_t>(bytes, at);
          break;
        case 5123:
          value = number_at<std::uint16_t>(bytes, at);
          break;
        case 5125:
          value = number_at<std::uint32_t>(bytes, at);
          break;
        default:
          value = number_at<float>(bytes, at);
          break;
      }
      if (layout.is_normalized && layout.component_type < 5124) {
        value = std::max(value / kLargest[layout.component_type - 5120], -1.0);
      }
      *values++ = value;
    }
  }
}

}  // namespace tenku
