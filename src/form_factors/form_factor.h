/// How much of what one surface sends reaches the others: the interface of all methods.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "core/vec3.h"
#include "meshing/element_mesh.h"

namespace tenku {

/// What reaches one side first, of all that is sent.
struct FormFactor {
  std::uint32_t side;
  float value;
};

/// A row of the matrix: sides that nothing reaches are left out, no side is there twice.
/// What the row lacks of 1 has escaped, or was held back by panes.
using FormFactorRow = std::vector<FormFactor>;

/// A way to find form factors.
///
/// Threads  immutable after construction; may be shared.
class FormFactorMethod {
 public:
  virtual ~FormFactorMethod() = default;

  /// The name in `--form-factors` and `--method`.
  virtual std::string_view name() const = 0;

  /// By how much points stand off the surface that they lie on, along its normal, in metres.
  virtual double lift_m() const { return 1e-9; }

  /// Whether rows from points are exact, but for rounding and crowds.
  virtual bool is_exact() const { return false; }

  /// Whether rows are dimmed by the panes of the mesh.
  virtual bool sees_panes() const { return false; }

  /// Of a small surface at a point: the fraction of what it sends, by Lambert's law, into the half
  /// space of its normal, that first meets each side; by reciprocity also what the irradiance
  /// there is in parts of each side's radiosity.
  /// @param position  lifted off the surface that it lies on by `lift_m` at least
  /// @param normal    unit
  virtual FormFactorRow from_point(Vec3 position, Vec3 normal) const = 0;
};

/// What the methods share.
struct FormFactorOptions {
  int resolution = 128;       ///< lines of the disc, or pixels along the edge of the hemicube
  double polyline_deg = 0.0;  ///< edges on the disc are straight over at most this angle; 0: arcs
  std::uint64_t seed = 1;     ///< of methods that sample
};

/// The names that `form_factor_method` knows.
std::vector<std::string_view> form_factor_method_names();

/// @throws InputError for a name that no method has, and for an option out of its range
void check_form_factor_method(std::string_view name, const FormFactorOptions& options);

/// @param mesh  kept by reference
/// @throws InputError as `check_form_factor_method`, ResourceError as `RayVisibility`
std::unique_ptr<FormFactorMethod> form_factor_method(std::string_view name, const ElementMesh& mesh,
                                                     const FormFactorOptions& options);

}  // namespace tenku
