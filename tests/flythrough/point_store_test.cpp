#include "flythrough/point_store.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/error.h"
#include "core/random.h"
#include "flythrough/point_codec.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;

class PointStoreFile : public testing::Test {
 protected:
  PointStoreFile()
      : file_(fs::temp_directory_path() /
              ("tenku-store-" + std::to_string(getpid()) + "-" +
               testing::UnitTest::GetInstance()->current_test_info()->name() + ".tkpts")) {}
  ~PointStoreFile() override { fs::remove(file_); }

  std::string bytes() const {
    std::ifstream in(file_, std::ios::binary);
    std::ostringstream all;
    all << in.rdbuf();
    return all.str();
  }
  void write(const std::string& bytes) const {
    std::ofstream(file_, std::ios::binary | std::ios::trunc) << bytes;
  }

  fs::path file_;
};

StoreHeader header() {
  StoreHeader h;
  h.scene = "town.city.json", h.scene_sha256 = std::string(64, 'a'), h.software = "tenku test";
  h.crs = "EPSG:7415", h.file_origin = {84999.5, 447000.25, 1.5};
  h.materials = {{"wall", {0.5, 0.4, 0.3}, {}}, {"lamp", {}, {100, 90, 80}}};
  h.settings = {{"tolerance_pct", "2"}, {"seed", "1"}};
  h.path = {320,
            200,
            25.0,
            {{0.0, {0, 0, 2}, {0, 9, 2}, Angle::degrees(60)},
             {0.04, {0, 0.1, 2}, {0, 9, 2}, Angle::degrees(60)}}};
  return h;
}

StoreLighting lighting() {
  StoreLighting l;
  l.time = "2026-06-21T09:00+09:00", l.sky = "CIE 12", l.sun_direction = {0, 0.6, 0.8};
  l.sun_normal_lux = 80000, l.horizontal_lux = 90000, l.white_cd_m2 = 12000;
  l.below_horizon = {1, 2, 3};
  l.sky_map = {4, 3, std::vector<Rgb>(12, Rgb{4000, 5000, 6000})};
  return l;
}

/// Points on a sloping plane, some of them finer.
StoredPoints points_of(std::uint64_t seed, std::size_t count) {
  SampleRandom random(seed, 0, 0);
  StoredPoints points;
  for (std::size_t i = 0; i < count; ++i) {
    points.position.push_back(
        {40 * random.uniform() - 7, 60 * random.uniform(), 9 * random.uniform()});
    const double z = 2 * random.uniform() - 1, a = 2 * kPi * random.uniform();
    points.normal.push_back(
        {std::sqrt(1 - z * z) * std::cos(a), std::sqrt(1 - z * z) * std::sin(a), z});
    points.footprint_m.push_back(static_cast<float>(0.02 + 0.2 * random.uniform()));
    points.object.push_back(static_cast<std::uint32_t>(1e6 * random.uniform()));
    points.material.push_back(static_cast<std::uint16_t>(2 * random.uniform()));
    points.is_edge.push_back(random.uniform() < 0.3 ? 1 : 0);
    points.borders.emplace_back();
    if (i % 4 == 0) points.borders.back().set(1, 6 * random.uniform() - 3, 1.5 * random.uniform());
  }
  return points;
}

PointLight light_of(std::uint64_t seed, std::size_t count) {
  SampleRandom random(seed, 1, 0);
  PointLight light(count);
  for (std::size_t i = 0; i < count; ++i) {
    light.sun_lux[i] = i % 3 == 0 ? 0.0F : static_cast<float>(1e5 * random.uniform());
    light.sky_lux[i] = static_cast<float>(2e4 * random.uniform());
    light.reflected_lux[i] = {3000 * random.uniform(), 3000 * random.uniform(), 0.0};
    light.sky_view[i] = static_cast<float>(random.uniform());
  }
  return light;
}

void fill(PointStoreWriter& store) {
  const std::size_t sun = store.add_lighting(lighting());
  for (std::uint64_t c = 0; c < 3; ++c) {
    const std::size_t chunk = store.add_points(points_of(c, 200 + c));
    store.add_light(chunk, sun, light_of(c, 200 + c));
    if (c > 0) store.end_frames(c);
  }
}

void expect_near(double value, double truth) {
  EXPECT_NEAR(value, truth, truth * 0.00034 + 1e-6);  // half a step of 2^(1/1024)
}

TEST_F(PointStoreFile, GivesBackWhatItWasGivenWithinItsBounds) {
  {
    PointStoreWriter store(file_, header());
    fill(store);
  }
  const PointStore store(file_);
  ASSERT_EQ(store.chunks().size(), 3U);
  EXPECT_EQ(store.point_count(), 603U);
  EXPECT_EQ(store.frames_done(), 2U);
  EXPECT_TRUE(store.is_complete());
  EXPECT_EQ(store.torn_bytes(), 0U);
  for (std::size_t c = 0; c < 3; ++c) {
    const StoredPoints want = points_of(c, 200 + c), got = store.points(c);
    const PointLight light = light_of(c, 200 + c), read = store.light(c, 0);
    ASSERT_EQ(got.size(), want.size());
    const double bound = store.chunks()[c].finest_m / 64.0 * 1.001;
    EXPECT_GE(store.chunks()[c].finest_m, 0.02F);
    for (std::size_t i = 0; i < got.size(); ++i) {
      const Vec3 off = got.position[i] - want.position[i];
      EXPECT_LE(std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}), bound);
      EXPECT_LT(angle_between(got.normal[i], want.normal[i]).in_radians(), 1e-4);
      expect_near(got.footprint_m[i], want.footprint_m[i]);
      EXPECT_EQ(got.object[i], want.object[i]);
      EXPECT_EQ(got.material[i], want.material[i]);
      EXPECT_EQ(got.is_edge[i], want.is_edge[i]);
      EXPECT_EQ(got.borders[i], want.borders[i]);
      expect_near(read.sun_lux[i], light.sun_lux[i]);
      expect_near(read.sky_lux[i], light.sky_lux[i]);
      expect_near(read.reflected_lux[i].r, light.reflected_lux[i].r);
      expect_near(read.reflected_lux[i].g, light.reflected_lux[i].g);
      EXPECT_EQ(read.reflected_lux[i].b, 0.0);
      EXPECT_NEAR(read.sky_view[i], light.sky_view[i], 1.0 / 510.0 + 1e-6);
    }
  }
}

