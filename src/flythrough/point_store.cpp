#include "flythrough/point_store.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <system_error>

#include "core/error.h"
#include "flythrough/point_codec.h"

namespace tenku {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kMagic("TKPTS\r\n\x1a", 8);
constexpr std::size_t kRecordHead = 20;
constexpr const char* kHeaderKind = "HEAD";
constexpr const char* kLightingKind = "SKYL";
constexpr const char* kPointsKind = "GEOM";
constexpr const char* kLightKind = "LITE";
constexpr const char* kFramesKind = "DONE";

struct RecordHead {
  char kind[4];
  std::uint32_t a, b, size, checksum;

  bool is(const char* name) const { return std::memcmp(kind, name, sizeof kind) == 0; }
};
static_assert(sizeof(RecordHead) == kRecordHead);

std::uint32_t checksum_of(const RecordHead& head, std::string_view payload) {
  uLong sum = crc32(0L, Z_NULL, 0);
  sum = crc32(sum, reinterpret_cast<const Bytef*>(&head), kRecordHead - sizeof head.checksum);
  sum = crc32_z(sum, reinterpret_cast<const Bytef*>(payload.data()), payload.size());
  return static_cast<std::uint32_t>(sum);
}

std::string reason() { return std::strerror(errno); }

std::string read_at(int file, RecordPlace place, const std::string& name) {
  std::string bytes(place.size, '\0');
  for (std::size_t done = 0; done < place.size;) {
    const ssize_t got = ::pread(file, bytes.data() + done, place.size - done,
                                static_cast<off_t>(place.offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) {
      throw ResourceError("cannot read " + name + ": " +
                          (got < 0 ? reason() : "it became shorter"));
    }
    done += static_cast<std::size_t>(got);
  }
  return bytes;
}

}  // namespace

std::string StoreHeader::setting(std::string_view name) const {
  for (const auto& [key, value] : settings) {
    if (key == name) return value;
  }
  return {};
}

Rgb SkyMap::colour(Vec3 direction, Rgb below) const {
  if (direction.z < 0.0) return below;
  if (pixels.empty()) return {};
  const double x = azimuth_of(direction).in_degrees() / 360.0 * columns;
  const double y = altitude_of(direction).in_degrees() / 90.0 * (rows - 1);
  const int row = std::clamp(static_cast<int>(y), 0, std::max(0, rows - 2));
  const double u = x - std::floor(x), v = std::clamp(y - row, 0.0, 1.0);
  const auto at = [&](int r, int c) {
    return pixels[static_cast<std::size_t>(std::min(r, rows - 1)) *
                      static_cast<std::size_t>(columns) +
                  static_cast<std::size_t>(c % columns)];
  };
  const int column = static_cast<int>(x);
  return (1.0 - v) * ((1.0 - u) * at(row, column) + u * at(row, column + 1)) +
         v * ((1.0 - u) * at(row + 1, column) + u * at(row + 1, column + 1));
}

/// The open file. Reads by place, so that threads may share it.
struct PointStore::File {
  std::string name;
  int number = -1;
  std::uint64_t size = 0;

