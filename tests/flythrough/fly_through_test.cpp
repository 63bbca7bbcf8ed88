#include "flythrough/fly_through.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"
#include "flythrough/path_checks.h"
#include "flythrough/played_frame.h"
#include "flythrough/relight.h"
#include "flythrough/store_lighting.h"
#include "support/test_scene.h"
#include "view/picture_difference.h"
#include "view/tone_map.h"
#include "view/view_render.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;
using namespace testing_support;

/// Four houses on a lawn, under a clear sky.
class Street {
 public:
  explicit Street(double sun_altitude_deg = 40.0) {
    scene_.materials = {grey_material(0.3), grey_material(0.6)};
    scene_.level({-200, -200, 200, 200}, 0.0);
    scene_.box({4, 5, 0}, {8, 10, 9}, 0.0, 1);
    scene_.box({-13, 4, 0}, {9, 12, 6}, 8.0, 1);
    scene_.box({3, 22, 0}, {10, 8, 14}, -5.0, 1);
    scene_.box({-12, 24, 0}, {8, 8, 11}, 0.0, 1);
    engines_ = std::make_unique<Engines>(scene_.soup, scene_.materials);
    SkyRequest request;
    request.model = "cie:12";
    request.sun = SunInSky{direction_from(Angle::degrees(150.0), Angle::degrees(sun_altitude_deg)),
                           Angle::degrees(0.533 / 2), std::nullopt};
    sky_ = make_sky(request);
    source_ = daylight_of(sky_);
  }

  FlyThroughRequest request(const fs::path& file, const CameraPath& path) const {
    FlyThroughRequest request;
    request.file = file;
    request.header.scene = "street", request.header.scene_sha256 = std::string(64, '0');
    for (const Material& m : scene_.materials) {
      request.header.materials.push_back({m.name, m.reflectance, m.emission_lm_m2});
    }
    request.header.path = path;
    request.header.settings = {{"tolerance_pct", "2"}};
    request.lighting = lighting_of(sky_, source_, "");
    request.light = {2.0, 0, 1};
    request.method.engine = EngineChoice::Rays;
    return request;
  }
  FlyThroughResult fly(const FlyThroughRequest& request) const {
    Progress quiet;
    return fly_through(request, *engines_, source_, quiet);
  }

  const Engines& engines() const { return *engines_; }
  const DaylightSource& source() const { return source_; }
  const Sky& sky() const { return sky_; }

 private:
  TestScene scene_;
  std::unique_ptr<Engines> engines_;
  Sky sky_;
  DaylightSource source_;
};

CameraPath walk(std::size_t frames, int width, int height) {
  CameraPathRequest request;
  const double seconds = static_cast<double>(frames) / 10.0;
  request.keys = {{0.0, {0, -12, 1.7}, {0, 20, 4}}, {seconds, {-0.5, 2, 1.7}, {1, 30, 4}}};
  request.frames_per_s = 10.0;
  request.width = width, request.height = height;
  return make_camera_path(request);
}

class FlyThroughFile : public testing::Test {
 protected:
  FlyThroughFile()
      : folder_(fs::path(testing::TempDir()) /
                testing::UnitTest::GetInstance()->current_test_info()->name()) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~FlyThroughFile() override { fs::remove_all(folder_); }

  fs::path file(const std::string& name = "film.tkpts") const { return folder_ / name; }

 private:
  fs::path folder_;
};

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST_F(FlyThroughFile, PlayedFramesAreThoseRenderedDirectly) {
  const Street street;
  const auto request = street.request(file(), walk(8, 160, 120));
  street.fly(request);
  const PointStore store(file());
  ASSERT_TRUE(store.is_complete());
  EXPECT_LE(static_cast<double>(store.bytes()), 24.0 * static_cast<double>(store.point_count()));
  for (const std::size_t frame : {0U, 4U, 7U}) {
    ViewRequest view;
    view.view = store.header().path.view(frame);
    view.bounces = 0;
    Progress quiet;
    const Image direct =
        render_view(view, street.engines(), street.source(), street.sky().model.get(), quiet)
            .luminance;
    ToneMapOptions tone;
    tone.ev100 = std::log2(1.0 / (1.2 * exposure_of(direct, {})));
    const Image8 a = tone_map(direct, tone),
                 b = tone_map(played_frame(store, frame).luminance, tone);
    // The figures that are asked for.
    EXPECT_LE(mean_difference(a, b), 1.0) << frame;
    EXPECT_GE(structural_similarity(a, b), 0.98) << frame;
  }
}

