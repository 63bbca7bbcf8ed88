/// What tests on scene files share.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "core/progress.h"
#include "scene/flatten.h"
#include "scene/read_scene.h"

namespace tenku {

/// A folder that is there while the test runs.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "tenku_sceneXXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The folder of other people's data, if it is there.
inline std::optional<std::filesystem::path> data_folder() {
  const char* folder = std::getenv("TENKU_DATA");
  if (folder == nullptr || !std::filesystem::is_directory(folder)) return std::nullopt;
  return folder;
}

inline Scene read(const std::filesystem::path& path, const ReadOptions& options = {}) {
  Progress silent;
  return read_scene(path, options, silent);
}

/// Reads `text` as if it were a file of that name.
inline Scene read_text(const std::string& name, const std::string& text,
                       const ReadOptions& options = {}) {
  const TemporaryFolder folder;
  return read(folder.write(name, text), options);
}

inline ReadOptions without_ground() {
  ReadOptions options;
  options.ground.kind = GroundChoice::Kind::None;
  return options;
}

/// How often a finding was made, over all objects.
inline std::size_t count_of(const Scene& scene, const std::string& code) {
  std::size_t count = 0;
  for (const Finding& finding : scene.findings) {
    if (finding.code == code) count += finding.count;
  }
  return count;
}

/// Area and enclosed volume (positive if the fronts look outwards) of triangles.
struct Measures {
  double area = 0.0, volume = 0.0;
};
inline Measures measures(const TriangleSoup& soup) {
  Measures sum;
  for (const auto& t : soup.triangles) {
    const Vec3 a = soup.vertices[t[0]], b = soup.vertices[t[1]], c = soup.vertices[t[2]];
    sum.area += 0.5 * length(cross(b - a, c - a));
    sum.volume += dot(a, cross(b, c)) / 6.0;
  }
  return sum;
}

}  // namespace tenku
