/// The file of a fly-through: `.tkpts`, described byte by byte in docs/flythrough.md.
///
/// A sequence of records, each with its checksum, only ever appended to: whatever cuts it off
/// leaves all records before the last. Points lie in chunks that are compact in space; their light
/// lies in records of its own, one a chunk and lighting, so that another hour adds light and no
/// points.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/extent.h"
#include "core/rgb.h"
#include "core/vec3.h"
#include "flythrough/camera_path.h"
#include "flythrough/stored_points.h"

namespace tenku {

/// Number of the format that is written and read.
inline constexpr int kPointStoreVersion = 1;

/// A material of the scene, as far as diffuse points need it.
struct StoreMaterial {
  std::string name;
  Rgb reflectance{};     ///< diffuse, linear Rec. 709
  Rgb emission_lm_m2{};  ///< exitance of its own
};

/// What a store says of itself.
struct StoreHeader {
  std::string scene, scene_sha256, software;  ///< file as given; 64 hex digits; `tenku 0.1.0`
  std::string crs;                            ///< `EPSG:7415`, or empty
  Vec3 file_origin;                           ///< the local origin in coordinates of the scene file
  std::vector<StoreMaterial> materials;
  CameraPath path;
  /// Resolved settings, name and value as text, in a fixed order. Equal settings, path and scene
  /// make equal stores.
  std::vector<std::array<std::string, 2>> settings;

  /// Value of a setting; empty where there is none of that name.
  std::string setting(std::string_view name) const;
};

/// Luminance of the sky above the horizon, without the solar disc, for what is seen behind points.
///
/// Units    cd/m2, linear Rec. 709.
/// Shape    [row][column], row-major: row k is the altitude k / (rows - 1) * 90 degrees, column k
/// the
///          azimuth k / columns * 360 degrees, clockwise from north. Values between by bilinear
///          interpolation, columns going round.
struct SkyMap {
  int columns = 0, rows = 0;
  std::vector<Rgb> pixels;

  /// `below` the horizon, black where the map is empty.
  Rgb colour(Vec3 direction, Rgb below) const;
};

/// One sun and sky that the points are lit by.
struct StoreLighting {
  std::string time;           ///< ISO 8601 as given; empty where the sun was given directly
  std::string sky;            ///< in words
  Vec3 sun_direction;         ///< unit, to the sun; zero vector: none
  double sun_normal_lux = 0;  ///< on a surface that faces the sun, unobstructed
  double horizontal_lux = 0;  ///< of sun and sky on the unobstructed horizontal plane
  double white_cd_m2 = 0;     ///< luminance to show as white, as a hint
  Rgb below_horizon{};        ///< luminance seen below the horizon beyond the scene, cd/m2
  SkyMap sky_map;
};

/// What is known of a chunk before it is unpacked.
struct ChunkInfo {
  std::size_t points = 0;
  Extent extent;                             ///< of the positions
  float finest_m = 0.0F, coarsest_m = 0.0F;  ///< of the footprints
};

/// Where the bytes of a record lie in the file.
struct RecordPlace {
  std::uint64_t offset = 0;
  std::size_t size = 0;
};

/// Reads a store, whole or cut off.
///
/// Error    positions are off by at most 1/64 of the finest footprint of their chunk on each axis
///          (or extent / 2^32), normals by 1e-4 radians, light and footprints by 0.034 %, sky_view
///          by 1/510.
/// Threads  immutable after construction; may be shared.
class PointStore {
 public:
  /// Checks every record. A last record that is cut off or damaged is left out, and told.
  /// @throws InputError     no such file, not a store, another version, damaged before its end
  /// @throws ResourceError  if reading fails
  explicit PointStore(const std::filesystem::path& file);
  ~PointStore();
  PointStore(PointStore&&) noexcept;

  const StoreHeader& header() const { return header_; }
  const std::vector<StoreLighting>& lightings() const { return lightings_; }
  const std::vector<ChunkInfo>& chunks() const { return info_; }
  std::size_t point_count() const;
  /// Where the points of each chunk lie in the file. Shape  [chunk].
  const std::vector<RecordPlace>& places() const { return geometry_; }
  /// Frames whose points are all there.
  std::size_t frames_done() const { return frames_done_; }
  /// Chunks that those frames need; more may follow.
  std::size_t chunks_done() const { return chunks_done_; }
  /// All frames have their points, and all points the light of every lighting.
  bool is_complete() const;
  /// Whether the light of a chunk is there.
  bool has_light(std::size_t chunk, std::size_t lighting) const;

  /// @throws ResourceError  if reading fails
  StoredPoints points(std::size_t chunk) const;
  /// @throws InputError     if `has_light` is false
  /// @throws ResourceError  if reading fails
  PointLight light(std::size_t chunk, std::size_t lighting) const;

  /// Bytes of whole records; of what follows them and is cut off.
  std::uint64_t bytes() const { return bytes_; }
  std::uint64_t torn_bytes() const { return torn_bytes_; }

 private:
  struct File;
  struct Record;
  void take(const Record& record);

  std::unique_ptr<File> file_;
  StoreHeader header_;
  std::vector<StoreLighting> lightings_;
  std::vector<ChunkInfo> info_;
  std::vector<RecordPlace> geometry_;
  std::vector<std::vector<std::optional<RecordPlace>>> light_;  ///< [lighting][chunk]
  std::size_t frames_done_ = 0, chunks_done_ = 0;
  std::uint64_t bytes_ = 0, torn_bytes_ = 0;
};

/// Appends to a store. Each call's records reach the system before it returns.
///
/// Threads  one at a time.
class PointStoreWriter {
 public:
  /// A new store in place of whatever `file` holds.
  /// @throws InputError, ResourceError  if it cannot be written
  PointStoreWriter(const std::filesystem::path& file, const StoreHeader& header);
  /// Goes on with a store after its whole records; what follows them is cut off.
  /// @throws InputError, ResourceError  as `PointStore`, or if it cannot be written
  explicit PointStoreWriter(const std::filesystem::path& file);
  ~PointStoreWriter();
  PointStoreWriter(const PointStoreWriter&) = delete;
  PointStoreWriter& operator=(const PointStoreWriter&) = delete;

  /// @return index of the lighting
  std::size_t add_lighting(const StoreLighting& lighting);
  /// @return index of the chunk
  std::size_t add_points(const StoredPoints& points);
  void add_light(std::size_t chunk, std::size_t lighting, const PointLight& light);
  /// All points of the first `frames` frames are written.
  void end_frames(std::size_t frames);

  std::uint64_t bytes() const { return bytes_; }
  const std::vector<ChunkInfo>& chunks() const { return info_; }
  /// A chunk as it was written, rounded.
  /// @throws ResourceError  if reading fails
  StoredPoints points(std::size_t chunk) const;

 private:
  void append(const char* kind, std::uint32_t a, std::uint32_t b, const std::string& payload);

  std::string name_;
  int file_ = -1;
  std::uint64_t bytes_ = 0;
  std::vector<ChunkInfo> info_;
  std::vector<RecordPlace> geometry_;
  std::size_t lightings_ = 0;
};

/// A unit normal as a store gives it back.
Vec3 as_stored_normal(Vec3 normal);
/// Points as a store gives them back: positions, normals and footprints rounded.
StoredPoints as_stored(const StoredPoints& points);
PointLight as_stored(const PointLight& light);

}  // namespace tenku