// The figure that is asked for: what flickers changes where the direct frames do not.
TEST_F(FlyThroughFile, FramesChangeNoMoreThanThoseRenderedDirectly) {
  const Street street;
  street.fly(street.request(file(), walk(8, 160, 120)));
  const PointStore store(file());
  std::vector<Image8> direct, played;
  ToneMapOptions tone;
  for (const std::size_t frame : {3U, 4U}) {
    ViewRequest view;
    view.view = store.header().path.view(frame);
    view.bounces = 0;
    Progress quiet;
    const Image light =
        render_view(view, street.engines(), street.source(), street.sky().model.get(), quiet)
            .luminance;
    if (direct.empty()) tone.ev100 = std::log2(1.0 / (1.2 * exposure_of(light, {})));
    direct.push_back(tone_map(light, tone));
    played.push_back(tone_map(played_frame(store, frame).luminance, tone));
  }
  EXPECT_LE(mean_difference(played[0], played[1]), mean_difference(direct[0], direct[1]) + 1.0);
}

/// Samples that see a surface and show no point.
std::size_t holes(const PointStore& store, std::size_t frame, const RayVisibility& rays) {
  const PerspectiveView view = store.header().path.view(frame);
  SplatBuffer buffer(view, {});
  std::vector<SplatChunk> chunks;
  std::vector<const SplatChunk*> shown;
  for (std::size_t c = 0; c < store.chunks().size(); ++c) {
    chunks.push_back(splat_chunk(store.points(c)));
  }
  for (const SplatChunk& chunk : chunks) shown.push_back(&chunk);
  buffer.draw(shown);
  const PerspectiveCamera camera(view);
  std::size_t count = 0;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      for (std::size_t s = 0; s < SplatBuffer::kSamples; ++s) {
        if (buffer.item()[buffer.index(x, y, s)] != SplatBuffer::kNothing) continue;
        const Vec3 ray = camera.ray(x + kRayPlaces[s][0], y + kRayPlaces[s][1]);
        count += rays.first_hit(camera.eye(), ray).has_value();
      }
    }
  }
  return count;
}

TEST_F(FlyThroughFile, NoSampleOfASurfaceShowsTheBackground) {
  const Street street;
  street.fly(street.request(file(), walk(10, 96, 72)));
  const PointStore store(file());
  for (std::size_t f = 0; f < store.header().path.size(); ++f) {
    EXPECT_EQ(holes(store, f, street.engines().rays()), 0U) << f;
  }
}

// A file that is only appended to is, at any moment, the beginning of what it will be.
TEST_F(FlyThroughFile, KilledAtTwentyMomentsAndResumedItIsTheSameBits) {
  const Street street;
  auto request = street.request(file(), walk(6, 48, 36));
  request.points_in_chunk = 300, request.points_in_batch = 900;
  street.fly(request);
  const std::string whole = bytes_of(file());
  ASSERT_GT(PointStore(file()).chunks().size(), 8U);
  const std::size_t begun = whole.find("GEOM");
  SampleRandom random(7, 0, 0);
  request.file = file("resumed.tkpts");
  request.resume = true;
  for (int k = 0; k < 20; ++k) {
    const auto cut = begun + static_cast<std::size_t>(random.uniform() *
                                                      static_cast<double>(whole.size() - begun));
    std::ofstream(part_of(request.file), std::ios::binary) << whole.substr(0, cut);
    street.fly(request);
    EXPECT_TRUE(bytes_of(request.file) == whole) << "cut at " << cut << " of " << whole.size();
    fs::remove(request.file);
  }
}

