// A subtree of an implicit tileset: which tiles are there. Their contents are not.
#include "core/progress.h"
#include "fuzz_file.h"
#include "scene/read_scene.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using namespace tenku;
  static const std::string kTileset =
      R"({"asset":{"version":"1.1"},"geometricError":10,"root":{"boundingVolume":)"
      R"({"box":[0,0,0,10,0,0,0,10,0,0,0,10]},"refine":"REPLACE","geometricError":5,)"
      R"("content":{"uri":"t{level}_{x}_{y}.glb"},"implicitTiling":{"subdivisionScheme":)"
      R"("QUADTREE","subtreeLevels":2,"availableLevels":2,"subtrees":{"uri":"0.subtree"}}}})";
  fuzz_file(TENKU_FUZZ_FILE, bytes, count);
  return read_or_refuse([&] {
    Progress silent;
    read_scene(fuzz_file("tileset.json", reinterpret_cast<const std::uint8_t*>(kTileset.data()),
                         kTileset.size()),
               {}, silent);
  });
}
