// Broken and hostile scene files: each is read, or refused with a message that names it.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <fstream>
#include <iterator>

#include "core/error.h"
#include "tests/robustness/refusal.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;

const char* const kCityJson =
    R"({"type":"CityJSON","version":"2.0","metadata":{"referenceSystem":)"
    R"("https://www.opengis.net/def/crs/EPSG/0/7415"},"transform":{"scale":[0.001,0.001,0.001],)"
    R"("translate":[85000,447000,0]},"geometry-templates":{"templates":[{"type":"MultiSurface",)"
    R"("lod":"1","boundaries":[[[0,1,2]]]}],"vertices-templates":[[0,0,0],[1,0,0],[0,1,0]]},)"
    R"("CityObjects":{"b":{"type":"Building","geometry":[{"type":"Solid","lod":"2",)"
    R"("boundaries":[[[[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]]],)"
    R"("semantics":{"surfaces":[{"type":"RoofSurface"}],"values":[[null,0,null,null,null,null]]}}]},)"
    R"("t":{"type":"SolitaryVegetationObject","geometry":[{"type":"GeometryInstance","template":0,)"
    R"("boundaries":[0],"transformationMatrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}]}},)"
    R"("vertices":[[0,0,0],[2000,0,0],[2000,3000,0],[0,3000,0],[0,0,4000],[2000,0,4000],)"
    R"([2000,3000,4000],[0,3000,4000]]})";

const char* const kObj =
    "# a house\nmtllib none.mtl\no house\nv 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 0\nv 2 1 5\n"
    "usemtl wall\nf 1 2 3 4\nf 1/1 2/2 5/3\nf -5 -2 -1\n";

void cut_everywhere(const std::string& name, const std::string& text, bool must_refuse) {
  for (std::size_t part = 0; part < 50; ++part) {
    const std::string message = refusal_of_text(name, text.substr(0, part * text.size() / 50));
    if (must_refuse) {
      EXPECT_NE(message, "") << part;
    }
  }
}

std::string packed(const std::string& text) {
  z_stream stream{};
  deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
  std::string out(text.size() + 1000, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<unsigned>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<unsigned>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

TEST(Robustness, WholeFilesAreRead) {
  EXPECT_EQ(refusal_of_text("a.city.json", kCityJson), "");
  EXPECT_EQ(refusal_of_text("a.obj", kObj), "");
  EXPECT_EQ(refusal_of_text("a.city.json.gz", packed(kCityJson)), "");
  EXPECT_EQ(refusal_of_text("plainly_named.obj", packed(kObj)), "");
}

TEST(Robustness, CutOffFilesAreRefusedOrRead) {
  cut_everywhere("a.city.json", kCityJson, true);
  cut_everywhere("a.city.json.gz", packed(kCityJson), true);
  cut_everywhere("a.obj.gz", packed(kObj), true);
  cut_everywhere("a.obj", kObj, false);  // an OBJ has no end of its own
}

TEST(Robustness, CutOffSequenceIsRefusedWithItsLine) {
  std::string feature =
      R"({"type":"CityJSONFeature","id":"b","CityObjects":{"b":{"type":"Building",)"
      R"("geometry":[{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]]]}]}},)"
      R"("vertices":[[0,0,0],[1,0,0],[0,1,0]]})";
  const std::string head = R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],)"
                           R"("translate":[0,0,0]},"CityObjects":{},"vertices":[]})"
                           "\n";
  EXPECT_EQ(refusal_of_text("a.city.jsonl", head + feature), "");
  for (std::size_t part = 1; part < 50; ++part) {
    const std::string cut = feature.substr(0, part * feature.size() / 50);
    EXPECT_NE(refusal_of_text("a.city.jsonl", head + cut).find("line 2"), std::string::npos)
        << part;
  }
  feature = replaced(feature, "[[[0,1,2]]]", "[[[0,1,3]]]");
  const std::string message = refusal_of_text("a.city.jsonl", head + feature);
  EXPECT_NE(message.find("line 2"), std::string::npos) << message;
  EXPECT_NE(message.find("object 'b'"), std::string::npos) << message;
}

