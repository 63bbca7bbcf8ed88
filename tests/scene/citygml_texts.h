/// Small CityGML models for tests.
#pragma once

#include <array>
#include <string>

#include "tests/scene/scene_files.h"

namespace tenku {

inline std::string city_model(const std::string& members, const std::string& version = "2.0",
                              const std::string& crs = "urn:ogc:def:crs:EPSG::28992") {
  return R"(<?xml version="1.0" encoding="UTF-8"?>
<core:CityModel xmlns:core="http://www.opengis.net/citygml/)" +
         version + R"(" xmlns:gml="http://www.opengis.net/gml">
<gml:boundedBy><gml:Envelope srsName=")" +
         crs + R"(" srsDimension="3"><gml:lowerCorner>0 0 0</gml:lowerCorner>
<gml:upperCorner>1 1 1</gml:upperCorner></gml:Envelope></gml:boundedBy>
)" + members +
         "</core:CityModel>\n";
}

inline std::string member(const std::string& type, const std::string& id,
                          const std::string& content) {
  return "<core:cityObjectMember><" + type + " gml:id=\"" + id + "\">" + content + "</" + type +
         "></core:cityObjectMember>\n";
}

inline std::string building(const std::string& id, const std::string& content) {
  return member("bldg:Building", id, content);
}

inline std::string face(const std::string& id, const std::string& points) {
  return "<gml:surfaceMember><gml:Polygon" + (id.empty() ? "" : " gml:id=\"" + id + "\"") +
         "><gml:exterior><gml:LinearRing><gml:posList>" + points +
         "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>";
}

inline std::string link_to(const std::string& id) {
  return "<gml:surfaceMember xlink:href=\"#" + id + "\"/>";
}

inline std::string solid(const std::string& faces, const std::string& lod) {
  return "<bldg:lod" + lod + "Solid><gml:Solid><gml:exterior><gml:CompositeSurface>" + faces +
         "</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod" + lod + "Solid>";
}

/// @param more  further members
inline std::string surface(const std::string& type, const std::string& faces,
                           const std::string& more = "") {
  return "<bldg:boundedBy><bldg:" + type + "><bldg:lod2MultiSurface><gml:MultiSurface>" + faces +
         more + "</gml:MultiSurface></bldg:lod2MultiSurface></bldg:" + type + "></bldg:boundedBy>";
}

// A box of 4 by 3 by 5 m, its faces counter-clockwise seen from outside.
inline const std::string kBottom =
    "100000 450000 0 100000 450003 0 100004 450003 0 100004 450000 0 100000 450000 0";
inline const std::string kTop =
    "100000 450000 5 100004 450000 5 100004 450003 5 100000 450003 5 100000 450000 5";
inline const std::string kSouth =
    "100000 450000 0 100004 450000 0 100004 450000 5 100000 450000 5 100000 450000 0";
inline const std::string kEast =
    "100004 450000 0 100004 450003 0 100004 450003 5 100004 450000 5 100004 450000 0";
inline const std::string kNorth =
    "100004 450003 0 100000 450003 0 100000 450003 5 100004 450003 5 100004 450003 0";
inline const std::string kWest =
    "100000 450003 0 100000 450000 0 100000 450000 5 100000 450003 5 100000 450003 0";

/// Faces `f0` to `f5`, or with `suffix` behind: bottom, walls, top.
inline std::string faces_of_box(const std::string& suffix) {
  const std::array<std::string, 6> faces{kBottom, kSouth, kEast, kNorth, kWest, kTop};
  std::string text;
  for (std::size_t f = 0; f < 6; ++f) text += face("f" + std::to_string(f) + suffix, faces[f]);
  return text;
}

inline std::string links_to_box() {
  std::string text;
  for (int f = 0; f < 6; ++f) text += link_to("f" + std::to_string(f));
  return text;
}

inline std::string box_building(const std::string& id = "b1") {
  return building(id, solid(links_to_box(), "2") + surface("GroundSurface", face("f0", kBottom)) +
                          surface("WallSurface", face("f1", kSouth) + face("f2", kEast) +
                                                     face("f3", kNorth) + face("f4", kWest)) +
                          surface("RoofSurface", face("f5", kTop)));
}

}  // namespace tenku
