/// What `tenku chart` compares on a scene.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "illuminance/illuminate.h"
#include "study/chart_pictures.h"
#include "study/lit_scene.h"
#include "study/speed_accuracy.h"

namespace tenku {

/// The stages there are, in the order of the flow.
std::vector<std::string> chart_stages();

/// @throws InputError  for what is neither one of them nor `all`
void check_chart_stages(const std::vector<std::string>& stages);

/// Settings and references for some stages of a scene, and what of it they share.
///
/// `sky`, `visibility` and `lod` find direct light on the sensors and are held against slices;
/// `reflections` all light, held against paths; `form-factors` and `mesh` light after all
/// reflections, held against a finer mesh; the others make pictures (`chart_pictures.h`).
class ChartSettings {
 public:
  /// @param lit      kept by reference, like `sensors`
  /// @param stages   of `chart_stages`, or `all`: `form-factors` and `mesh` then only in rooms (up
  ///                 to 60 m and 20,000 triangles), `mirrors` where there are any
  /// @throws InputError  for a stage that is not known, or none that this scene and sky allow
  ChartSettings(const LitScene& lit, const Sensors& sensors, const ChartView& view,
                std::vector<std::string> stages, std::uint64_t seed);
  ~ChartSettings();
  ChartSettings(const ChartSettings&) = delete;
  ChartSettings& operator=(const ChartSettings&) = delete;

  const std::vector<ChartSetting>& settings() const { return settings_; }
  const std::vector<ChartReference>& references() const { return references_; }

 private:
  struct DirectLight;
  bool wants(const std::string& stage) const;
  void add_direct_reference();
  void add_sky();
  void add_visibility();
  void add_detail();
  void add_interior_reference();
  void add_form_factors();
  void add_meshes();

  const LitScene& lit_;
  const Sensors& sensors_;
  std::vector<std::string> stages_;
  std::uint64_t seed_;
  std::shared_ptr<DirectLight> direct_;  ///< of interiors: the same for all of their settings
  std::vector<ChartSetting> settings_;
  std::vector<ChartReference> references_;
};

}  // namespace tenku
