/// The options of how surfaces are divided for radiosity.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/command.h"
#include "radiosity/mesh_loop.h"
#include "study/lit_scene.h"

namespace tenku {

class OptionList;

/// As given on the command line; lengths in metres, 0 where they are to be chosen.
struct RadiosityMeshOptions {
  std::string mesh = "uniform";
  MeshOptions sizes;
  double first_m = 0.0, threshold_pct = 0.0;
  int rounds = -1;  ///< below 0: not given
  std::string report;
  bool shadow_edges = false;
};

void add_mesh_options(OptionList& app, RadiosityMeshOptions& options);

/// @throws InputError  a mesh that is not known, options that it does not take
void check_mesh_options(const RadiosityMeshOptions& options);

/// The first mesh and what is to become of it.
/// @param light  what the mesh is made for; its shadows count with `--shadow-edges`
/// @throws InputError, ResourceError as `mesh_scene` and `MeshLoop`
std::unique_ptr<MeshLoop> make_mesh_loop(const LitScene& lit, const RadiosityMeshOptions& options,
                                         const InteriorOptions& interior,
                                         std::vector<Finding>& findings);

/// Whether the mesh suits the light as well as it was asked to; where not, a finding says so.
bool is_fine_enough(const MeshLoop& loop, const RadiosityMeshOptions& options, double tolerance_pct,
                    std::vector<Finding>& findings);

/// Writes `--report`: the first mesh, for bubbles one that is split from it with twice as many
/// elements, and the last one. Those that are not there yet are solved for it.
void write_mesh_report(const LitScene& lit, const RadiosityMeshOptions& options,
                       const InteriorOptions& interior, const MeshLoop& last,
                       const LightRequest& request, Progress& progress);

}  // namespace tenku
