#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "core/error.h"
#include "core/random.h"
#include "output/field_writer.h"
#include "output/image_writer.h"
#include "output/manifest.h"
#include "output/sha256.h"
#include "pictures/picture_codec.h"
#include "tests/output/test_folder.h"
#include "tests/support/picture_channel.h"

namespace tenku {
namespace {

Image noise(int width, int height, double brightest) {
  Image image(width, height);
  SampleRandom random(7, 1, 2);
  for (Rgb& c : image.pixels) {
    c = {brightest * random.uniform(), brightest * random.uniform(), brightest * random.uniform()};
  }
  return image;
}

using testing_support::channel;

bool has_text(const StoredPicture& picture, const std::string& text) {
  return std::any_of(
      picture.header.texts.begin(), picture.header.texts.end(),
      [&](const auto& entry) { return entry.second.find(text) != std::string::npos; });
}

TEST(ImageWriter, PngHoldsTheCodesAndItsTopRowFirst) {
  const TestFolder folder("png");
  Image8 image(3, 2, {10, 20, 30});
  image.at(2, 0) = {255, 0, 128};
  write_png(folder / "a.png", image, {"a view", "2026-06-21T00:00:00Z", "sRGB"});
  const StoredPicture back = picture_codec().read(folder / "a.png");
  ASSERT_EQ(back.header.width, 3);
  ASSERT_EQ(back.header.height, 2);
  EXPECT_NEAR(channel(back, "R")[2] * 255.0, 255.0, 1e-3);
  EXPECT_NEAR(channel(back, "B")[2] * 255.0, 128.0, 1e-3);
  EXPECT_NEAR(channel(back, "G")[5] * 255.0, 20.0, 1e-3);
  EXPECT_TRUE(has_text(back, "tenku "));
  EXPECT_TRUE(has_text(back, "a view"));
  EXPECT_EQ(folder.count(), 1U) << "nothing is left aside";
}

TEST(ImageWriter, ExrFloatReadsBackBitForBit) {
  const TestFolder folder("exr");
  const Image image = noise(17, 9, 1e5);
  PictureLayer layer{"illuminance.lx", std::vector<double>(image.pixels.size(), 12.5)};
  layer.values[3] = std::nan("");
  write_exr(folder / "a.exr", image, {"t", "2026-06-21T00:00:00Z", "cd/m2"}, ExrDepth::Float,
            {layer});
  const StoredPicture back = picture_codec().read(folder / "a.exr");
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    EXPECT_EQ(channel(back, "R")[i], static_cast<float>(image.pixels[i].r));
    EXPECT_EQ(channel(back, "B")[i], static_cast<float>(image.pixels[i].b));
  }
  EXPECT_EQ(channel(back, "illuminance.lx")[0], 12.5);
  EXPECT_TRUE(std::isnan(channel(back, "illuminance.lx")[3]));
  EXPECT_TRUE(has_text(back, "cd/m2"));
}

TEST(ImageWriter, ExrHalfKeepsElevenBits) {
  const TestFolder folder("half");
  Image image(2, 1);
  image.at(0, 0) = {2049.0, 1023.5, 0.5};  // 2049 lies half-way between 2048 and 2050
  write_exr(folder / "a.exr", image, {}, ExrDepth::Half);
  const StoredPicture back = picture_codec().read(folder / "a.exr");
  EXPECT_EQ(channel(back, "R")[0], 2048.0);
  EXPECT_EQ(channel(back, "G")[0], 1023.5);
  EXPECT_EQ(channel(back, "B")[0], 0.5);
}

TEST(ImageWriter, RadiancePictureKeepsEightBitsOfTheLargestChannel) {
  const TestFolder folder("hdr");
  for (const int width : {5, 8, 300}) {
    Image image = noise(width, 7, 30000.0);
    for (int x = 0; x < width; ++x) image.at(x, 3) = Rgb::grey(128.0);  // one long run
    image.at(0, 0) = {};
    write_hdr(folder / "a.hdr", image);
    const StoredPicture back = picture_codec().read(folder / "a.hdr");
    ASSERT_EQ(back.header.width, width);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      const Rgb c = image.pixels[i];
      const double step = std::max({c.r, c.g, c.b}) / 128.0;
      EXPECT_NEAR(channel(back, "R")[i], c.r, step);
      EXPECT_NEAR(channel(back, "G")[i], c.g, step);
      EXPECT_NEAR(channel(back, "B")[i], c.b, step);
    }
  }
}

