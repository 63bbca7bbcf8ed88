// A file of materials.
#include "fuzz_file.h"
#include "scene/materials.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using namespace tenku;
  return read_or_refuse([&] { read_materials(fuzz_file(TENKU_FUZZ_FILE, bytes, count)); });
}
