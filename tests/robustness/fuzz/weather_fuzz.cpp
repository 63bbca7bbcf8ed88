// Weather: EPW and WEA are told apart by their first line.
#include <string_view>

#include "fuzz_file.h"
#include "site/weather_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using namespace tenku;
  return read_or_refuse([&] {
    parse_weather({reinterpret_cast<const char*>(bytes), count}, TENKU_FUZZ_FILE);
  });
}
