/// One member of a CityGML model: its polygons as they stand in the file, until the member ends and
/// it is known which of them are wanted and which belong together. Private to this module.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "scene/cityjson_types.h"
#include "scene/raw_scene.h"

namespace tenku {

/// What holds for the polygons and references met at a place of the file.
struct GmlPlace {
  std::uint32_t object = kNone;  ///< index into `Scene::objects`
  std::uint32_t shell = kNone;   ///< of a solid, in the member
  int lod = 0;                   ///< 0 to 4
  SemanticKind surface{};        ///< what the thematic surface around is
  bool is_surface = false;       ///< there is one
  bool is_turned = false;        ///< stands in an orientable surface of negative orientation
};

/// Polygons, references to polygons, and shells of one member.
///
/// A polygon can be given in a solid and named by a thematic surface, or the other way round: both
/// are found when the member ends. References to other members are not followed, so that only one
/// member is in memory.
class GmlMember {
 public:
  GmlMember(RawScene& raw, const std::string& wanted_lod) : raw_(raw), wanted_lod_(wanted_lod) {}

  void begin_polygon(const GmlPlace& place);
  /// @param inner  a hole of the polygon begun last
  void add_ring(const std::vector<Vec3>& points, bool inner);
  std::uint32_t add_shell(bool inner);
  /// @param id  of a polygon or of what holds polygons, as `xlink:href` has it
  void add_reference(std::string_view id, const GmlPlace& place);

  std::size_t polygons() const { return polygons_.size(); }
  /// Gives a name to the polygons from `first` to the last one now.
  /// @return false if others have the name, which they keep
  bool name_polygons(std::string_view id, std::size_t first);

  /// Moves the vertices of the polygons from `first` on by a row-major 4 x 4 matrix, then by `by`.
  void transform_polygons(std::size_t first, const std::array<double, 16>& matrix, Vec3 by);
  /// Appends the polygons from `first` to `end` of another member, moved likewise.
  void add_copies(const GmlMember& from, const GmlPlace& place);

  /// Adds the wanted level of detail of each object from `first_object` on to the scene, and
  /// forgets everything.
  void finish(std::uint32_t first_object);
  void clear();

 private:
  struct Ring {
    std::uint32_t first = 0, end = 0;  ///< in `points_`
  };
  struct Polygon {
    GmlPlace place;
    std::uint32_t first_ring = 0, end_ring = 0;
  };
  struct Shell {
    bool is_inner = false;
    bool is_whole = true;  ///< all of its polygons are found, and belong to no other
    std::uint32_t in_scene = kNone;
  };
  struct Reference {
    std::string id;
    GmlPlace place;
  };
  struct Range {
    std::uint32_t first = 0, end = 0;
  };

  void resolve(const Reference& reference);
  void refer(std::uint32_t polygon, const GmlPlace& place);
  void choose_lods(std::uint32_t first_object);
  int chosen_lod(std::uint32_t object, int highest_of_parts, unsigned lods);
  void append_chosen(std::uint32_t first_object);
  void append(const Polygon& polygon);
  void append_ring(const Ring& ring, bool reversed);
  SurfaceFacts facts_of(const Polygon& polygon);
  std::uint8_t lod_index(int lod);

  RawScene& raw_;
  const std::string& wanted_lod_;
  std::vector<Vec3> points_;
  std::vector<Ring> rings_;
  std::vector<Polygon> polygons_;
  std::vector<Shell> shells_;
  std::vector<Reference> references_;
  std::unordered_map<std::string, Range> named_;
  std::vector<int> chosen_;  ///< [object of the member], -1 for none
};

}  // namespace tenku
