/// The stability matrix: every method against every hazard that it can meet.
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace tenku::stability {

/// A row or column: the name used in code, and the words of docs/stability.md.
struct Heading {
  std::string name, title;
};

const std::vector<Heading>& methods();
const std::vector<Heading>& hazards();

/// What a cell came to. `kind` is `right` (within its interval of a value from outside), `told` (a
/// finding names place and cause) or `refused` (exit code 2 that names the cause).
struct Outcome {
  std::string kind, note;
};

/// One method under one hazard. Exactly one of `run`, `tested_by` and `does_not_apply` is given.
struct Cell {
  std::string method, hazard;
  std::function<Outcome(const std::filesystem::path& folder)> run = {};
  std::string tested_by = {};       ///< "Suite.Name" of a test of another folder that is this cell
  std::string does_not_apply = {};  ///< why the method cannot meet the hazard
  bool takes_minutes = false;       ///< run by `make stability` only
};

/// For lists of tests.
inline void PrintTo(const Cell& cell, std::ostream* out) {
  *out << cell.method << ", " << cell.hazard;
}

std::vector<Cell> sky_cells();       ///< rays, shadow maps, sky elements, sun disc
std::vector<Cell> room_cells();      ///< paths, radiosity, meshes
std::vector<Cell> exchange_cells();  ///< form factors, mirrors, fly-through
std::vector<Cell> input_cells();     ///< readers, position of the sun
std::vector<Cell> other_cells();     ///< tested elsewhere, or do not apply

}  // namespace tenku::stability