TEST(Robustness, WrongValuesAreRefusedWithTheirObject) {
  for (const auto& [old, with] : std::initializer_list<std::pair<const char*, const char*>>{
           {"[0,3,2,1]", "[0,3,2,8]"},
           {"[0,3,2,1]", "[0,3,2,-1]"},
           {"[0,3,2,1]", "[0,3,2,1.5]"},
           {"[0,3,2,1]", "[0,3,2,18446744073709551615]"},
           {"[0,3,2,1]", "[0,3,2,4294967296]"},
           {"[0,3,2,1]", "[[[[[[[[[[0]]]]]]]]]]"},
           {"[0,3,2,1]", "\"0\""},
           {"\"boundaries\":[[[[0", "\"boundary\":[[[[0"},
           {"\"type\":\"Solid\"", "\"type\":\"Sphere\""},
           {"\"type\":\"Solid\"", "\"type\":7"},
           {"\"template\":0", "\"template\":1"},
           {"\"boundaries\":[0]", "\"boundaries\":[99]"},
           {"\"boundaries\":[0]", "\"boundaries\":[]"},
           {"[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]", "[1,0,0]"},
           {"[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]", "[\"a\",0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]"}}) {
    const std::string message = refusal_of_text("a.city.json", replaced(kCityJson, old, with));
    EXPECT_NE(message.find("object '"), std::string::npos) << with << ": " << message;
  }
}

TEST(Robustness, WrongDocumentsAreRefused) {
  for (const auto& [old, with] : std::initializer_list<std::pair<const char*, const char*>>{
           {"[2000,0,0]", "[2000,0]"},
           {"[2000,0,0]", "[2000,0,null]"},
           {"[2000,0,0]", "[2000,0,\"0\"]"},
           {"[2000,0,0]", "[2000,0,NaN]"},
           {"[2000,0,0]", "[2000,0,1e999]"},
           {"[2000,0,0]", "[1e308,1e308,1e308]"},
           {"\"scale\":[0.001,0.001,0.001]", "\"scale\":[1e308,1e308,1e308]"},
           {"\"scale\":[0.001,0.001,0.001]", "\"scale\":[0,0,0]"},
           {"\"scale\":[0.001,0.001,0.001]", "\"scala\":1"},
           {"\"type\":\"CityJSON\"", "\"type\":\"FeatureCollection\""},
           {"\"CityObjects\"", "\"Cities\""},
           {"\"vertices\":", "\"points\":"}}) {
    EXPECT_NE(refusal_of_text("a.city.json", replaced(kCityJson, old, with)), "") << with;
  }
  for (const char* text : {"[]", "3", "null", "\"a\"", "{}", "{", "\0", "\xEF\xBB\xBF", "<gml/>"}) {
    EXPECT_NE(refusal_of_text("a.city.json", text), "") << text;
  }
}

TEST(Robustness, DeepNestingIsRefused) {
  for (const std::size_t depth : {10U, 1000U, 100000U}) {
    const std::string nest = std::string(depth, '[') + "0" + std::string(depth, ']');
    EXPECT_NE(refusal_of_text("a.city.json", replaced(kCityJson, "[0,3,2,1]", nest)), "") << depth;
    EXPECT_NE(refusal_of_text("a.city.json", nest), "") << depth;
  }
}

TEST(Robustness, CircularParentsAreBorne) {
  std::string text = replaced(kCityJson, "\"b\":{\"type\":\"Building\",",
                              "\"b\":{\"type\":\"BuildingPart\",\"parents\":[\"b\"],");
  EXPECT_EQ(refusal_of_text("a.city.json", text), "");
  text = replaced(text, "[\"b\"]", "[\"nobody\"]");
  EXPECT_EQ(refusal_of_text("a.city.json", text), "");
}

