/// The light that points receive from the sides of a mesh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/rgb.h"
#include "form_factors/form_factor.h"
#include "form_factors/form_factor_store.h"
#include "form_factors/outward_view.h"
#include "illuminance/sensor.h"
#include "meshing/element_mesh.h"

namespace tenku {

struct PointGatherOptions {
  std::string method = "hemisphere-rays";
  FormFactorOptions form_factors;                  ///< of both looks together
  int finest = 512;                                ///< resolution that points go on to at most
  double lift_m = 1e-5;                            ///< of points off their surface
  std::size_t most_bytes = std::size_t{1} << 30U;  ///< of the rows kept
};

/// Rows of form factors of points. Every point looks twice, with half of the samples each, so that
/// the difference tells the error of the form factors, whatever the method.
class PointGather {
 public:
  static constexpr std::size_t kLooks = 2;
  using Looks = std::array<Rgb, kLooks>;

  /// How finely points may look, from as many samples as asked to twice as many a level.
  static std::size_t levels(const PointGatherOptions& options);
  /// Of each look on the first level.
  static int first_resolution(const PointGatherOptions& options);

  /// @param mesh, points  kept by reference
  /// @throws InputError as `form_factor_method`
  PointGather(const ElementMesh& mesh, const Sensors& points, const PointGatherOptions& options);

  /// Finds the rows of those points that are not kept yet, as far as memory goes.
  /// @param is_wanted  [point]
  /// @throws Cancelled
  void prepare(std::span<const std::uint8_t> is_wanted, Progress& progress);

  /// Lets points look more finely from now on: with twice the samples a step, 16 times at most.
  /// @param steps  [point], 0: as before. On return, of those that do not look more finely 0
  /// @return  whether any do
  bool look_finer(std::span<std::uint8_t> steps);

  /// Rows of points that another mesh of the same surfaces can take over.
  struct Kept {
    Vec3 position, normal;
    std::uint8_t level = 0;
    std::array<FormFactorRow, kLooks> row;
  };
  /// Gives away those that see nothing but sides which that mesh has as well.
  /// @param now  [element side], their numbers there; `kGone` where they are not
  static constexpr std::uint32_t kGone = ~0U;
  std::vector<Kept> release(std::span<const std::uint32_t> now);
  /// Takes rows over at the points that are where those were, bit for bit.
  /// @return  number of points
  std::size_t adopt(std::vector<Kept> rows);

  /// Sum of form factor times value over the sides, by both looks [point]; zero for points that
  /// are not wanted.
  /// @param of_side  [element side]
  std::vector<Looks> gather(std::span<const Rgb> of_side,
                            std::span<const std::uint8_t> is_wanted) const;

  /// Calls `use(point, look, row)` for the wanted points, on many threads.
  void for_rows(
      std::span<const std::uint8_t> is_wanted,
      const std::function<void(std::size_t, std::size_t, const FormFactorRow&)>& use) const;

  const Sensors& points() const { return points_; }
  std::size_t bytes() const { return store_.bytes(); }
  std::size_t refused() const { return refused_; }

 private:
  FormFactorRow find(std::size_t point, std::size_t look) const;
  void ready(std::size_t level);

  const Sensors& points_;
  double lift_m_;
  OutwardView outward_;
  static constexpr std::size_t kLevels = 5;
  using Methods = std::array<std::unique_ptr<FormFactorMethod>, kLooks>;
  static Methods methods(const ElementMesh& mesh, const PointGatherOptions& options,
                         std::size_t level);

  const ElementMesh& mesh_;
  PointGatherOptions options_;
  std::array<Methods, kLevels> method_;  ///< by how finely they look; made when they are needed
  std::vector<std::uint8_t> level_;      ///< [point]
  FormFactorStore store_;                ///< [look of point]
  std::size_t refused_ = 0;
};

}  // namespace tenku
