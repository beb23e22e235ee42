// Passes rendered apart and merged are the picture of one run.
#include <algorithm>
#include <cfloat>
#include <cmath>

#include "gtest/gtest.h"
#include "host/image/compare.h"
#include "host/image/exr.h"
#include "host/render/header.h"
#include "tests/unit/program.h"

namespace meniscal {
namespace {

using test::Outcome;
using test::TemporaryFolder;

const std::string kRender = "render \"" SCENES
                            "/post.gltf\" --device cpu --quiet --meniscus paper --resolution 12x10 --photons 3000 "
                            "--samples 2 --aov all ";

std::string quoted(const std::string& name) { return " \"" + name + "\""; }

void render(const TemporaryFolder& folder, const std::string& options, const std::string& image) {
  const Outcome o = test::meniscal(folder, kRender + options + " -o" + quoted(folder / image));
  ASSERT_EQ(o.code, 0) << o.error;
}

Outcome merge(const TemporaryFolder& folder, const std::vector<std::string>& images, const std::string& merged) {
  std::string arguments = "merge";
  for (const std::string& image : images) arguments += quoted(folder / image);
  return test::meniscal(folder, arguments + " -o" + quoted(folder / merged));
}

// Single pixels may be means of what nearly cancels: a millionth of the layer is allowed for these. A variance is made
// of differences between the images' means, which they hold as floats.
void expect_equal(const Image& merged, const Image& whole) {
  EXPECT_EQ(merged.text, whole.text);
  EXPECT_EQ(merged.matrices, whole.matrices);
  ASSERT_EQ(merged.layers.size(), aov_names().size() + 1);
  for (const LayerDifference& d : compare(merged, "merged", whole, "whole")) {
    EXPECT_LE(d.relative_rmse, 1e-5) << d.layer;
    EXPECT_EQ(d.non_finite, 0u) << d.layer;
  }
  for (const Layer& layer : whole.layers) {
    double squares = 0;
    for (const float v : layer.pixels) squares += double(v) * double(v);
    const double floor = 1e-6 * std::sqrt(squares / double(layer.pixels.size()));
    const std::vector<float>&found = merged.find(layer.name)->pixels, &means = whole.find("")->pixels;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double expected = double(layer.pixels[i]);
      const double rounding =
          layer.name == "variance" ? 4 * double(FLT_EPSILON) * double(means[i]) * std::sqrt(expected) : 0;
      ASSERT_NEAR(found[i], expected, 1e-5 * std::abs(expected) + floor + rounding) << layer.name;
    }
  }
}

TEST(Merge, EqualsTheSingleRunInAnyOrder) {
  const TemporaryFolder folder;
  render(folder, "--passes 12", "whole.exr");
  const char* const ranges[] = {"0:1", "1:3", "3:4", "4:5", "5:8", "8:9", "9:10", "10:12"};
  std::vector<std::string> parts;
  for (const char* range : ranges) {
    parts.push_back("part" + std::to_string(parts.size()) + ".exr");
    render(folder, std::string("--pass-range ") + range, parts.back());
  }
  const Image whole = read_exr(folder / "whole.exr");
  EXPECT_GT(compare(read_exr(folder / parts[0]), "part", whole, "whole")[0].relative_rmse, 0.01) << "nothing to merge";

  ASSERT_EQ(merge(folder, parts, "once.exr").code, 0);
  expect_equal(read_exr(folder / "once.exr"), whole);
  EXPECT_NEAR(
      render_seconds_of(read_exr(folder / "once.exr")),
      [&] {
        double sum = 0;
        for (const std::string& part : parts) sum += render_seconds_of(read_exr(folder / part));
        return sum;
      }(),
      1e-9);

  // Pairs of passes that lie apart, and pairs of these.
  std::vector<std::string> level = parts;
  while (level.size() > 1) {
    std::vector<std::string> next;
    for (std::size_t i = 0, half = level.size() / 2; i < half; ++i) {
      next.push_back("merged" + std::to_string(level.size()) + std::to_string(i) + ".exr");
      const Outcome o = merge(folder, {level[i + half], level[i]}, next.back());
      ASSERT_EQ(o.code, 0) << o.error;
      if (level.size() == 8 && i == 0) {
        EXPECT_NE(o.output.find("passes 0:1,5:8 "), std::string::npos) << o.output;
      }
    }
    level = next;
  }
  expect_equal(read_exr(folder / level.front()), whole);
}

// Lights in menisci, which the scene above shows none of.
TEST(Merge, EqualsTheSingleRunWithHighlights) {
  const TemporaryFolder folder;
  const auto render = [&](const std::string& passes, const std::string& image) {
    const Outcome o = test::meniscal(
        folder, "render \"" SCENES
                "/shadow_sausage.gltf\" --device cpu --quiet --meniscus paper --resolution 320x240 --crop " +
                    std::string("156,76,172,88 --photons 500 --samples 2 --aov all ") + passes + " -o" +
                    quoted(folder / image));
    ASSERT_EQ(o.code, 0) << o.error;
  };
  render("--passes 3", "whole.exr");
  render("--pass-range 0:1", "first.exr");
  render("--pass-range 1:3", "rest.exr");
  ASSERT_EQ(merge(folder, {"first.exr", "rest.exr"}, "merged.exr").code, 0);
  const Image whole = read_exr(folder / "whole.exr"), first = read_exr(folder / "first.exr");
  expect_equal(read_exr(folder / "merged.exr"), whole);
  double brightest = 0, apart = 0;
  for (std::size_t i = 0; i < whole.find("highlight")->pixels.size(); ++i) {
    const double highlight = double(whole.find("highlight")->pixels[i]);
    brightest = std::max(brightest, highlight);
    apart = std::max(apart, std::abs(double(first.find("highlight")->pixels[i]) - highlight));
  }
  EXPECT_GT(apart, 0.001 * brightest) << "nothing to merge";
}

class RefusedMerge : public testing::Test {
 protected:
  const TemporaryFolder folder_;
  const std::string scene_ = folder_ / "scene.gltf";

