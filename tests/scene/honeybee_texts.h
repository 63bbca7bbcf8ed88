/// A small Honeybee model.
#pragma once

#include <string>

namespace tenku {

inline std::string face3d(const std::string& points) {
  return R"("geometry":{"type":"Face3D","boundary":[)" + points + "]}";
}

/// A wall of 4 x 3 m with a window of 2 x 1 m and a door of 1 x 2 m, each with its own modifier or
/// that of the room's set; a shade before it.
inline const std::string kHoneybee =
    R"({"type":"Model","identifier":"m","units":"Meters","properties":{"radiance":{"modifiers":[)"
    R"({"type":"Plastic","identifier":"brick","r_reflectance":0.4,"g_reflectance":0.3,)"
    R"("b_reflectance":0.2,"specularity":0.0,"roughness":0.0},)"
    R"({"type":"glass","identifier":"pane","r_transmissivity":0.96,"g_transmissivity":0.96,)"
    R"("b_transmissivity":0.96,"refraction_index":null},)"
    R"({"type":"Mirror","identifier":"shiny","r_reflectance":0.9,"g_reflectance":0.9,)"
    R"("b_reflectance":0.9}],"modifier_sets":[{"identifier":"set","wall_set":)"
    R"({"exterior_modifier":"brick","interior_modifier":null}}]}},"rooms":[{"type":"Room",)"
    R"("identifier":"room","properties":{"radiance":{"modifier_set":"set"}},"faces":[)"
    R"({"type":"Face","identifier":"wall","face_type":"Wall","boundary_condition":{"type":"Outdoors"},)" +
    face3d("[0,0,0],[4,0,0],[4,0,3],[0,0,3]") +
    R"(,"apertures":[{"type":"Aperture","identifier":"window","properties":{"radiance":)"
    R"({"modifier":"pane"}},)" +
    face3d("[0.5,0,1],[2.5,0,1],[2.5,0,2],[0.5,0,2]") +
    R"(}],"doors":[{"type":"Door","identifier":"door",)" +
    face3d("[2.75,0,0.25],[3.75,0,0.25],[3.75,0,2.25],[2.75,0,2.25]") +
    R"(}]}]}],"orphaned_shades":[{"type":"Shade","identifier":"shade","properties":{"radiance":)"
    R"({"modifier":"shiny"}},)" +
    face3d("[0,-1,3],[4,-1,3],[4,-2,3]") + "}]}";

}  // namespace tenku
