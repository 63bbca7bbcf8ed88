// A store of points: its records, then all points and all light.
#include "flythrough/point_store.h"
#include "fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using namespace tenku;
  return read_or_refuse([&] {
    const PointStore store(fuzz_file(TENKU_FUZZ_FILE, bytes, count));
    for (std::size_t c = 0; c < store.chunks().size(); ++c) {
      (void)store.points(c);
      for (std::size_t l = 0; l < store.lightings().size(); ++l) {
        if (store.has_light(c, l)) (void)store.light(c, l);
      }
    }
  });
}
