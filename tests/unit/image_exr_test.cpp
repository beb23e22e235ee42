// EXR and PNG files: what is written comes back.
#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <png.h>

#include <cmath>
#include <limits>

#include "gtest/gtest.h"
#include "host/error.h"
#include "host/image/exr.h"
#include "host/image/png.h"
#include "tests/unit/image_temporary_folder.h"

namespace meniscal {
namespace {

using test::read_bytes;
using test::TemporaryFolder;
using test::write_bytes;

// A crop of 3 x 2 pixels at 4,5 of 20 x 10, every number different.
Image sample() {
  Image image;
  image.width = 3, image.height = 2, image.x0 = 4, image.y0 = 5, image.full_width = 20, image.full_height = 10;
  image.layers = {{"", {"R", "G", "B"}, {}},
                  {"targeted", {"R", "G", "B"}, {}},
                  {"depth", {"Z"}, {}},
                  {"normal", {"X", "Y", "Z"}, {}}};
  float next = 0.1f;
  for (Layer& layer : image.layers)
    for (std::size_t i = 0; i < image.pixel_count() * layer.channels.size(); ++i)
      layer.pixels.push_back(next *= -1.37f);
  image.text = {{"software", "meniscal test"}, {"model", "paper"}, {"aNameOfMoreThanThirtyOneCharacters", "long"}};
  image.numbers = {{"seed", 4294967295.0}, {"radius", 1.25e-4}};
  image.matrices = {{"worldToCamera", {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16}}};
  return image;
}

TEST(Exr, ReturnsLayersWindowsAndAttributes) {
  const TemporaryFolder folder;
  const Image written = sample();
  write_exr(folder / "a.exr", written);
  const Image read = read_exr(folder / "a.exr");
  EXPECT_EQ(std::tie(read.width, read.height, read.x0, read.y0), std::make_tuple(3, 2, 4, 5));
  EXPECT_EQ(std::tie(read.full_width, read.full_height), std::make_tuple(20, 10));
  ASSERT_EQ(read.layers.size(), written.layers.size());
  EXPECT_EQ(read.layers[0].name, "");
  for (const Layer& layer : written.layers) {
    const Layer* found = read.find(layer.name);
    ASSERT_TRUE(found) << layer.name;
    EXPECT_EQ(found->channels, layer.channels) << layer.name;
    EXPECT_EQ(found->pixels, layer.pixels) << layer.name;
  }
  EXPECT_EQ(read.text, written.text);
  EXPECT_EQ(read.numbers, written.numbers);
  EXPECT_EQ(read.matrices, written.matrices);
}

TEST(Exr, KeepsValuesThatAreNotFinite) {
  const TemporaryFolder folder;
  Image image;
  image.width = 3, image.height = 1;
  image.layers = {
      {"", {"Y"}, {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity(), 1e-42f}}};
  write_exr(folder / "a.exr", image);
  const std::vector<float> read = read_exr(folder / "a.exr").layers[0].pixels;
  EXPECT_TRUE(std::isnan(read[0]));
  EXPECT_EQ(read[1], -std::numeric_limits<float>::infinity());
  EXPECT_EQ(read[2], 1e-42f);
}

TEST(Exr, SameImageGivesSameBytes) {
  const TemporaryFolder folder;
  write_exr(folder / "a.exr", sample());
  write_exr(folder / "b.exr", sample());
  EXPECT_EQ(read_bytes(folder / "a.exr"), read_bytes(folder / "b.exr"));
  EXPECT_EQ(folder.files(), 2u);
}

// OpenEXR's own simple interface sees the same picture at the same place, top row first.
TEST(Exr, IsUnderstoodByOthers) {
  const TemporaryFolder folder;
  const Image image = sample();
  write_exr(folder / "a.exr", image);
  Imf::RgbaInputFile file((folder / "a.exr").c_str());
  EXPECT_EQ(file.dataWindow(), Imath::Box2i({4, 5}, {6, 6}));
  EXPECT_EQ(file.displayWindow(), Imath::Box2i({0, 0}, {19, 9}));
  Imf::Array2D<Imf::Rgba> pixels(2, 3);
  file.setFrameBuffer(&pixels[0][0] - 4 - 5 * 3, 1, 3);
  file.readPixels(5, 6);
  const std::vector<float>& beauty = image.layers[0].pixels;
  EXPECT_EQ(static_cast<float>(pixels[0][2].g), static_cast<float>(Imath::half(beauty[7])));
  EXPECT_EQ(static_cast<float>(pixels[1][0].b), static_cast<float>(Imath::half(beauty[11])));
}

TEST(Exr, ReadsHalfPixelsOfOtherWriters) {
  const TemporaryFolder folder;
  const std::vector<Imf::Rgba> pixels{{0.5f, 1, 2, 1}, {4, 8, 16, 0}};
  {
    Imf::RgbaOutputFile file((folder / "half.exr").c_str(), Imath::Box2i({-1, -1}, {5, 5}),
                             Imath::Box2i({2, 3}, {3, 3}), Imf::WRITE_RGBA);
    file.setFrameBuffer(pixels.data() - 2 - 3 * 2, 1, 2);
    file.writePixels(1);
  }
  const Image read = read_exr(folder / "half.exr");
  EXPECT_EQ(std::tie(read.width, read.height, read.x0, read.y0, read.full_width, read.full_height),
            std::make_tuple(2, 1, 3, 4, 7, 7));
  ASSERT_EQ(read.layers.size(), 1u);
  EXPECT_EQ(read.layers[0].channels, (std::vector<std::string>{"R", "G", "B", "A"}));
  EXPECT_EQ(read.layers[0].pixels, (std::vector<float>{0.5f, 1, 2, 1, 4, 8, 16, 0}));
}

TEST(Exr, ThatIsNotOneIsRefusedByName) {
  const TemporaryFolder folder;
  write_exr(folder / "whole.exr", sample());
  const std::string whole = read_bytes(folder / "whole.exr");
  write_bytes(folder / "cut.exr", whole.substr(0, whole.size() - 40));
  write_bytes(folder / "text.exr", "not an image");
  write_bytes(folder / "empty.exr", "");
  for (const std::string name : {"missing.exr", "cut.exr", "text.exr", "empty.exr"}) {
    try {
      read_exr(folder / name);
      ADD_FAILURE() << name << " was read";
    } catch (const Error& error) {
      EXPECT_EQ(error.code, ExitCode::scene) << name;
      EXPECT_NE(std::string(error.what()).find(folder / name), std::string::npos) << error.what();
    }
  }
}

TEST(Exr, ThatContradictsItselfIsNotWritten) {
  const TemporaryFolder folder;
  Image image = sample();
  image.layers[2].pixels.pop_back();
  EXPECT_THROW(write_exr(folder / "a.exr", image), Error);
  EXPECT_EQ(folder.files(), 0u);
}

TEST(Exr, ThatTheFormatForbidsIsRefusedByName) {
  const TemporaryFolder folder;
  Image image = sample();
  image.text["dataWindow"] = "taken";
  try {
    write_exr(folder / "a.exr", image);
    ADD_FAILURE() << "written";
  } catch (const Error& error) {
    EXPECT_EQ(error.code, ExitCode::failed);
    EXPECT_NE(std::string(error.what()).find(folder / "a.exr"), std::string::npos) << error.what();
  }
  EXPECT_EQ(folder.files(), 0u);
}

TEST(Png, ReturnsItsBytes) {
  const TemporaryFolder folder;
  const std::vector<std::uint8_t> rgb{255, 0, 1, 2, 3, 4, 128, 64, 32, 9, 8, 7, 6, 5, 254, 100, 101, 102};
  write_png(folder / "a.png", 3, 2, rgb);
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_file(&header, (folder / "a.png").c_str())) << header.message;
  EXPECT_EQ(std::make_tuple(header.width, header.height), std::make_tuple(3u, 2u));
  header.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> read(PNG_IMAGE_SIZE(header));
  ASSERT_TRUE(png_image_finish_read(&header, nullptr, read.data(), 0, nullptr)) << header.message;
  EXPECT_EQ(read, rgb);
  EXPECT_NE(read_bytes(folder / "a.png").find("sRGB"), std::string::npos);
}

TEST(Png, PreviewIsTheToneMappedBeauty) {
  const TemporaryFolder folder;
  const Image image = sample();
  write_preview(folder / "preview.png", image, ToneMap::aces, 1.0);
  write_png(folder / "expected.png", 3, 2, tone_map(image.layers[0].pixels, ToneMap::aces, 1.0));
  EXPECT_EQ(read_bytes(folder / "preview.png"), read_bytes(folder / "expected.png"));
}

TEST(Png, OfTheWrongSizeIsRefused) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_png(folder / "a.png", 2, 2, std::vector<std::uint8_t>(11)), Error);
  EXPECT_EQ(folder.files(), 0u);
}

}  // namespace
}  // namespace meniscal