TEST(Robustness, WrongObjLinesAreRefusedWithTheirNumber) {
  for (const char* line : {"v nan 0 0", "v inf 0 0", "v 1e999 0 0", "v 1 2", "v a b c", "v 1,0 2 3",
                           "f 1 2 99", "f 0 1 2", "f -9 1 2", "f 1 2 99999999999999999999",
                           "f a b c", "f", "f 1.5 2 3", "f 1 2 3x"}) {
    const std::string text = replaced(kObj, "v 2 1 5\n", "v 2 1 5\n" + std::string(line) + "\n");
    const std::string message = refusal_of_text("a.obj", text);
    EXPECT_NE(message.find("line 9"), std::string::npos) << line << ": " << message;
  }
  for (const char* text : {"v 0 0 0\n", "hello\n", "f", "v", "\\", "\n", "v 1 1 1\nf 1 1 1\n"}) {
    EXPECT_NE(refusal_of_text("a.obj", text), "") << text;
  }
}

TEST(Robustness, WrongMtlIsRefusedWithItsLine) {
  const TemporaryFolder folder;
  folder.write("none.mtl", "newmtl wall\nKd 0.5 nan 0.5\n");
  folder.write("a.obj", kObj);
  try {
    read(folder.path() / "a.obj");
    FAIL() << "was read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("none.mtl, line 2"), std::string::npos)
        << error.what();
  }
}

TEST(Robustness, WhatIsNoFileIsRefused) {
  const TemporaryFolder folder;
  EXPECT_NE(refusal_of(folder.path() / "absent.obj").find("there is no file"), std::string::npos);
  fs::create_directory(folder.path() / "folder.obj");
  EXPECT_NE(refusal_of(folder.path() / "folder.obj").find("is a folder"), std::string::npos);
  EXPECT_NE(refusal_of_text("empty.obj", "").find("is empty"), std::string::npos);
  EXPECT_NE(refusal_of_text("city.xyz", "1 2 3").find("format"), std::string::npos);
  const fs::path secret = folder.write("secret.obj", kObj);
  chmod(secret.c_str(), 0);
  if (geteuid() != 0) {
    EXPECT_NE(refusal_of(secret).find("cannot read"), std::string::npos);
  }
}

TEST(Robustness, EachByteMayBeWrong) {
  const std::string text = kCityJson;
  for (std::size_t i = 0; i < text.size(); i += 7) {
    for (const char c : {'0', '"', '[', '\x80'}) {
      std::string broken = text;
      broken[i] = c;
      refusal_of_text("a.city.json", broken);
    }
  }
  const std::string obj = kObj;
  for (std::size_t i = 0; i < obj.size(); ++i) {
    for (const char c : {'-', '9', '\n', '\\', '\x80'}) {
      std::string broken = obj;
      broken[i] = c;
      refusal_of_text("a.obj", broken);
    }
  }
}

// The corpus says of each case what is expected; here only that none brings us down, and that
// the ones called invalid are refused.
TEST(Robustness, FormatTestsAreReadOrRefused) {
  const auto folder = data_folder();
  if (!folder) GTEST_SKIP() << "TENKU_DATA does not name the folder of real data";
  std::size_t files = 0, was_read = 0;
  for (const char* part : {"cityjson-corpus", "cityjsonseq", "cjval", "obj"}) {
    for (const auto& entry : fs::recursive_directory_iterator(*folder / "format-tests" / part)) {
      const std::string name = entry.path().filename().string();
      const std::string extension = entry.path().extension().string();
      if (extension != ".json" && extension != ".jsonl" && extension != ".obj") continue;
      const bool is_fine = refusal_of(entry.path()).empty();
      ++files;
      was_read += is_fine ? 1 : 0;
      if (name.starts_with("invalid") || name == "test-nan.obj" || name == "case.json") {
        EXPECT_FALSE(is_fine) << entry.path();
      }
    }
  }
  EXPECT_GT(files, 70U);
  EXPECT_GT(was_read, 30U);
}

}  // namespace
}  // namespace tenku
