#include "flythrough/point_codec.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/error.h"

namespace tenku {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is little-endian");

constexpr double kStepsPerFootprint = 32.0;
constexpr double kMostSteps = 4294967295.0;
constexpr std::size_t kChunkHead = 4 + 7 * 8 + 2 * 4;
constexpr double kLogPerOctave = 1024.0, kLogZero = -20.0;

[[noreturn]] void refuse_damaged() { throw InputError("a record of the point store is damaged"); }

class ByteWriter {
 public:
  template <class T>
  void put(T value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  T get() {
    T value;
    const std::string_view some = take(sizeof value);
    std::memcpy(&value, some.data(), sizeof value);
    return value;
  }
  std::string_view take(std::size_t count) {
    if (count > bytes_.size()) refuse_damaged();
    const std::string_view some = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return some;
  }
  std::string_view rest() const { return bytes_; }

 private:
  std::string_view bytes_;
};

/// Differences in zigzag order, in planes of a byte, the lowest first.
class ColumnWriter {
 public:
  explicit ColumnWriter(std::size_t count) : count_(count) {}

  /// @param value  of a point, below 2^(8 bytes)
  template <class Value>
  void put(int bytes, const Value& value) {
    const std::size_t start = planes_.size();
    planes_.resize(start + static_cast<std::size_t>(bytes) * count_);
    std::uint32_t last = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const std::uint32_t now = value(i);
      const std::uint32_t coded = zigzag(now - last, bytes);
      last = now;
      for (int b = 0; b < bytes; ++b) {
        planes_[start + static_cast<std::size_t>(b) * count_ + i] =
            static_cast<char>(coded >> (8 * b));
      }
    }
  }
  const std::string& planes() const { return planes_; }

 private:
  static std::uint32_t zigzag(std::uint32_t difference, int bytes) {
    const int shift = 32 - 8 * bytes;
    const auto d = static_cast<std::int32_t>(difference << shift) >> shift;
    return (static_cast<std::uint32_t>(d) << 1U) ^ static_cast<std::uint32_t>(d >> 31);
  }

  std::size_t count_;
  std::string planes_;
};

class ColumnReader {
 public:
  ColumnReader(std::string_view planes, std::size_t count) : bytes_(planes), count_(count) {}

  template <class Take>
  void get(int bytes, const Take& take) {
    const std::string_view planes = bytes_.take(static_cast<std::size_t>(bytes) * count_);
    const std::uint32_t mask = bytes == 4 ? 0xffffffffU : (1U << (8U * unsigned(bytes))) - 1U;
    std::uint32_t last = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      std::uint32_t coded = 0;
      for (int b = 0; b < bytes; ++b) {
        const auto plane = static_cast<std::size_t>(b) * count_;
        coded |= std::uint32_t{static_cast<unsigned char>(planes[plane + i])} << (8 * b);
      }
      last = (last + ((coded >> 1U) ^ (0U - (coded & 1U)))) & mask;
      take(i, last);
    }
  }
  bool is_at_end() const { return bytes_.rest().empty(); }

 private:
  ByteReader bytes_;
  std::size_t count_;
};

/// How the positions of a chunk are rounded.
struct Grid {
  Vec3 origin;
  double step = 1.0;

  static Grid of(const StoredPoints& points) {
    const Extent box = points.extent();
    float finest = points.footprint_m.front();
    for (const float f : points.footprint_m) finest = std::min(finest, f);
    return {box.min,
            std::max({finest / kStepsPerFootprint, box.longest_side() / kMostSteps, 1e-9})};
  }
  std::uint32_t code(double value, double low) const {
    return static_cast<std::uint32_t>(
        std::clamp(std::round((value - low) / step), 0.0, kMostSteps));
  }
};

/// Octahedral map of a unit vector: Z. Cigolle et al., "A survey of efficient representations for
/// independent unit vectors", JCGT 3(2), 2014.
struct OctahedralCode {
  std::uint16_t u, v;
};

std::uint16_t code_of_share(double share) {
  return static_cast<std::uint16_t>(std::lround(std::clamp(share, -1.0, 1.0) * 32767.0) + 32767);
}
double share_of_code(std::uint16_t code) { return (static_cast<double>(code) - 32767.0) / 32767.0; }
double sign_of(double v) { return v < 0.0 ? -1.0 : 1.0; }

OctahedralCode octahedral(Vec3 n) {
  const double sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
  double u = n.x / sum, v = n.y / sum;
  if (n.z < 0.0) {
    const double folded = (1.0 - std::abs(v)) * sign_of(u);
    v = (1.0 - std::abs(u)) * sign_of(v);
    u = folded;
  }
  return {code_of_share(u), code_of_share(v)};
}