TEST(ImageWriter, RadianceHeaderTellsTheExposure) {
  const TestFolder folder("hdr_header");
  write_hdr(folder / "a.hdr", Image(9, 2, Rgb::grey(1.0)), {"two\nlines", "", "cd/m2"});
  std::ifstream file(folder / "a.hdr", std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_TRUE(text.starts_with("#?RADIANCE\n"));
  EXPECT_NE(text.find("\nEXPOSURE=179\n"), std::string::npos);
  EXPECT_NE(text.find("\nTITLE= two lines\n"), std::string::npos);
  EXPECT_NE(text.find("\n\n-Y 2 +X 9\n"), std::string::npos);
}

TEST(ImageWriter, RefusesWhatCannotBeWritten) {
  const TestFolder folder("refuse");
  const Image image(4, 4);
  EXPECT_THROW(write_png(folder / "no" / "a.png", Image8(1, 1)), InputError);
  EXPECT_THROW(write_exr(folder / "no" / "a.exr", image), InputError);
  EXPECT_THROW(write_hdr(folder / "a.hdr", Image(1, 1, Rgb::grey(-1.0))), InputError);
  EXPECT_THROW(write_luminance_image(folder / "a.jpg", image), InputError);
  EXPECT_THROW(write_exr(folder / "a.exr", image, {}, ExrDepth::Float, {{"x", {1.0}}}), InputError);
  EXPECT_THROW(picture_codec().read(folder / "none.exr"), InputError);
  EXPECT_EQ(folder.count(), 0U);
}

// What the plug-in throws is caught as what it is here.
TEST(PictureCodec, RefusesAcrossTheBoundary) {
  PictureHeader header{2, 1, {"a", "b", "c", "d", "e"}, true, {}};  // PNG has four at most
  EXPECT_THROW(picture_codec().png_bytes(header, std::vector<std::uint8_t>(10)), ResourceError);
  EXPECT_THROW(picture_codec().read_header("/no/such/picture.png"), InputError);
}

// Run by itself, as CTest does, this is the first use.
TEST(PictureCodec, ManyThreadsMayBeTheFirst) {
  std::vector<std::string> bytes(8);
  std::vector<std::thread> threads;
  for (std::string& one : bytes) threads.emplace_back([&] { one = png_bytes(Image8(3, 2)); });
  for (std::thread& thread : threads) thread.join();
  for (const std::string& one : bytes) {
    EXPECT_EQ(one.substr(0, 8), "\x89PNG\r\n\x1a\n");  // PNG specification, 5.2
    EXPECT_EQ(one, bytes.front());
  }
}

FieldMesh small_mesh() {
  FieldMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}, {0, 1, 0.25}, {2, 0, 0}};
  mesh.add_polygon(std::vector<std::uint32_t>{0, 1, 2, 3});
  mesh.add_polygon(std::vector<std::uint32_t>{1, 4, 2});
  mesh.point_values = {{"sun_lux", {0, 1.5, 1e5, 3, 4}}, {"sky_lux", {5, 6, 7, 8, 9}}};
  mesh.cell_values = {{"area_m2", {1.125, 0.5}}};
  mesh.cell_codes = {{"object_id", {0, 1}}, {"surface_type", {3, 2}}};
  mesh.texts = {{"crs", {"EPSG:6697"}}, {"object_id", {"<b>&\"", "建物-1"}}};
  return mesh;
}

TEST(FieldWriter, ReadsBackWhatItWrote) {
  const TestFolder folder("vtp");
  const FieldMesh mesh = small_mesh();
  write_vtp(folder / "a.vtp", mesh);
  const FieldMesh back = read_vtp(folder / "a.vtp");
  EXPECT_EQ(back.points, mesh.points);
  EXPECT_EQ(back.polygon_corners, mesh.polygon_corners);
  EXPECT_EQ(back.polygon_ends, mesh.polygon_ends);
  ASSERT_EQ(back.point_values.size(), 2U);
  EXPECT_EQ(back.point_values[0].name, "sun_lux");
  EXPECT_EQ(back.point_values[0].values, mesh.point_values[0].values);
  EXPECT_EQ(back.cell_values.at(0).values, mesh.cell_values[0].values);
  EXPECT_EQ(back.cell_codes.at(1).name, "surface_type");
  EXPECT_EQ(back.cell_codes.at(1).codes, mesh.cell_codes[1].codes);
  ASSERT_EQ(back.texts.size(), 3U);
  EXPECT_EQ(back.texts[0].values, mesh.texts[0].values);
  EXPECT_EQ(back.texts[1].values, mesh.texts[1].values);
  EXPECT_EQ(back.texts[2].name, "software");
  EXPECT_EQ(folder.count(), 1U);
}

