// Buffers in the text of a .gltf.
#include "host/scene/embedded.h"
#include "tests/unit/scene_fixture.h"

namespace meniscal::gltf {
namespace {

using meniscal::testing::base64;

std::string uri(const std::string& bytes, const std::string& type = "octet-stream") {
  return std::string("{\"uri\": \"data:application/") + type + ";base64," + base64(bytes) + "\"}";
}

TEST(Embedded, BuffersAreDecodedAndNamed) {
  std::string all;
  for (int i = 0; i < 256; ++i) all += static_cast<char>(i);
  for (const std::string& bytes : {all, all + "x", all + "xy", std::string("x"), std::string("xyz")}) {
    const Embedded taken = take_out_buffers(uri(bytes) + uri("abc", "gltf-buffer"));
    EXPECT_EQ(taken.json, "{\"uri\": \"embedded:0\"}{\"uri\": \"embedded:1\"}");
    ASSERT_EQ(taken.buffers.size(), 2u);
    EXPECT_EQ(std::string(taken.buffers[0].begin(), taken.buffers[0].end()), bytes);
    EXPECT_EQ(std::string(taken.buffers[1].begin(), taken.buffers[1].end()), "abc");
  }
}

TEST(Embedded, WhatIsNoWellFormedBufferStays) {
  const std::string opening = "[\"data:application/octet-stream;base64,";
  for (const std::string& text :
       {std::string("{}"), std::string(), opening + "\"]", opening + "AAA\"]", opening + "A===\"]", opening + "AA=A\"]",
        opening + "AA%A\"]", opening + "AAAA", opening + "AA\\u0041A\"]",
        std::string("[\"a \\\"data:application/octet-stream;base64,AAAA\"]"), uri("abc", "json"),
        std::string("[\"data:image/png;base64,AAAA\"]")}) {
    const Embedded taken = take_out_buffers(text);
    EXPECT_EQ(taken.json, text);
    EXPECT_TRUE(taken.buffers.empty()) << text;
  }
}

class EmbeddedFiles : public testing::SceneFiles {};

TEST_F(EmbeddedFiles, OfAnotherLengthThanStatedAreRefused) {
  testing::Json json = testing::Json::parse(testing::triangle().text());
  EXPECT_EQ(load(json.dump()).objects.size(), 1u);
  json["buffers"][0]["byteLength"] = 40;
  expect_error(json.dump(), {"embedded:0", "40", "36"});
}

}  // namespace
}  // namespace meniscal::gltf