Vec3 from_octahedral(OctahedralCode code) {
  double u = share_of_code(code.u), v = share_of_code(code.v);
  const double z = 1.0 - std::abs(u) - std::abs(v);
  if (z < 0.0) {
    const double folded = (1.0 - std::abs(v)) * sign_of(u);
    v = (1.0 - std::abs(u)) * sign_of(v);
    u = folded;
  }
  return normalized({u, v, z});
}

/// Of one channel against another: codes of equal light differ by nothing.
std::uint32_t against(std::uint16_t code, std::uint16_t other) {
  return static_cast<std::uint16_t>(code - other);
}

}  // namespace

std::uint16_t log_code(double value) {
  if (!(value > std::exp2(kLogZero))) return 0;
  const double code = 1.0 + std::round(kLogPerOctave * (std::log2(value) - kLogZero));
  return static_cast<std::uint16_t>(std::min(code, 65535.0));
}

double value_of_log_code(std::uint16_t code) {
  return code == 0 ? 0.0 : std::exp2((code - 1) / kLogPerOctave + kLogZero);
}

std::string deflated(std::string_view bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(4 + size, '\0');
  const auto length = static_cast<std::uint32_t>(bytes.size());
  std::memcpy(out.data(), &length, 4);
  const int rc = compress2(reinterpret_cast<Bytef*>(out.data() + 4), &size,
                           reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), 6);
  expects(rc == Z_OK, "zlib has room for what it compresses");
  out.resize(4 + size);
  return out;
}

std::string inflated(std::string_view bytes) {
  ByteReader reader(bytes);
  const auto length = reader.get<std::uint32_t>();
  const std::string_view stream = reader.rest();
  // Deflate cannot shrink by more than 1032 times: a length beyond that is damage, not data.
  if (length > 1040 * (stream.size() + 16)) refuse_damaged();
  std::string out(length, '\0');
  uLongf size = length;
  const int rc = uncompress(reinterpret_cast<Bytef*>(out.data()), &size,
                            reinterpret_cast<const Bytef*>(stream.data()), stream.size());
  if (rc != Z_OK || size != length) refuse_damaged();
  return out;
}

std::string packed(const StoredPoints& points) {
  expects(!points.empty(), "a chunk has points");
  const Grid grid = Grid::of(points);
  const Extent box = points.extent();
  const auto [finest, coarsest] =
      std::minmax_element(points.footprint_m.begin(), points.footprint_m.end());
  ByteWriter head;
  head.put(static_cast<std::uint32_t>(points.size()));
  for (const Vec3 v : {box.min, box.max}) head.put(v.x), head.put(v.y), head.put(v.z);
  head.put(grid.step);
  head.put(*finest), head.put(*coarsest);
  std::vector<OctahedralCode> normal;
  for (const Vec3 n : points.normal) normal.push_back(octahedral(n));
  ColumnWriter columns(points.size());
  columns.put(4, [&](std::size_t i) { return grid.code(points.position[i].x, box.min.x); });
  columns.put(4, [&](std::size_t i) { return grid.code(points.position[i].y, box.min.y); });
  columns.put(4, [&](std::size_t i) { return grid.code(points.position[i].z, box.min.z); });
  columns.put(2, [&](std::size_t i) { return normal[i].u; });
  columns.put(2, [&](std::size_t i) { return normal[i].v; });
  columns.put(4, [&](std::size_t i) { return points.object[i]; });
  columns.put(2, [&](std::size_t i) { return points.material[i]; });
  columns.put(2, [&](std::size_t i) { return log_code(points.footprint_m[i]); });
  columns.put(1, [&](std::size_t i) { return points.is_edge[i]; });
  for (std::size_t k = 0; k < 4; ++k) {
    columns.put(1, [&](std::size_t i) { return points.borders[i].code[k]; });
  }
  return head.take() + deflated(columns.planes());
}

ChunkInfo chunk_info(std::string_view bytes) {
  ByteReader head(bytes);
  ChunkInfo info;
  info.points = head.get<std::uint32_t>();
  for (Vec3* v : {&info.extent.min, &info.extent.max}) {
    v->x = head.get<double>(), v->y = head.get<double>(), v->z = head.get<double>();
  }
  head.get<double>();
  info.finest_m = head.get<float>();
  info.coarsest_m = head.get<float>();
  return info;
}

