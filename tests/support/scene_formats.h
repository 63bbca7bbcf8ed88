/// A scene in the encodings of others, written for tests by the formats' own rules.
#pragma once

#include <array>
#include <bit>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "scene/flatten.h"
#include "scene/scene.h"

namespace tenku::testing_support {

/// Easting, northing, height of a vertex.
inline Vec3 on_map(const Scene& scene, std::uint32_t v) {
  return scene.map_frame.to_file(scene.vertices[v]);
}

/// Words that the readers of plain meshes know a surface by.
inline std::string word_of(SurfaceType type) {
  return type == SurfaceType::Unknown ? "other" : std::string(name_of(type));
}

/// Triangles as OBJ in map coordinates, z up; materials named by the type of their surfaces.
inline std::string obj_of(const Scene& scene) {
  std::ostringstream text;
  text.precision(12);
  const TriangleSoup soup = flatten(scene);
  for (const Vec3 v : soup.vertices) {
    const Vec3 p = scene.map_frame.to_file(v);
    text << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
  }
  for (std::size_t t = 0; t < soup.size(); ++t) {
    const auto& [a, b, c] = soup.triangles[t];
    text << "o " << scene.objects[soup.object[t]].id << "\nusemtl " << word_of(soup.surface_type[t])
         << "\nf " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
  }
  return text.str();
}

/// Triangles as GLB, y up: 32-bit positions about a node that stands at the origin of the map
/// frame.
inline std::string glb_of(const Scene& scene) {
  const TriangleSoup soup = flatten(scene);
  const Vec3 origin = scene.map_frame.origin();
  std::map<SurfaceType, std::string> bytes;
  const auto append = [](std::string& to, auto value) {
    const auto raw = std::bit_cast<std::array<char, sizeof value>>(value);
    to.append(raw.data(), raw.size());
  };
  for (std::size_t t = 0; t < soup.size(); ++t) {
    for (const std::uint32_t v : soup.triangles[t]) {
      const Vec3 p = scene.map_frame.to_file(soup.vertices[v]) - origin;
      for (const double x : {p.x, p.z, -p.y}) {
        append(bytes[soup.surface_type[t]], static_cast<float>(x));
      }
    }
  }
  std::ostringstream primitives, materials, accessors, views;
  std::string buffer;
  std::size_t k = 0;
  for (const auto& [type, part] : bytes) {
    const char* comma = k > 0 ? "," : "";
    primitives << comma << R"({"attributes":{"POSITION":)" << k << R"(},"material":)" << k << "}";
    materials << comma << R"({"name":")" << word_of(type) << "\"}";
    accessors << comma << R"({"bufferView":)" << k
              << R"(,"componentType":5126,"type":"VEC3","count":)" << part.size() / 12 << "}";
    views << comma << R"({"buffer":0,"byteOffset":)" << buffer.size() << R"(,"byteLength":)"
          << part.size() << "}";
    buffer += part;
    ++k;
  }
  std::ostringstream json;
  json.precision(12);
  json << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,)"
       << R"("name":"town","translation":[)" << origin.x << ',' << origin.z << ',' << -origin.y
       << R"(]}],"meshes":[{"primitives":[)" << primitives.str() << R"(]}],"materials":[)"
       << materials.str() << R"(],"accessors":[)" << accessors.str() << R"(],"bufferViews":[)"
       << views.str() << R"(],"buffers":[{"byteLength":)" << buffer.size() << "}]}";
  std::string text = json.str();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const auto u32 = [](std::size_t value) {
    const auto raw = std::bit_cast<std::array<char, 4>>(static_cast<std::uint32_t>(value));
    return std::string(raw.data(), 4);
  };
  return "glTF" + u32(2) + u32(12 + 8 + text.size() + 8 + buffer.size()) + u32(text.size()) +
         "JSON" + text + u32(buffer.size()) + std::string("BIN\0", 4) + buffer;
}

/// Polygons as CityGML 2.0: buildings of thematic surfaces, and land use for all else.
inline std::string citygml_of(const Scene& scene) {
  std::ostringstream text;
  text.precision(12);
  text << "<?xml version=\"1.0\"?><CityModel xmlns=\"http://www.opengis.net/citygml/2.0\" "
          "xmlns:gml=\"http://www.opengis.net/gml\"><gml:boundedBy><gml:Envelope srsName=\""
       << scene.georeference->crs << "\" srsDimension=\"3\"/></gml:boundedBy>\n";
  const auto put_polygon = [&](std::size_t s) {
    const Surfaces& all = scene.surfaces;
    text << "<surfaceMember><Polygon>";
    for (std::size_t r = all.first_ring[s]; r < all.first_ring[s + 1]; ++r) {
      const char* side = r == all.first_ring[s] ? "exterior" : "interior";
      text << '<' << side << "><LinearRing><posList>";
      for (const std::uint32_t v : all.ring(r)) {
        const Vec3 p = on_map(scene, v);
        text << p.x << ' ' << p.y << ' ' << p.z << ' ';
      }
      const Vec3 p = on_map(scene, all.ring(r)[0]);
      text << p.x << ' ' << p.y << ' ' << p.z << "</posList></LinearRing></" << side << '>';
    }
    text << "</Polygon></surfaceMember>";
  };
  const auto surface_name = [](SurfaceType type) {
    return type == SurfaceType::Roof     ? "RoofSurface"
           : type == SurfaceType::Ground ? "GroundSurface"
                                         : "WallSurface";
  };
  std::vector<std::vector<std::size_t>> of_object(scene.objects.size());
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    of_object[scene.surfaces.object[s]].push_back(s);
  }
  for (std::size_t o = 0; o < scene.objects.size(); ++o) {
    const bool is_building = scene.objects[o].type.starts_with("Building");
    const char* object = is_building ? "Building" : "LandUse";
    text << "<cityObjectMember><" << object << " gml:id=\"" << scene.objects[o].id << "\">";
    if (!is_building) text << "<lod1MultiSurface><MultiSurface>";
    for (const std::size_t s : of_object[o]) {
      if (!is_building) {
        put_polygon(s);
        continue;
      }
      const char* name = surface_name(scene.surfaces.type[s]);
      text << "<boundedBy><" << name << "><lod2MultiSurface><MultiSurface>";
      put_polygon(s);
      text << "</MultiSurface></lod2MultiSurface></" << name << "></boundedBy>";
    }
    if (!is_building) text << "</MultiSurface></lod1MultiSurface>";
    text << "</" << object << "></cityObjectMember>\n";
  }
  text << "</CityModel>\n";
  return text.str();
}

}  // namespace tenku::testing_support