TEST(FieldWriter, APointCloudHasItsPointsAsCells) {
  const TestFolder folder("cloud");
  FieldMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 2, 3}};
  mesh.cell_codes = {{"kind", {4, 5}}};
  write_vtp(folder / "a.vtp", mesh);
  EXPECT_EQ(read_vtp(folder / "a.vtp").cell_codes.at(0).codes, (std::vector<std::int32_t>{4, 5}));
}

TEST(FieldWriter, RefusesAMeshThatDoesNotFit) {
  const TestFolder folder("vtp_bad");
  FieldMesh short_array = small_mesh(), bad_corner = small_mesh(), bad_point = small_mesh();
  short_array.point_values[0].values.pop_back();
  bad_corner.polygon_corners[0] = 99;
  bad_point.points[0].x = std::nan("");
  EXPECT_THROW(write_vtp(folder / "a.vtp", short_array), InputError);
  EXPECT_THROW(write_vtp(folder / "a.vtp", bad_corner), InputError);
  EXPECT_THROW(write_vtp(folder / "a.vtp", bad_point), InputError);
  EXPECT_THROW(write_vtp(folder / "no" / "a.vtp", small_mesh()), InputError);
  EXPECT_THROW(read_vtp(folder / "none.vtp"), InputError);
  EXPECT_EQ(folder.count(), 0U);
}

// Example messages of FIPS 180-4 (NIST, "SHA256.pdf"), and the empty message.
TEST(Sha256, MeetsThePublishedExamples) {
  EXPECT_EQ(sha256_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256_of(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

// By `sha256sum a.txt deep/b.txt | sha256sum`, both files being the letters abc.
TEST(Sha256, OfAFolderIsThatOfTheListOfItsFiles) {
  const TestFolder folder("sha256_folder");
  std::filesystem::create_directory(folder / "deep");
  for (const char* name : {"deep/b.txt", "a.txt"}) std::ofstream(folder / name) << "abc";
  EXPECT_EQ(sha256_of_input(folder / ""),
            "d5e8cb0f59dfde2ae65bfc6e7817f0d6afd23faa229845adac37368a1b0f91c2");
  EXPECT_EQ(sha256_of_input(folder / "a.txt"), sha256_of("abc"));
}

TEST(Sha256, OfAFileIsThatOfItsBytes) {
  const TestFolder folder("sha");
  const std::string bytes(3U << 20U, 'x');
  std::ofstream(folder / "a") << bytes;
  std::ofstream(folder / "empty");
  EXPECT_EQ(sha256_of_file(folder / "a"), sha256_of(bytes));
  EXPECT_EQ(sha256_of_file(folder / "empty"), sha256_of(""));
  EXPECT_THROW(sha256_of_file(folder / "none"), InputError);
  EXPECT_THROW(sha256_of_file(folder / "."), InputError);
}

TEST(Manifest, KeepsItsOrderAndItsNumbers) {
  Manifest manifest;
  manifest.command = "run study.toml";
  manifest.inputs = {{"town.city.json", sha256_of("abc"), 3}};
  manifest.settings = {{"tolerance_pct", 2.0},
                       {"bounces", std::int64_t{5}},
                       {"sun", true},
                       {"size", std::vector<double>{512, 512}},
                       {"sky", std::string("cie:12")}};
  manifest.diagnostics = {{"zero_area_face", Severity::Warning, "b\xff\"", "", "no area", "", 4}};
  manifest.seed = 18446744073709551615U;
  manifest.machine = this_machine();
  const std::string text = manifest_json(manifest);
  EXPECT_EQ(text, manifest_json(manifest));
  const auto json = nlohmann::ordered_json::parse(text);
  EXPECT_EQ(json.begin().key(), "software");
  EXPECT_EQ(json["settings"].begin().key(), "tolerance_pct");
  EXPECT_EQ(json["settings"]["bounces"], 5);
  EXPECT_EQ(json["settings"]["size"][1], 512.0);
  EXPECT_EQ(json["seed"], 18446744073709551615U);
  EXPECT_EQ(json["inputs"][0]["bytes"], 3);
  EXPECT_EQ(json["diagnostics"][0]["severity"], "warning");
  EXPECT_GT(json["machine"]["cores"], 0);
}

}  // namespace
}  // namespace tenku