StoredPoints unpacked_points(std::string_view bytes) {
  const ChunkInfo info = chunk_info(bytes);
  const auto step = ByteReader(bytes.substr(4 + 6 * 8)).get<double>();
  const std::string planes = inflated(bytes.substr(kChunkHead));
  if (planes.size() != info.points * 29) refuse_damaged();
  const std::size_t n = info.points;
  StoredPoints points;
  points.position.resize(n), points.normal.resize(n), points.footprint_m.resize(n);
  points.object.resize(n), points.material.resize(n), points.is_edge.resize(n),
      points.borders.resize(n);
  std::vector<OctahedralCode> normal(n);
  ColumnReader columns(planes, n);
  const Vec3 low = info.extent.min;
  columns.get(4, [&](auto i, auto c) { points.position[i].x = low.x + step * c; });
  columns.get(4, [&](auto i, auto c) { points.position[i].y = low.y + step * c; });
  columns.get(4, [&](auto i, auto c) { points.position[i].z = low.z + step * c; });
  columns.get(2, [&](auto i, auto c) { normal[i].u = static_cast<std::uint16_t>(c); });
  columns.get(2, [&](auto i, auto c) { normal[i].v = static_cast<std::uint16_t>(c); });
  columns.get(4, [&](auto i, auto c) { points.object[i] = c; });
  columns.get(2, [&](auto i, auto c) { points.material[i] = static_cast<std::uint16_t>(c); });
  columns.get(2, [&](auto i, auto c) {
    points.footprint_m[i] = static_cast<float>(value_of_log_code(static_cast<std::uint16_t>(c)));
  });
  columns.get(1, [&](auto i, auto c) { points.is_edge[i] = static_cast<std::uint8_t>(c); });
  for (std::size_t k = 0; k < 4; ++k) {
    columns.get(1,
                [&](auto i, auto c) { points.borders[i].code[k] = static_cast<std::uint8_t>(c); });
  }
  for (std::size_t i = 0; i < n; ++i) points.normal[i] = from_octahedral(normal[i]);
  return points;
}

std::string packed(const PointLight& light) {
  const std::size_t n = light.size();
  std::vector<std::uint16_t> green;
  for (const Rgb& c : light.reflected_lux) green.push_back(log_code(c.g));
  ColumnWriter columns(n);
  columns.put(2, [&](std::size_t i) { return log_code(light.sun_lux[i]); });
  columns.put(2, [&](std::size_t i) { return log_code(light.sky_lux[i]); });
  columns.put(2, [&](std::size_t i) { return green[i]; });
  columns.put(2,
              [&](std::size_t i) { return against(log_code(light.reflected_lux[i].r), green[i]); });
  columns.put(2,
              [&](std::size_t i) { return against(log_code(light.reflected_lux[i].b), green[i]); });
  columns.put(1, [&](std::size_t i) {
    return static_cast<std::uint32_t>(
        std::lround(255.0 * std::clamp(double{light.sky_view[i]}, 0.0, 1.0)));
  });
  ByteWriter head;
  head.put(static_cast<std::uint32_t>(n));
  return head.take() + deflated(columns.planes());
}

PointLight unpacked_light(std::string_view bytes) {
  const std::size_t n = ByteReader(bytes).get<std::uint32_t>();
  const std::string planes = inflated(bytes.substr(4));
  if (planes.size() != n * 11) refuse_damaged();
  PointLight light(n);
  std::vector<std::uint16_t> green(n);
  ColumnReader columns(planes, n);
  const auto value = [](std::uint32_t c) {
    return value_of_log_code(static_cast<std::uint16_t>(c));
  };
  columns.get(2, [&](auto i, auto c) { light.sun_lux[i] = static_cast<float>(value(c)); });
  columns.get(2, [&](auto i, auto c) { light.sky_lux[i] = static_cast<float>(value(c)); });
  columns.get(2, [&](auto i, auto c) {
    green[i] = static_cast<std::uint16_t>(c);
    light.reflected_lux[i].g = value(c);
  });
  columns.get(2, [&](auto i, auto c) { light.reflected_lux[i].r = value(c + green[i]); });
  columns.get(2, [&](auto i, auto c) { light.reflected_lux[i].b = value(c + green[i]); });
  columns.get(1, [&](auto i, auto c) { light.sky_view[i] = static_cast<float>(c / 255.0); });
  return light;
}

Vec3 as_stored_normal(Vec3 normal) { return from_octahedral(octahedral(normal)); }

StoredPoints as_stored(const StoredPoints& points) {
  return points.empty() ? points : unpacked_points(packed(points));
}

PointLight as_stored(const PointLight& light) { return unpacked_light(packed(light)); }

}  // namespace tenku
