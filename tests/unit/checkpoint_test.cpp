// Renderings that are killed and resumed are those that were not.
#include <random>

#include "gtest/gtest.h"
#include "host/image/exr.h"
#include "tests/unit/program.h"

namespace meniscal {
namespace {

using test::Outcome;
using test::TemporaryFolder;

std::string quoted(const std::string& name) { return " \"" + name + "\""; }

class Resumed : public testing::Test {
 protected:
  const TemporaryFolder folder_;

  Outcome render(const std::string& options, const std::string& image, const std::string& prefix = "",
                 const std::string& scene = SCENES "/flat_water.gltf") {
    return test::meniscal(folder_,
                          "render" + quoted(scene) +
                              " --device cpu --quiet --meniscus paper --resolution 16x12 --aov all " + options + " -o" +
                              quoted(folder_ / image),
                          prefix);
  }
  std::string kept(const std::string& name = "kept") { return " --checkpoint" + quoted(folder_ / name) + " --resume "; }

  void expect_same(const std::string& a, const std::string& b) {
    const Image x = read_exr(folder_ / a), y = read_exr(folder_ / b);
    EXPECT_EQ(x.text, y.text);
    for (const Layer& layer : x.layers) EXPECT_EQ(layer.pixels, y.find(layer.name)->pixels) << layer.name;
  }
  void expect_refused(const std::string& options, const std::string& reason) {
    const Outcome o = render(options + kept(), "refused.exr");
    EXPECT_EQ(o.code, 3) << options;
    EXPECT_NE(o.error.find(reason), std::string::npos) << o.error;
    EXPECT_NE(o.error.find("kept: "), std::string::npos) << o.error;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "refused.exr"));
  }
};

TEST_F(Resumed, HasTheBitsOfAnUnbrokenRun) {
  const std::string passes = "--photons 8000 --samples 2 --pass-range 3:40";
  ASSERT_EQ(render(passes, "unbroken.exr").code, 0);
  std::mt19937 random(7);
  int killed = 0;
  Outcome o;
  do {
    // Later from time to time: a pass of a busy machine is to fit in the end.
    const std::string seconds = std::to_string(0.1 + 0.01 * double(random() % 30) + 0.02 * killed);
    o = render(passes + kept(), "resumed.exr", "timeout --foreground --signal=KILL " + seconds + " ");
    ASSERT_TRUE(o.code == 0 || o.code == 137) << o.code << o.error;
    killed += o.code == 137;
    ASSERT_LT(killed, 60);
  } while (o.code != 0);
  std::printf("killed %d times\n", killed);
  EXPECT_GE(killed, 2);
  expect_same("resumed.exr", "unbroken.exr");
}

TEST_F(Resumed, GoesOnToMorePassesAndAfterAnInterrupt) {
  ASSERT_EQ(render("--photons 500 --passes 9", "unbroken.exr").code, 0);
  ASSERT_EQ(render("--photons 500 --passes 4" + kept(), "first.exr").code, 0);
  ASSERT_EQ(render("--photons 500 --passes 9" + kept(), "resumed.exr").code, 0);
  expect_same("resumed.exr", "unbroken.exr");
  ASSERT_EQ(render("--photons 500 --passes 9" + kept(), "again.exr").code, 0);
  expect_same("again.exr", "unbroken.exr");

  const std::string endless = "--photons 500 --seed 2 --passes 2000000000";
  const Outcome o =
      render(endless + kept("interrupted"), "part.exr", "timeout --foreground --preserve-status --signal=INT 1 ");
  ASSERT_EQ(o.code, 130) << o.error;
  const std::string range = read_exr(folder_ / "part.exr").text.at("passRange");
  const std::string done = range.substr(range.find(':') + 1);
  ASSERT_EQ(render("--photons 500 --seed 2 --passes " + done + kept("interrupted"), "same.exr").code, 0)
      << "no pass is lost";
  expect_same("same.exr", "part.exr");
}

TEST_F(Resumed, OnlyFromItsOwnCheckpointWhole) {
  const std::string passes = "--photons 500 --passes 4";
  ASSERT_EQ(render(passes + kept(), "first.exr").code, 0);
  expect_refused("--photons 500 --passes 4 --seed 3", "seed is 0 instead of 3");
  expect_refused("--photons 400 --passes 4", "photonsPerPass is 500 instead of 400");
  expect_refused("--photons 500 --passes 3", "holds passes 0:4");
  expect_refused("--photons 500 --pass-range 1:8", "holds passes 0:4");

  std::string scene = test::read_bytes(SCENES "/flat_water.gltf");
  test::write_bytes(folder_ / "other.gltf", scene + "\n");
  const Outcome other = render(passes + kept(), "refused.exr", "", folder_ / "other.gltf");
  EXPECT_EQ(other.code, 3);
  EXPECT_NE(other.error.find("sceneHash"), std::string::npos) << other.error;

  const std::string whole = test::read_bytes(folder_ / "kept");
  for (const std::size_t size : {std::size_t(0), std::size_t(5), std::size_t(40), whole.size() / 2, whole.size() - 1}) {
    test::write_bytes(folder_ / "kept", whole.substr(0, size));
    expect_refused(passes, "cut off");
  }
  test::write_bytes(folder_ / "kept", whole + "x");
  expect_refused(passes, "damaged");
  for (const std::size_t at : {whole.size() / 2, whole.size() - 1}) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ 1);
    test::write_bytes(folder_ / "kept", flipped);
    expect_refused(passes, "damaged");
  }
  test::write_bytes(folder_ / "kept", std::string(4096, '\xff'));
  expect_refused(passes, "no checkpoint");
  EXPECT_EQ(render(passes + " --checkpoint" + quoted(folder_ / "kept"), "anew.exr").code, 0);
  expect_same("anew.exr", "first.exr");
  EXPECT_EQ(test::meniscal(folder_, "render a.gltf --resume").code, 2);
}

}  // namespace
}  // namespace meniscal
