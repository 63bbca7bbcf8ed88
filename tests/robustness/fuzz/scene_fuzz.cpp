// A scene file, by the reader of its name, up to its triangles.
#include "core/progress.h"
#include "fuzz_file.h"
#include "scene/flatten.h"
#include "scene/read_scene.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using namespace tenku;
  return read_or_refuse([&] {
    Progress silent;
    flatten(read_scene(fuzz_file(TENKU_FUZZ_FILE, bytes, count), {}, silent));
  });
}