  explicit File(const fs::path& path) : name(path.string()) {
    number = ::open(name.c_str(), O_RDONLY | O_CLOEXEC);
    if (number < 0) throw InputError("cannot read " + name + ": " + reason());
    struct stat about {};
    if (::fstat(number, &about) != 0 || !S_ISREG(about.st_mode)) {
      ::close(number);
      throw InputError("cannot read " + name + ": it is not a file");
    }
    size = static_cast<std::uint64_t>(about.st_size);
  }
  ~File() { ::close(number); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  std::string read(std::uint64_t offset, std::size_t count) const {
    return read_at(number, {offset, count}, name);
  }
};

struct PointStore::Record {
  RecordHead head;
  std::uint64_t offset;  ///< of the payload
  std::string_view payload;
};

PointStore::PointStore(const fs::path& path) : file_(std::make_unique<File>(path)) {
  const File& file = *file_;
  if (file.size < kMagic.size() || file.read(0, kMagic.size()) != kMagic) {
    throw InputError(file.name + " is not a point store of tenku");
  }
  bytes_ = kMagic.size();
  try {
    while (file.size - bytes_ >= kRecordHead) {
      Record record{};
      const std::string head = file.read(bytes_, kRecordHead);
      std::memcpy(&record.head, head.data(), kRecordHead);
      const std::uint64_t left = file.size - bytes_ - kRecordHead;
      if (record.head.size > left) break;
      record.offset = bytes_ + kRecordHead;
      const std::string bytes = file.read(record.offset, record.head.size);
      record.payload = bytes;
      if (checksum_of(record.head, bytes) != record.head.checksum) {
        if (record.head.size == left) break;
        throw InputError("it is damaged at byte " + std::to_string(bytes_));
      }
      take(record);
      bytes_ = record.offset + record.head.size;
    }
  } catch (const InputError& error) {
    throw InputError(file.name + ": " + error.what());
  }
  if (bytes_ == kMagic.size()) throw InputError(file.name + " was cut off before its header ended");
  torn_bytes_ = file.size - bytes_;
}

PointStore::~PointStore() = default;
PointStore::PointStore(PointStore&&) noexcept = default;

void PointStore::take(const Record& record) {
  const RecordHead& head = record.head;
  const RecordPlace place{record.offset, record.head.size};
  const bool is_first = bytes_ == kMagic.size();
  if (is_first != head.is(kHeaderKind)) throw InputError("its header is not its first record");
  if (head.is(kHeaderKind)) {
    header_ = unpacked_header(record.payload);
  } else if (head.is(kLightingKind)) {
    lightings_.push_back(unpacked_lighting(record.payload));
    light_.emplace_back();
  } else if (head.is(kPointsKind)) {
    info_.push_back(chunk_info(record.payload));
    geometry_.push_back(place);
  } else if (head.is(kLightKind)) {
    if (head.a >= info_.size() || head.b >= light_.size()) {
      throw InputError("light at byte " + std::to_string(record.offset) + " belongs to no points");
    }
    auto& places = light_[head.b];
    places.resize(std::max<std::size_t>(places.size(), head.a + std::size_t{1}));
    places[head.a] = place;
  } else if (head.is(kFramesKind)) {
    frames_done_ = head.a;
    chunks_done_ = head.b;
  }
  // Records of other kinds come from later programs of this version, and are passed over.
}

std::size_t PointStore::point_count() const {
  std::size_t sum = 0;
  for (const ChunkInfo& chunk : info_) sum += chunk.points;
  return sum;
}

bool PointStore::is_complete() const {
  if (lightings_.empty() || frames_done_ < header_.path.size()) return false;
  for (std::size_t l = 0; l < lightings_.size(); ++l) {
    for (std::size_t c = 0; c < info_.size(); ++c) {
      if (!has_light(c, l)) return false;
    }
  }
  return true;
}

bool PointStore::has_light(std::size_t chunk, std::size_t lighting) const {
  return lighting < light_.size() && chunk < light_[lighting].size() &&
         light_[lighting][chunk].has_value();
}

StoredPoints PointStore::points(std::size_t chunk) const {
  const RecordPlace place = geometry_.at(chunk);
  return unpacked_points(file_->read(place.offset, place.size));
}

PointLight PointStore::light(std::size_t chunk, std::size_t lighting) const {
  if (!has_light(chunk, lighting)) {
    throw InputError(file_->name + " has no light " + std::to_string(lighting) + " of chunk " +
                     std::to_string(chunk));
  }
  const RecordPlace place = *light_[lighting][chunk];
  PointLight light = unpacked_light(file_->read(place.offset, place.size));
  if (light.size() != info_[chunk].points) {
    throw InputError(file_->name + ": a record of the point store is damaged");
  }
  return light;
}

PointStoreWriter::PointStoreWriter(const fs::path& file, const StoreHeader& header)
    : name_(file.string()) {
  file_ = ::open(name_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file_ < 0) throw ResourceError("cannot write " + name_ + ": " + reason());
  try {
    if (::write(file_, kMagic.data(), kMagic.size()) != static_cast<ssize_t>(kMagic.size())) {
      throw ResourceError("cannot write " + name_ + ": " + reason());
    }
    bytes_ = kMagic.size();
    append(kHeaderKind, 0, 0, packed(header));
  } catch (...) {
    ::close(file_);
    throw;
  }
}

PointStoreWriter::PointStoreWriter(const fs::path& file) : name_(file.string()) {
  const PointStore store(file);
  bytes_ = store.bytes();
  info_ = store.chunks();
  geometry_ = store.places();
  lightings_ = store.lightings().size();
  file_ = ::open(name_.c_str(), O_RDWR | O_CLOEXEC);
  if (file_ < 0) throw ResourceError("cannot write " + name_ + ": " + reason());
  if (::ftruncate(file_, static_cast<off_t>(bytes_)) != 0 || ::lseek(file_, 0, SEEK_END) < 0) {
    const std::string why = reason();
    ::close(file_);
    throw ResourceError("cannot write " + name_ + ": " + why);
  }
}

PointStoreWriter::~PointStoreWriter() { ::close(file_); }

void PointStoreWriter::append(const char* kind, std::uint32_t a, std::uint32_t b,
                              const std::string& payload) {
  RecordHead head{{}, a, b, static_cast<std::uint32_t>(payload.size()), 0};
  std::memcpy(head.kind, kind, sizeof head.kind);
  head.checksum = checksum_of(head, payload);
  std::string bytes(reinterpret_cast<const char*>(&head), kRecordHead);
  bytes += payload;
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t put = ::write(file_, bytes.data() + done, bytes.size() - done);
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) throw ResourceError("cannot write " + name_ + ": " + reason());
    done += static_cast<std::size_t>(put);
  }
  bytes_ += bytes.size();
}

std::size_t PointStoreWriter::add_lighting(const StoreLighting& lighting) {
  append(kLightingKind, 0, 0, packed(lighting));
  return lightings_++;
}

std::size_t PointStoreWriter::add_points(const StoredPoints& points) {
  const std::string bytes = packed(points);
  const RecordPlace place{bytes_ + kRecordHead, bytes.size()};
  append(kPointsKind, static_cast<std::uint32_t>(info_.size()), 0, bytes);
  geometry_.push_back(place);
  info_.push_back(chunk_info(bytes));
  return info_.size() - 1;
}

StoredPoints PointStoreWriter::points(std::size_t chunk) const {
  return unpacked_points(read_at(file_, geometry_.at(chunk), name_));
}

void PointStoreWriter::add_light(std::size_t chunk, std::size_t lighting, const PointLight& light) {
  expects(chunk < info_.size() && lighting < lightings_, "light belongs to a chunk and a lighting");
  append(kLightKind, static_cast<std::uint32_t>(chunk), static_cast<std::uint32_t>(lighting),
         packed(light));
}

void PointStoreWriter::end_frames(std::size_t frames) {
  append(kFramesKind, static_cast<std::uint32_t>(frames), static_cast<std::uint32_t>(info_.size()),
         {});
}

}  // namespace tenku