TEST_F(FlyThroughFile, ThreadsAndMemoryDoNotChangeItsBits) {
  const Street street;
  auto request = street.request(file(), walk(6, 48, 36));
  request.points_in_chunk = 300, request.points_in_batch = 900;
  request.method.detail = Detail::Off;  // a plan that does not depend on the clock
  street.fly(request);
  request.file = file("other.tkpts");
  request.points_in_memory = 1000;  // chunks are dropped and read again
  const ThreadLimit one(1);
  street.fly(request);
  EXPECT_TRUE(bytes_of(file()) == bytes_of(request.file));
}

TEST_F(FlyThroughFile, AnotherSceneOrSettingIsRefusedByName) {
  const Street street;
  auto request = street.request(file(), walk(2, 32, 24));
  street.fly(request);
  fs::rename(file(), part_of(file()));
  request.resume = true;
  const auto refusal = [&](const FlyThroughRequest& other) -> std::string {
    try {
      street.fly(other);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  auto other = request;
  other.header.scene_sha256 = std::string(64, '1');
  EXPECT_NE(refusal(other).find("another scene"), std::string::npos) << refusal(other);
  other = request;
  other.header.settings[0][1] = "5";
  EXPECT_NE(refusal(other).find("tolerance_pct"), std::string::npos) << refusal(other);
  other = request;
  other.header.path = walk(3, 32, 24);
  EXPECT_NE(refusal(other).find("path"), std::string::npos) << refusal(other);
  EXPECT_EQ(refusal(request), "");
}

TEST_F(FlyThroughFile, FramesWithNothingInThemAreToldAndStored) {
  const Street street;
  CameraPathRequest up;
  up.keys = {{0.0, {0, 0, 30}, {0, 0, 90}}};
  up.standing_s = 0.2, up.frames_per_s = 10.0, up.width = 32, up.height = 24;
  const auto result = street.fly(street.request(file(), make_camera_path(up)));
  EXPECT_EQ(result.points, 0U);
  EXPECT_TRUE(PointStore(file()).is_complete());
  const bool is_told = std::any_of(result.findings.begin(), result.findings.end(),
                                   [](const Finding& f) { return f.code == "empty_frames"; });
  EXPECT_TRUE(is_told);
}

TEST_F(FlyThroughFile, TenCentimetresFromAFacadeThereAreNoHoles) {
  const Street street;
  CameraPathRequest near;
  // The house's western face lies in x = 4.
  near.keys = {{0.0, {3.9, 8, 2}, {4.0, 8.2, 2}}, {0.5, {3.9, 9, 2}, {4.0, 9.3, 2}}};
  near.frames_per_s = 10.0, near.width = 64, near.height = 48;
  street.fly(street.request(file(), make_camera_path(near)));
  const PointStore store(file());
  for (std::size_t f = 0; f < store.header().path.size(); ++f) {
    EXPECT_EQ(holes(store, f, street.engines().rays()), 0U) << f;
  }
}

TEST_F(FlyThroughFile, TenThousandFramesStayInBoundedMemory) {
  const Street street;
  CameraPathRequest over;  // the lawn, from its one end to the other
  over.keys = {{0.0, {-150, -100, 30}, {-150, -90, 0}}, {1000.0, {150, -100, 30}, {150, -90, 0}}};
  over.frames_per_s = 10.0, over.width = 12, over.height = 8;
  auto request = street.request(file(), make_camera_path(over));
  request.points_in_memory = 500, request.frames_in_batch = 100;
  ASSERT_EQ(request.header.path.size(), 10'000U);
  rusage before{}, after{};
  getrusage(RUSAGE_SELF, &before);
  const auto result = street.fly(request);
  getrusage(RUSAGE_SELF, &after);
  EXPECT_EQ(result.frames, 10'000U);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 100'000) << "kB";
}

// A level surface in the open receives the whole sky, and the sun by the sine of its altitude.
TEST_F(FlyThroughFile, OpenGroundReceivesSunAndSkyInFull) {
  const Street street;
  CameraPathRequest down;
  down.keys = {{0.0, {-120, -120, 6}, {-120, -119, 0}}};
  down.width = 24, down.height = 18;
  street.fly(street.request(file(), make_camera_path(down)));
  const PointStore store(file());
  const double sun = street.source().sun.normal_illuminance.value() * std::sin(40.0 * kPi / 180.0);
  const double sky = street.source().unobstructed_lux() - sun;
  ASSERT_GT(store.point_count(), 300U);
  const PointLight light = store.light(0, 0);
  double mean = 0.0;
  for (std::size_t i = 0; i < light.size(); ++i) {
    EXPECT_NEAR(light.sun_lux[i], sun, 0.002 * sun);
    mean += light.sky_lux[i] / static_cast<double>(light.size());
  }
  EXPECT_NEAR(mean, sky, 0.02 * sky);  // houses of 14 m stand 120 m away
}

TEST_F(FlyThroughFile, AnotherHourIsThatOfARunOfItsOwn) {
  const Street morning(40.0), evening(20.0);
  auto request = morning.request(file(), walk(4, 96, 72));
  request.light.bounces = 2;
  morning.fly(request);
  Progress quiet;
  const StoreLighting lighting = lighting_of(evening.sky(), evening.source(), "later");
  relight(file(), request.header.scene_sha256, lighting, request.light, evening.engines(),
          evening.source(), quiet);
  const PointStore store(file());
  ASSERT_EQ(store.lightings().size(), 2U);
  EXPECT_TRUE(store.is_complete());
  double truth = 0.0, off = 0.0, sun_off = 0.0;
  for (std::size_t c = 0; c < store.chunks().size(); ++c) {
    StoredPoints points = store.points(c);
    for (std::size_t i = 0; i < points.size(); ++i) {  // rounding may have put it below
      points.position[i] = points.position[i] + 0.05 * points.footprint_m[i] * points.normal[i];
    }
    const PointLight got = store.light(c, 1);
    const PointLight want = light_points(points, std::vector<double>(points.size(), 1.0),
                                         evening.engines(), evening.source(), request.light,
                                         plan_of(store.header().setting("light")), quiet);
    for (std::size_t i = 0; i < points.size(); ++i) {
      truth += luminance_of(want.total_lux(i));
      off += std::abs(luminance_of(got.total_lux(i)) - luminance_of(want.total_lux(i)));
      sun_off += std::abs(got.sun_lux[i] - want.sun_lux[i]);
    }
  }
  EXPECT_LT(off, 0.04 * truth);  // both are lit to 2 %, and cells share what changes
  EXPECT_LT(sun_off, 0.01 * truth);
  EXPECT_THROW(relight(file(), request.header.scene_sha256, lighting, request.light,
                       evening.engines(), evening.source(), quiet),
               InputError);
  EXPECT_THROW(relight(file(), std::string(64, '1'), lighting, request.light, evening.engines(),
                       evening.source(), quiet),
               InputError);
}

TEST(PathChecks, AWallOnTheWayIsToldWithItsTimeAndObject) {
  TestScene scene;
  scene.begin_object();
  scene.wall({-5, 3, 5, 3}, 0, 4);
  const RayVisibility rays(scene.soup, scene.materials);
  Scene names;
  names.objects.resize(scene.soup.object.back() + std::size_t{1});
  names.objects[scene.soup.object.back()].id = "the wall";
  CameraPathRequest request;
  request.keys = {{0.0, {0, 0, 2}, {0, 9, 2}}, {2.0, {0, 8, 2}, {0, 19, 2}}};
  request.curve = PathCurve::Straight, request.frames_per_s = 10.0;
  const auto findings = check_path(make_camera_path(request), request.keys, names, rays);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].code, "path_through_wall");
  EXPECT_EQ(findings[0].object, "the wall");
  EXPECT_NE(findings[0].where.find("0.75 s"), std::string::npos) << findings[0].where;
  EXPECT_NE(findings[0].where.find("key 1"), std::string::npos) << findings[0].where;
  for (CameraKey& key : request.keys) key.eye.z = 6.0;
  EXPECT_TRUE(check_path(make_camera_path(request), request.keys, names, rays).empty());
}

}  // namespace
}  // namespace tenku