TEST_F(PointStoreFile, CarriesPathSettingsAndLighting) {
  {
    PointStoreWriter store(file_, header());
    fill(store);
  }
  const PointStore store(file_);
  const StoreHeader& h = store.header();
  EXPECT_EQ(h.crs, "EPSG:7415");
  EXPECT_EQ(h.setting("seed"), "1");
  EXPECT_EQ(h.setting("none"), "");
  EXPECT_EQ(h.file_origin, (Vec3{84999.5, 447000.25, 1.5}));
  EXPECT_EQ(h.materials[0].reflectance, (Rgb{0.5, 0.4, 0.3}));
  EXPECT_EQ(h.path.size(), 2U);
  EXPECT_EQ(h.path.frames[1].eye, (Vec3{0, 0.1, 2}));
  EXPECT_NEAR(h.path.frames[1].horizontal_fov.in_degrees(), 60.0, 1e-12);
  const StoreLighting& l = store.lightings().at(0);
  EXPECT_EQ(l.time, "2026-06-21T09:00+09:00");
  EXPECT_EQ(l.white_cd_m2, 12000);
  const Rgb sky = l.sky_map.colour(normalized({1, 1, 1}), l.below_horizon);
  expect_near(sky.r, 4000), expect_near(sky.b, 6000);
  EXPECT_EQ(l.sky_map.colour({0, 0.6, -0.8}, l.below_horizon), (Rgb{1, 2, 3}));
}

TEST_F(PointStoreFile, CutOffAnywhereLosesTheLastRecordOnlyAndGoesOnToTheSameBits) {
  {
    PointStoreWriter store(file_, header());
    fill(store);
  }
  const std::string whole = bytes();
  for (std::size_t cut = 1; cut < whole.size(); cut += 97) {
    write(whole.substr(0, cut));
    try {
      const PointStore store(file_);
      EXPECT_EQ(store.bytes() + store.torn_bytes(), cut);
      for (std::size_t c = 0; c < store.chunks().size(); ++c) store.points(c);
    } catch (const InputError&) {
      EXPECT_LT(cut, 1000U);  // within the header
    }
  }
  write(whole.substr(0, whole.size() - 30));  // the last chunk's light is torn
  {
    PointStoreWriter store(file_);
    store.add_light(2, 0, light_of(2, 202));
    store.end_frames(2);
  }
  EXPECT_EQ(bytes(), whole);
}

TEST_F(PointStoreFile, DamageBeforeItsEndIsRefused) {
  {
    PointStoreWriter store(file_, header());
    fill(store);
  }
  std::string damaged = bytes();
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 1);
  write(damaged);
  EXPECT_THROW(PointStore{file_}, InputError);
  write("something else entirely, of no kind that is known");
  EXPECT_THROW(PointStore{file_}, InputError);
}

TEST_F(PointStoreFile, AnotherVersionIsRefusedByItsNumber) {
  const std::string payload = deflated(R"({"version":7})");
  std::uint32_t head[5]{0, 0, 0, static_cast<std::uint32_t>(payload.size()), 0};
  std::memcpy(head, "HEAD", 4);
  uLong sum = crc32(0, reinterpret_cast<const Bytef*>(head), 16);
  sum =
      crc32(sum, reinterpret_cast<const Bytef*>(payload.data()), static_cast<uInt>(payload.size()));
  head[4] = static_cast<std::uint32_t>(sum);
  write(std::string("TKPTS\r\n\x1a", 8) + std::string(reinterpret_cast<char*>(head), 20) + payload);
  try {
    PointStore{file_};
    FAIL() << "it was read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("version 7"), std::string::npos) << error.what();
  }
}

TEST_F(PointStoreFile, AFullDiskIsToldAsSuch) {
  EXPECT_THROW(PointStoreWriter("/dev/full", header()), ResourceError);
}

// 2^(k / 1024 - 20): the closed form of the code.
TEST(LogCode, StepsAreEvenInTheLogarithm) {
  EXPECT_EQ(log_code(0.0), 0);
  EXPECT_EQ(log_code(1.0), 1 + 20 * 1024);
  EXPECT_EQ(log_code(1024.0), 1 + 30 * 1024);
  EXPECT_DOUBLE_EQ(value_of_log_code(1 + 20 * 1024), 1.0);
  for (double v = 1e-5; v < 1e6; v *= 1.37) {
    EXPECT_NEAR(value_of_log_code(log_code(v)) / v, 1.0, 0.00034);
  }
}

}  // namespace
}  // namespace tenku
