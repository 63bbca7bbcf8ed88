// Files changed at random, reader by reader: read or refused, in time and in little memory.
//
// TENKU_FUZZ_SECONDS  for all readers together (default 2)
// TENKU_FUZZ_SEED     of the changes (default 1); the same seed makes the same files
// TENKU_FUZZ_FORMAT   one name of the corpus alone, such as a.glb
// TENKU_FUZZ_SEEDS    a folder: the corpus is written there, for tests/robustness/fuzz/fuzz.sh
//
// A file that brings the program down is left in the temporary folder.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/random.h"
#include "tests/robustness/refusal.h"
#include "tests/scene/citygml_texts.h"
#include "tests/scene/draco_texts.h"
#include "tests/scene/gltf_texts.h"
#include "tests/scene/honeybee_texts.h"
#include "tests/scene/tile_texts.h"
#include "tests/support/long_runs.h"

namespace tenku {
namespace {

using testing_support::number_of;
using testing_support::seconds_since;
using Clock = std::chrono::steady_clock;

struct Sample {
  std::string name, text;
};

const char* const kCity =
    R"({"type":"CityJSON","version":"2.0","transform":{"scale":[0.001,0.001,0.001],)"
    R"("translate":[85000,447000,0]},"metadata":{"referenceSystem":)"
    R"("https://www.opengis.net/def/crs/EPSG/0/7415"},"CityObjects":{"b":{"type":"Building",)"
    R"("geometry":[{"type":"Solid","lod":"2","boundaries":[[[[0,3,2,1]],[[4,5,6,7],[8,9,10]]]],)"
    R"("semantics":{"surfaces":[{"type":"RoofSurface","tenku_material":{"name":"m",)"
    R"("reflectance":[0.5,0.5,0.5],"mirror":0.1}}],"values":[[null,0]]}}]}},"vertices":)"
    R"([[0,0,0],[2000,0,0],[2000,3000,0],[0,3000,0],[0,0,4000],[2000,0,4000],[2000,3000,4000],)"
    R"([0,3000,4000],[500,500,4000],[900,500,4000],[500,900,4000]]})";

/// One small file a reader.
std::vector<Sample> corpus() {
  return {
      {"a.city.json", kCity},
      {"a.gml", city_model(box_building())},
      {"a.obj", "o a\nv 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 1\nusemtl wall\nf 1 2 3 4\nf -1 -2 -4\n"},
      {"a.ply", ascii_ply()},
      {"b.ply", binary_ply(std::endian::little)},
      {"a.stl", ascii_stl()},
      {"b.stl", binary_stl("box")},
      {"a.rad", kRadiance},
      {"a.gltf", gltf_text()},
      {"a.glb", glb()},
      {"b.gltf", draco_json(packed_box())},
      {"a.hbjson", kHoneybee},
      {"a.b3dm", b3dm(batched_glb(), R"({"BATCH_LENGTH":2})", R"({"gml_id":["a","b"]})")}};
}

/// Changes a text in one to four places: bytes, pieces doubled, moved or lost, numbers that are
/// hard on readers.
class Mutator {
 public:
  Mutator(std::uint64_t seed, std::uint64_t sample, std::uint64_t turn)
      : random_(seed, sample, turn) {}

  std::string changed(std::string text) {
    for (std::size_t left = 1 + below(4); left > 0 && !text.empty(); --left) change(text);
    return text;
  }

 private:
  std::size_t below(std::size_t count) {
    return std::min(count - 1,
                    static_cast<std::size_t>(random_.uniform() * static_cast<double>(count)));
  }

  void change(std::string& text) {
    const std::size_t at = below(text.size()),
                      length = 1 + below(std::min<std::size_t>(64, text.size() - at));
    switch (below(6)) {
      case 0:
        text[at] = static_cast<char>(below(256));
        return;
      case 1:
        text[at] = static_cast<char>(static_cast<unsigned char>(text[at]) ^ (1U << below(8)));
        return;
      case 2:
        text.erase(at, length);
        return;
      case 3:
        text.insert(below(text.size()), text.substr(at, length));
        return;
      case 4:
        for (std::size_t k = 0; k < 4 && at + k < text.size(); ++k) {
          text[at + k] = below(2) == 0 ? '\xff' : '\0';
        }
        return;
      default:
        break;
    }
    static const std::vector<std::string> kHard{"-1",      "4294967295", "18446744073709551615",
                                                "1e308",   "-1e-308",    "1e999",
                                                "nan",     "0",          "[]",
                                                "{}",      "null",       "\"\"",
                                                "<",       "&",          "\n",
                                                "[[[[[[[["};
    const std::size_t digit = text.find_first_of("0123456789", at);
    if (digit == std::string::npos) return;
    const std::size_t end = text.find_first_not_of("0123456789.eE+-", digit);
    text.replace(digit, std::min(end, text.size()) - digit, kHard[below(kHard.size())]);
  }

  SampleRandom random_;
};

TEST(Mutations, ReadersReadOrRefuseThemInTime) {
  const double budget = number_of("TENKU_FUZZ_SECONDS", 2.0);
  const auto seed = static_cast<std::uint64_t>(number_of("TENKU_FUZZ_SEED", 1.0));
  const char* only = std::getenv("TENKU_FUZZ_FORMAT");
  std::vector<Sample> samples;
  for (Sample& sample : corpus()) {
    if (only == nullptr || sample.name == only) samples.push_back(std::move(sample));
  }
  ASSERT_FALSE(samples.empty());
  if (const char* seeds = std::getenv("TENKU_FUZZ_SEEDS")) {
    for (const Sample& sample : samples) {
      std::ofstream(std::filesystem::path(seeds) / sample.name, std::ios::binary) << sample.text;
    }
  }
  const TemporaryFolder folder;
  for (std::size_t s = 0; s < samples.size(); ++s) {
    EXPECT_EQ(refusal_of(folder.write(samples[s].name, samples[s].text)), "") << samples[s].name;
    const Clock::time_point start = Clock::now();
    std::uint64_t turns = 0, was_read = 0;
    double slowest = 0.0;
    while (seconds_since(start) < budget / static_cast<double>(samples.size())) {
      const std::string text = Mutator(seed, s, turns++).changed(samples[s].text);
      const Clock::time_point begin = Clock::now();
      was_read += refusal_of(folder.write(samples[s].name, text)).empty() ? 1 : 0;
      slowest = std::max(slowest, seconds_since(begin));
    }
    std::printf("[ MEASURED ] %s: %llu changed files, %llu read, the slowest %.3f s\n",
                samples[s].name.c_str(), static_cast<unsigned long long>(turns),
                static_cast<unsigned long long>(was_read), slowest);
    EXPECT_GT(turns, 0U);
    EXPECT_LT(slowest, 10.0) << samples[s].name;
  }
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  std::printf("[ MEASURED ] peak memory %ld MB\n", used.ru_maxrss / 1024);
#if !defined(__SANITIZE_ADDRESS__)
  EXPECT_LT(used.ru_maxrss / 1024, 1024);  // MB; the sanitizers keep what was given back
#endif
}

}  // namespace
}  // namespace tenku
