// Broken and hostile glTF files: read, or refused with what is wrong in them.
#include <gtest/gtest.h>

#include "tests/robustness/refusal.h"
#include "tests/scene/draco_texts.h"
#include "tests/scene/gltf_texts.h"

namespace tenku {
namespace {

TEST(GltfRobustness, WholeFileIsReadAndEveryCutOneIsRefused) {
  EXPECT_EQ(refusal_of_text("a.glb", glb()), "");
  for (std::size_t length = 0; length < glb().size(); length += 7) {
    EXPECT_NE(refusal_of_text("a.glb", glb().substr(0, length)), "") << length;
  }
  EXPECT_EQ(refusal_of_text("a.gltf", gltf_text()), "");
  for (std::size_t length = 0; length < gltf_text().size(); length += 11) {
    EXPECT_NE(refusal_of_text("a.gltf", gltf_text().substr(0, length)), "") << length;
  }
}

TEST(GltfRobustness, WrongFilesAreRefused) {
  for (const auto& [old, with] : std::initializer_list<std::pair<const char*, const char*>>{
           {R"("version":"2.0")", R"("version":"1.0")"},
           {R"("version":"2.0")", R"("version":2)"},
           {R"("asset")", R"("assets")"},
           {R"("nodes":[0])", R"("nodes":[7])"},
           {R"("nodes":[0])", R"("nodes":[-1])"},
           {R"("nodes":[0])", R"("nodes":[0.5])"},
           {R"("nodes":[0])", R"("nodes":["0"])"},
           {R"("scene":0)", R"("scene":1)"},
           {R"("mesh":0)", R"("mesh":1)"},
           {R"("mesh":0)", R"("children":[0],"mesh":0)"},
           {R"("name":"box")", R"("name":7)"},
           {R"("name":"box")", R"("matrix":[1,2,3])"},
           {R"("name":"box")", R"("scale":[1e308,1e308,1e308])"},
           {R"("name":"box")", R"("scale":[1,1,1e999])"},
           {R"("name":"box")", R"("rotation":[0,0,0,0])"},
           {R"("POSITION":0)", R"("NORMAL":0)"},
           {R"("POSITION":0)", R"("POSITION":2)"},
           {R"("POSITION":0)", R"("POSITION":1)"},
           {R"("indices":1)", R"("indices":0)"},
           {R"("material":0)", R"("material":1)"},
           {R"("material":0)", R"("mode":7)"},
           {R"("count":8)", R"("count":9)"},
           {R"("count":8)", R"("count":7)"},  // an index is then out of range
           {R"("count":8)", R"("count":18446744073709551615)"},
           {R"("count":36)", R"("count":37)"},
           {R"("componentType":5126)", R"("componentType":5124)"},
           {R"("componentType":5126)", R"("componentType":0)"},
           {R"("type":"VEC3")", R"("type":"VEC2")"},
           {R"("bufferView":0,)", R"("bufferView":9,)"},
           {R"("byteLength":96)", R"("byteLength":95)"},
           {R"("byteLength":96)", R"("byteLength":96,"byteStride":4)"},
           {R"("byteLength":96)", R"("byteLength":96,"byteStride":1000000000000)"},
           {R"("byteOffset":96)", R"("byteOffset":18446744073709551615)"},
           {R"("byteLength":168)", R"("byteLength":169)"},
           {"base64,", "base64,%"},
           {";base64,", ","},
           {"data:application", "https://example.org/application"},
           {"data:application/octet-stream;base64,", "nobody/"}}) {
    EXPECT_NE(refusal_of_text("a.gltf", replaced(gltf_text(), old, with)), "") << with;
  }
  for (const char* text : {"[]", "{}", "7", "\xEF\xBB\xBF", "glTF", "glTF\2\0\0\0"}) {
    EXPECT_NE(refusal_of_text("a.glb", text), "") << text;
  }
}

// A few bytes that ask for more than any memory holds.
TEST(GltfRobustness, SmallFilesThatAskForMuchAreRefused) {
  EXPECT_NE(refusal_of_text(
                "a.gltf", replaced(gltf_text(), R"("bufferView":0,"componentType":5126,"count":8)",
                                   R"("componentType":5126,"count":400000000000)")),
            "");
  // One mesh a million times under nodes of nodes cannot be said: a node hangs in one place.
  std::string nodes;
  for (int k = 1; k < 30; ++k) {
    nodes += R"({"children":[)" + std::to_string(k) + "," + std::to_string(k) + "]},";
  }
  EXPECT_NE(refusal_of_text("a.gltf",
                            replaced(gltf_text(), R"("nodes":[{)", R"("nodes":[)" + nodes + "{")),
            "");
}

TEST(GltfRobustness, DeepTreesAreRead) {
  std::string nodes;
  for (int k = 1; k <= 20000; ++k) nodes += R"({"children":[)" + std::to_string(k) + "]},";
  EXPECT_EQ(refusal_of_text("a.gltf",
                            replaced(gltf_text(), R"("nodes":[{)", R"("nodes":[)" + nodes + "{")),
            "");
}

TEST(GltfRobustness, EachByteMayBeWrong) {
  for (const std::string name : {"a.gltf", "a.glb"}) {
    const std::string text = name == "a.glb" ? glb() : gltf_text();
    for (std::size_t i = 0; i < text.size(); i += 3) {
      for (const char c : {'0', '9', '"', '\xff'}) {
        std::string broken = text;
        broken[i] = c;
        refusal_of_text(name, broken);
      }
    }
  }
}

TEST(GltfRobustness, PackedMeshesMayBeWrongInEachByte) {
  const std::string packed = packed_box();
  EXPECT_EQ(refusal_of_text("a.gltf", draco_json(packed)), "");
  for (std::size_t i = 0; i < packed.size(); ++i) {
    for (const char c : {'\0', '\1', '\x7f', '\x80', '\xff'}) {
      std::string broken = packed;
      broken[i] = c;
      refusal_of_text("a.gltf", draco_json(broken));
    }
  }
}

// The validator's own files: those whose fault lies in what is read here are refused, none brings
// us down. A file that says `0 errors` in its report may still have nothing to show.
TEST(GltfRobustness, FilesOfTheValidatorAreReadOrRefused) {
  const auto folder = data_folder();
  if (!folder) GTEST_SKIP() << "TENKU_DATA does not name the folder of real data";
  std::size_t files = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(*folder / "format-tests" / "gltf")) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".gltf" && extension != ".glb") continue;
    refusal_of(entry.path());
    ++files;
  }
  EXPECT_GT(files, 100U);
}

}  // namespace
}  // namespace tenku