  void SetUp() override { render(folder_, "--passes 2", "first.exr"); }

  void expect_refused(const std::string& image, const std::vector<std::string>& named) {
    const Outcome o = merge(folder_, {"first.exr", image}, "out.exr");
    EXPECT_EQ(o.code, 3) << image;
    for (const std::string& name : named) EXPECT_NE(o.error.find(name), std::string::npos) << name << " in " << o.error;
    EXPECT_NE(o.error.find(image), std::string::npos) << o.error;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out.exr"));
  }
};

TEST_F(RefusedMerge, OverlappingPasses) {
  render(folder_, "--pass-range 1:3", "overlapping.exr");
  expect_refused("overlapping.exr", {"passes 1:2", "first.exr"});
  expect_refused("first.exr", {"passes 0:2"});
}

TEST_F(RefusedMerge, OtherSettings) {
  const std::pair<std::string, std::vector<std::string>> cases[] = {
      {"--seed 7", {"seed is 7 instead of 0", "first.exr"}},
      {"--photons 2999", {"photonsPerPass"}},
      {"--samples 3", {"samplesPerPass"}},
      {"--specular-bounces 3", {"specularBounces"}},
      {"--meniscus none", {"meniscusModel is none"}},
      {"--integrator ordinary", {"integrator is ordinary"}},
      {"--map-scale caustic=2", {"mapScale"}},
      {"--radius 1e-4", {"footprints is round"}},
      {"--crop 0,0,11,10", {"crop"}},
      {"--resolution 12x11", {"12x11", "12x10"}},
      {"--aov depth", {"layers"}}};
  for (const auto& [options, named] : cases) {
    std::string arguments = kRender;
    for (const std::string option : {"--photons 3000 ", "--samples 2 ", "--meniscus paper ", "--resolution 12x10 "})
      if (options.substr(0, options.find(' ')) == option.substr(0, option.find(' ')))
        arguments.erase(arguments.find(option), option.size());
    if (options == "--aov depth") arguments.erase(arguments.find("--aov all"), 9);
    const Outcome o =
        test::meniscal(folder_, arguments + options + " --pass-range 2:3 -o" + quoted(folder_ / "other.exr"));
    ASSERT_EQ(o.code, 0) << options << ": " << o.error;
    expect_refused("other.exr", named);
  }
}

TEST_F(RefusedMerge, RoundFootprintsOfAnotherRadius) {
  render(folder_, "--radius 1e-4 --passes 1", "first.exr");
  render(folder_, "--radius 2e-4 --pass-range 1:2", "wider.exr");
  expect_refused("wider.exr", {"radius"});
}

TEST_F(RefusedMerge, AnotherScene) {
  std::string scene = test::read_bytes(SCENES "/post.gltf");
  test::write_bytes(scene_, scene + "\n");
  std::string arguments = kRender;
  arguments.replace(arguments.find(SCENES), std::string(SCENES "/post.gltf").size(), scene_);
  ASSERT_EQ(test::meniscal(folder_, arguments + "--pass-range 2:3 -o" + quoted(folder_ / "other.exr")).code, 0);
  expect_refused("other.exr", {"sceneHash"});
}

TEST_F(RefusedMerge, WhatIsNoRendering) {
  Image grey = read_exr(folder_ / "first.exr");
  for (const std::string passes : {"", "0", "2:2", "3:2", "2:3,", "2:4,3:5", "2:3;4:5", "-1:3", "2:4294967296"}) {
    grey.text["passRange"] = passes;
    write_exr(folder_ / "grey.exr", grey);
    expect_refused("grey.exr", {"does not say which passes"});
  }
  test::write_bytes(folder_ / "text.exr", "not an image");
  expect_refused("text.exr", {"not a readable EXR"});
  const std::string bytes = test::read_bytes(folder_ / "first.exr");
  test::write_bytes(folder_ / "short.exr", bytes.substr(0, bytes.size() / 2));
  expect_refused("short.exr", {"not a readable EXR"});
  expect_refused("missing.exr", {"not a readable EXR"});
}

TEST(PassRanges, AreReadAsWritten) {
  for (const std::string text : {"0:1", "0:4,6:8", "5:4294967295"}) EXPECT_EQ(to_text(*parse_pass_ranges(text)), text);
  EXPECT_EQ(to_text(*parse_pass_ranges("6:8,0:4,4:5")), "0:5,6:8");
  EXPECT_EQ(count(*parse_pass_ranges("0:4,6:8")), 6u);
}

}  // namespace
}  // namespace meniscal
