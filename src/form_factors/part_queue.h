/// The parts of an element from which its row is integrated.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "form_factors/form_factor.h"
#include "form_factors/patch_form_factors.h"
#include "form_factors/sparse_row.h"
#include "form_factors/target_edges.h"

namespace tenku {

/// What is integrated, and how. All is borrowed.
struct PartTask {
  const FormFactorMethod& method;
  const ElementMesh& mesh;
  const PatchFormFactorOptions& options;
  const std::vector<Column>& column;  ///< [side]
  const TargetEdges& edges;
};

/// Integrates the row of one side of an element by parts, which are quadrilaterals: three
/// to begin with, which meet in the middle of the element.
class PartQueue {
 public:
  /// @param wanted  [side]: which form factors are asked for; kept by reference
  PartQueue(const PartTask& task, const std::vector<char>& wanted, std::uint32_t side);

  /// Cuts parts until all form factors are within their tolerances.
  void refine();

  /// Mean row over the element, and its error, by column.
  SparseRow row() const { return total_of(&Part::row); }
  SparseRow error() const { return total_of(&Part::error); }

 private:
  struct Part {
    std::array<Vec3, 4> corner;
    SparseRow row, error;  ///< times the part's share of the element
    Vec3 across{};         ///< direction in which it is to be cut; zero: the longer way
    double doubt = 0.0;
  };

  void add_doubt_of_edges(Part& part) const;
  SparseRow row_of(const std::array<Vec3, 4>& corner) const;
  void push(Part part);
  std::array<Part, 2> halves(const Part& part) const;
  SparseRow total_of(SparseRow Part::*what) const;
  double tolerance(Column column) const;
  bool is_done() const;
  void account(const Part& part, double sense);
  double doubt_of(const Part& part) const;

  PartTask task_;
  const std::vector<char>& wanted_;
  std::uint32_t side_;
  Vec3 normal_;
  double area_m2_;
  std::vector<Part> part_;             ///< a heap: the greatest doubt first
  std::vector<double> value_, error_;  ///< [column], running sums
};

}  // namespace tenku
