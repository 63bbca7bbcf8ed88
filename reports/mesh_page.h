/// Meshes of one scene side by side, each with the light that was found on it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "reports/mesh_picture.h"

namespace tenku {

/// A mesh on the page.
struct MeshPageColumn {
  std::string title;
  std::vector<std::pair<std::string, std::string>> facts;  ///< name and value
  MeshPictures pictures;
};

/// One page of HTML 5, nothing loaded from elsewhere: for each mesh its edges, the light on it and
/// what is to be said of it.
std::string mesh_page(const std::string& title, const std::vector<MeshPageColumn>& columns);

}  // namespace tenku
