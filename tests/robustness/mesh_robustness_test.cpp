// Broken and hostile PLY, STL and Radiance files: read, or refused with their place.
#include <gtest/gtest.h>

#include "tests/robustness/refusal.h"
#include "tests/scene/mesh_texts.h"

namespace tenku {
namespace {

void expect_cut_is_refused(const std::string& name, const std::string& text, std::size_t step) {
  EXPECT_EQ(refusal_of_text(name, text), "");
  for (std::size_t length = 0; length < text.size(); length += step) {
    EXPECT_NE(refusal_of_text(name, text.substr(0, length)), "") << name << " " << length;
  }
}

void put_every_byte(const std::string& name, const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    for (const char c : {'0', '9', '-', '\n', '\xff', '\x80'}) {
      std::string broken = text;
      broken[i] = c;
      refusal_of_text(name, broken);
    }
  }
}

TEST(MeshRobustness, CutOffFilesAreRefused) {
  expect_cut_is_refused("a.ply", binary_ply(std::endian::little), 3);
  expect_cut_is_refused("a.ply", binary_ply(std::endian::big), 3);
  expect_cut_is_refused("a.stl", binary_stl("box"), 5);
  // Cut within the last number, a file of text cannot be told from a whole one.
  const std::string ply = ascii_ply(), stl = ascii_stl(), rad = kRadiance;
  expect_cut_is_refused("a.ply", ply.substr(0, ply.size() - 1), 3);
  expect_cut_is_refused("a.stl", stl.substr(0, stl.rfind("endsolid") + 8), 5);
  for (std::size_t length = 0; length + 9 < rad.size(); length += 2) {
    EXPECT_NE(refusal_of_text("a.rad", rad.substr(0, length)), "") << length;
  }
}

TEST(MeshRobustness, WrongPlyIsRefused) {
  for (const auto& [old, with] : std::initializer_list<std::pair<const char*, const char*>>{
           {"ply\n", "plyer\n"},
           {"format ascii", "format ebcdic"},
           {"format ascii 1.0\n", ""},
           {"element vertex 8", "element vertex 4294967296"},
           {"element vertex 8", "element vertex -8"},
           {"element vertex 8", "element vertex 1e300"},
           {"element vertex 8", "element vertex 8.5"},
           {"element face 6", "element face 4000000000"},
           {"element vertex 8", "element vertex 7"},
           {"property float x", "property quaternion x"},
           {"vertex_indices", "corners"},
           {"4 0 3 2 1", "4 0 3 2 8"},
           {"4 0 3 2 1", "4 0 3 2 -1"},
           {"4 0 3 2 1", "-4 0 3 2 1"},
           {"4 0 3 2 1", "4000000000 0 3 2 1"},
           {"4.000000 0", "nan 0"},
           {"end_header\n", ""}}) {
    EXPECT_NE(refusal_of_text("a.ply", replaced(ascii_ply(), old, with)), "") << with;
  }
  // A point cloud has no surfaces; elements without properties take no room.
  EXPECT_NE(refusal_of_text("a.ply",
                            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                            "end_header\n1\n"),
            "");
  EXPECT_NE(refusal_of_text("a.ply",
                            "ply\nformat ascii 1.0\nelement face 4000000000\n"
                            "end_header\n"),
            "");
}

TEST(MeshRobustness, WrongStlIsRefused) {
  for (const auto& [old, with] :
       std::initializer_list<std::pair<const char*, const char*>>{{"vertex 0", "vertex nan"},
                                                                  {"vertex 0", "vertex 1e999"},
                                                                  {"vertex 0", "vertex"},
                                                                  {"outer loop", "inner loop"},
                                                                  {"endfacet", "endfacets"},
                                                                  {"endsolid", ""}}) {
    const std::string message = refusal_of_text("a.stl", replaced(ascii_stl(), old, with));
    EXPECT_NE(message.find("line "), std::string::npos) << with << ": " << message;
  }
  std::string many = binary_stl("box");
  many[83] = '\xff';
  EXPECT_NE(refusal_of_text("a.stl", many).find("cut off"), std::string::npos);
  std::string infinite = binary_stl("box");
  infinite.replace(96, 4, bytes_of(0x7f800000));
  EXPECT_NE(refusal_of_text("a.stl", infinite).find("triangle 1"), std::string::npos);
}

TEST(MeshRobustness, WrongRadianceIsRefusedWithItsLine) {
  for (const auto& [old, with] : std::initializer_list<std::pair<const char*, const char*>>{
           {"12\n0 0 0", "11\n0 0 0"},
           {"12\n0 0 0", "6\n0 0 0"},
           {"12\n0 0 0", "-1\n0 0 0"},
           {"12\n0 0 0", "99999999999999999999\n0 0 0"},
           {"12\n0 0 0", "4000000000\n0 0 0"},
           {"12\n0 0 0", "12\n0 nan 0"},
           {"5 .8 .7 .6 0 0", "3 .8 .7 .6"},
           {"5 .8 .7 .6 0 0", "5 1.8 .7 .6 0 0"},
           {"5 .8 .7 .6 0 0", "5 .8 .7 .6 -1 0"},
           {"void plastic", "void glass"},
           {"void plastic white\n0\n0\n5 .8 .7 .6 0 0", "void light white\n0\n0\n3 -1 0 0"}}) {
    const bool is_glass = std::string(with) == "void glass";
    const std::string message = refusal_of_text("a.rad", replaced(kRadiance, old, with));
    EXPECT_NE(message.find("line "), std::string::npos) << with << ": " << message;
    if (is_glass) {
      EXPECT_NE(message.find("index"), std::string::npos) << message;
    }
  }
}

TEST(MeshRobustness, EachByteMayBeWrong) {
  put_every_byte("a.ply", ascii_ply());
  put_every_byte("a.ply", binary_ply(std::endian::little));
  put_every_byte("a.rad", kRadiance);
  std::string stl = ascii_stl();
  put_every_byte("a.stl", stl.substr(0, 400) + "endsolid\n");
  put_every_byte("a.stl", binary_stl("solid").substr(0, 84 + 100));
}

}  // namespace
}  // namespace tenku
