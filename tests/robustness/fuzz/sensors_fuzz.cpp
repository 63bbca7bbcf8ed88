// A file of sensors.
#include <string_view>

#include "fuzz_file.h"
#include "output/sensor_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using namespace tenku;
  return read_or_refuse([&] {
    sensors_from_text({reinterpret_cast<const char*>(bytes), count}, TENKU_FUZZ_FILE);
  });
}
