// Textures and EXR images that are damaged, or claim what they do not hold.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>

#include <stb_image_write.h>

#include "host/image/exr.h"
#include "tests/unit/hostile.h"
#include "tests/unit/scene_fixture.h"

namespace meniscal::test {
namespace {

using testing::bytes_of;

std::string corpus(const std::string& name) { return read_bytes(FUZZ_CORPUS "/image/" + name); }

std::string scene_with(const std::string& image, const std::string& kind) {
  testing::Document document = testing::triangle();
  document.json["images"] = {{{"uri", "data:image/" + kind + ";base64," + testing::base64(image)}}};
  document.json["textures"] = {{{"source", 0}}};
  document.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
  return document.text();
}

std::string big_endian(std::uint32_t value, int bytes) {
  std::string result;
  while (bytes-- > 0) result += static_cast<char>(value >> 8 * bytes);
  return result;
}

void append_to(void* string, void* bytes, int size) {
  static_cast<std::string*>(string)->append(static_cast<const char*>(bytes), static_cast<std::size_t>(size));
}

std::string noisy_jpeg() {
  std::vector<unsigned char> noise(64 * 64 * 3);
  unsigned state = 1;
  for (unsigned char& v : noise) v = static_cast<unsigned char>((state = state * 1664525u + 1013904223u) >> 24);
  std::string jpeg;
  stbi_write_jpg_to_func(append_to, &jpeg, 64, 64, 3, noise.data(), 90);
  return jpeg;
}

template <typename T>
std::string value(T number) {
  return bytes_of(std::vector<T>{number});
}

std::string attribute(const std::string& name, const std::string& type, const std::string& bytes) {
  return name + '\0' + type + '\0' + value(static_cast<std::uint32_t>(bytes.size())) + bytes;
}

// A header of one float channel; of a part where `chunks` is given.
std::string header(const std::vector<std::int32_t>& window, int compression, int chunks = -1) {
  const std::string channels = std::string("Y\0", 2) + bytes_of(std::vector<std::int32_t>{2, 0, 1, 1}) + '\0';
  std::string part;
  if (chunks >= 0)
    part = attribute("name", "string", "part") + attribute("type", "string", "scanlineimage") +
           attribute("chunkCount", "int", value(chunks));
  return part + attribute("channels", "chlist", channels) +
         attribute("compression", "compression", {static_cast<char>(compression)}) +
         attribute("dataWindow", "box2i", bytes_of(window)) + attribute("displayWindow", "box2i", bytes_of(window)) +
         attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
         attribute("pixelAspectRatio", "float", value(1.0f)) +
         attribute("screenWindowCenter", "v2f", std::string(8, '\0')) +
         attribute("screenWindowWidth", "float", value(1.0f)) + '\0';
}

const std::string kExr = value(20000630u) + value(2u), kMultiPart = value(20000630u) + value(0x1002u);

class HostileImage : public ::testing::Test {
 protected:
  void refused(const std::string& exr, const std::vector<std::string>& parts = {}) {
    expect_refused(folder, "a.exr", exr, parts, "compare");
    expect_refused(folder, "a.exr", exr, parts, "merge -o \"" + folder / "merged.exr" + "\"");
    EXPECT_FALSE(std::filesystem::exists(folder / "merged.exr"));
  }
  const TemporaryFolder folder;
};

TEST_F(HostileImage, TexturesCutOffAnywhere) {
  const std::string jpeg = noisy_jpeg();
  for (std::size_t i = 0; i < 16; ++i) {
    for (const std::string name : {"rgb.png", "deep.png"})
      expect_refused(folder, std::to_string(i) + name + ".gltf", scene_with(cut(corpus(name), i), "png"), {"image"});
    expect_refused(folder, std::to_string(i) + "jpeg.gltf", scene_with(cut(jpeg, i), "jpeg"), {"image"});
  }
  write_bytes(folder / "whole.gltf", scene_with(jpeg + "what some cameras append", "jpeg"));
  EXPECT_EQ(meniscal(folder, "info \"" + folder / "whole.gltf" + "\"").code, 0);
}

TEST_F(HostileImage, TexturesOfBillionsOfTexels) {
  for (const std::uint32_t side : {0x80000000u, 0x7fffffffu, 30000u, 16000u, 4000u}) {
    std::string png = corpus("rgb.png");
    png.replace(16, 8, big_endian(side, 4) + big_endian(side, 4));
    const std::string why = side > 16000 ? "texels" : "cannot hold";
    expect_refused(folder, "png.gltf", scene_with(png, "png"), {"image 0", why});
    if (side >= 65536) continue;
    std::string jpeg = corpus("grey.jpg");
    jpeg.replace(jpeg.find("\xff\xc0") + 5, 4, big_endian(side, 2) + big_endian(side, 2));
    expect_refused(folder, "jpeg.gltf", scene_with(jpeg, "jpeg"), {"image 0", why});
  }
}

// Nothing is wrong with it but what it becomes.
TEST_F(HostileImage, TextureOfOneColourAndMillionsOfTexels) {
  const int side = 17000;
  std::string png;
  stbi_write_png_to_func(append_to, &png, side, side, 1, std::vector<unsigned char>(side * side, 128).data(), side);
  EXPECT_LT(png.size(), side * side / 96u);
  expect_refused(folder, "one_colour.gltf", scene_with(png, "png"), {"image 0", "289000000 texels"});
}

TEST_F(HostileImage, PngOfChunksBeyondTheFile) {
  const std::string png = corpus("rgb.png"), appended = png + "what some programs append";
  write_bytes(folder / "whole.gltf", scene_with(appended, "png"));
  EXPECT_EQ(meniscal(folder, "info \"" + folder / "whole.gltf" + "\"").code, 0);
  for (const std::uint32_t claimed : {0x6e656c73u, 0x7fffffffu, 0xffffffffu}) {
    std::string longer = png;
    longer.replace(longer.find("IDAT") - 4, 4, big_endian(claimed, 4));
    expect_refused(folder, "png.gltf", scene_with(longer, "png"), {"image 0", "claims more bytes"});
    longer.resize(longer.find("IDAT") + 4);
    expect_refused(folder, "png.gltf", scene_with(longer, "png"), {"image 0", "claims more bytes"});
  }
}

TEST_F(HostileImage, ExrCutOffAnywhere) {
  for (const std::string name : {"plain.exr", "zip.exr", "layers.exr"})
    for (std::size_t i = 0; i < 16; ++i) refused(cut(corpus(name), i));
}

TEST_F(HostileImage, ExrOfHugeWindows) {
  constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min(),
                         most = std::numeric_limits<std::int32_t>::max();
  for (const int compression : {0, 1, 3, 4, 5, 9}) {
    for (const std::vector<std::int32_t>& window : std::vector<std::vector<std::int32_t>>{{0, 0, 16383, 16383},
                                                                                          {0, 0, (1 << 28) - 1, 0},
                                                                                          {0, 0, 0, (1 << 28) - 1},
                                                                                          {0, 0, most - 1, 0},
                                                                                          {0, 0, most - 1, most - 1},
                                                                                          {least, least, most, most},
                                                                                          {5, 5, 4, 4}})
      refused(kExr + header(window, compression) + std::string(64, '\0'));
  }
  refused(kExr + header({0, 0, 16383, 16383}, 3) + std::string(9000, '\0'), {"claims 16384 x 16384"});
}

TEST_F(HostileImage, ExrOfThousandsOfParts) {
  std::string parts = kMultiPart;
  for (int i = 0; i < 5000; ++i) parts += header({0, 0, 1, 1}, 0, 2);
  refused(parts + '\0');
  refused(parts + '\0' + std::string(5000 * 16, '\xff'));
  refused(kMultiPart + header({0, 0, 1 << 30, 1 << 30}, 0, 1 << 30) + '\0');
  refused(kMultiPart + header({0, 0, 1, 1}, 0, std::numeric_limits<int>::max()) + '\0');
}

TEST_F(HostileImage, ExrOfHugeAttributes) {
  const auto claims = [](std::uint32_t size) { return std::string("remark\0string\0", 14) + value(size); };
  for (const std::uint32_t size : {1000u, 0x7fffffffu, 0x80000000u, 0xffffffffu}) {
    refused(kExr + claims(size) + "short", {"remark", "claims"});
    refused(kMultiPart + header({0, 0, 1, 1}, 0, 2) + claims(size), {"remark", "claims"});
  }
  // OpenEXR reads these to their own ends, and would look for the next attribute elsewhere.
  const auto end = header({0, 0, 1, 1}, 0);
  for (const char* type : {"box2i", "chlist", "compression", "preview", "stringvector"})
    refused(kExr + attribute("odd", type, std::string(7, '\x01')) + end, {"odd", "that are claimed"});
  refused(kExr + std::string("\x1b[31m\0string\0", 13) + value(1000u), {"?[31m"});
}

// What is merely well compressed stays readable: one colour, by every method.
TEST_F(HostileImage, OfOneColourIsNone) {
  constexpr int width = 2048, height = 1024;
  const std::vector<float> row(width, 0);
  for (int method = Imf::NO_COMPRESSION; method < Imf::NUM_COMPRESSION_METHODS; ++method) {
    Imf::Header small(width, height);
    small.compression() = static_cast<Imf::Compression>(method);
    small.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    Imf::FrameBuffer frame;
    frame.insert("Y", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(const_cast<float*>(row.data())), 4, 0));
    {
      Imf::OutputFile file((folder / "flat.exr").c_str(), small);
      file.setFrameBuffer(frame);
      file.writePixels(height);
    }
    EXPECT_EQ(read_exr(folder / "flat.exr").pixel_count(), std::size_t{width} * height) << method;
  }
}

}  // namespace
}  // namespace meniscal::test
