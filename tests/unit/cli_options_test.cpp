// `render` options: what is parsed, and what is refused with the option's name.
#include <CLI/CLI.hpp>

#include "gtest/gtest.h"
#include "host/cli/render_options.h"

namespace meniscal {
namespace {

RenderOptions parse(const std::string& arguments) {
  RenderOptions options;
  CLI::App app;
  CLI::App* command = app.add_subcommand("render");
  add_render_options(*command, options);
  app.parse("render " + arguments, false);
  return options;
}

TEST(RenderOptions, FileNameAloneIsEnough) {
  const RenderOptions o = parse("scenes/pool.gltf");
  EXPECT_EQ(o.scene, "scenes/pool.gltf");
  EXPECT_EQ(o.output, "pool.exr");
  EXPECT_EQ(o.device, "auto");
  EXPECT_EQ(o.meniscus, MeniscusModel::exact);
  EXPECT_EQ(o.tonemap, ToneMap::ward);
  EXPECT_EQ(o.passes_to_run(1).first, 0u);
  EXPECT_EQ(o.passes_to_run(1).last, preset(Quality::final).passes);
  EXPECT_EQ(o.map_scale.targeted, 1);
  EXPECT_TRUE(o.aovs.empty());
  EXPECT_FALSE(o.radius || o.resolution || o.crop || o.camera || o.preview || o.exposure || o.stats || o.passes ||
               o.pass_range);
}

TEST(Presets, BuyAPixelOfALargePictureNoLess) {
  for (const Quality quality : {Quality::draft, Quality::preview, Quality::final}) {
    const Preset p = preset(quality);
    for (const bool gathers : {false, true})
      for (const std::size_t pixels : {1ul, 1000ul, 640ul * 480, 1920ul * 1080, 3840ul * 2160, 16384ul * 16384}) {
        const PassCounts b = p.counts(pixels, gathers);
        EXPECT_LE(b.photons, kPhotonsAtOnce);
        EXPECT_GE(b.samples, 1u);
        EXPECT_GE(b.samples * b.passes, (gathers ? p.gathering_samples : p.plain_samples) * p.passes);
        EXPECT_GE(double(b.photons + 1) * b.passes, 0.999 * p.photons_per_pixel * double(pixels) * p.passes);
      }
    const PassCounts usual = p.counts(640 * 480, true);
    EXPECT_EQ(usual.passes, p.passes);
    EXPECT_EQ(usual.samples, p.gathering_samples);
  }
  EXPECT_EQ(preset(Quality::final).counts(1920 * 1080, true).passes, 14u);
}

TEST(RenderOptions, EachOptionIsTaken) {
  const RenderOptions o = parse(
      "a.glb -o out.exr --device llvmpipe --meniscus paper --meniscus-tolerance 2.5 --photons 1e6 --passes 7 --radius "
      "2.5e-4 --kernel uniform --diffuse-bounces "
      "0 "
      "--specular-bounces 5 --seed 4294967295 --map-scale global=0,targeted=2.5 --resolution 320x200 --crop "
      "10,20,320,200 --camera Top "
      "--preview p.png --tonemap aces --exposure -1.5 --stats s.json --aov meniscus,direct --json-progress");
  EXPECT_EQ(o.output, "out.exr");
  EXPECT_EQ(o.device, "llvmpipe");
  EXPECT_EQ(o.meniscus, MeniscusModel::paper);
  EXPECT_EQ(o.meniscus_tolerance, 2.5);
  EXPECT_EQ(o.photons, 1000000u);
  EXPECT_EQ(o.passes_to_run(1).last, 7u);
  EXPECT_EQ(o.radius, 2.5e-4);
  EXPECT_EQ(o.kernel, shared::KERNEL_UNIFORM);
  EXPECT_EQ(o.diffuse_bounces, 0);
  EXPECT_EQ(o.specular_bounces, 5);
  EXPECT_EQ(o.seed, 4294967295u);
  EXPECT_EQ(std::make_tuple(o.map_scale.targeted, o.map_scale.caustic, o.map_scale.global),
            std::make_tuple(2.5, 1.0, 0.0));
  EXPECT_EQ(std::make_tuple(o.resolution->width, o.resolution->height), std::make_tuple(320, 200));
  EXPECT_EQ(std::make_tuple(o.crop->x0, o.crop->y0, o.crop->x1, o.crop->y1), std::make_tuple(10, 20, 320, 200));
  EXPECT_EQ(o.camera, "Top");
  EXPECT_EQ(o.preview, "p.png");
  EXPECT_EQ(o.tonemap, ToneMap::aces);
  EXPECT_EQ(o.exposure, -1.5);
  EXPECT_EQ(o.stats, "s.json");
  EXPECT_EQ(o.aovs, (std::vector<std::string>{"direct", "meniscus"}));  // in the order of writing
  EXPECT_TRUE(o.json_progress);
}

TEST(RenderOptions, AovsAllAndNone) {
  EXPECT_EQ(parse("a --aov all").aovs, aov_names());
  EXPECT_TRUE(parse("a --aov none").aovs.empty());
}

TEST(RenderOptions, PassRangeIsCutByPasses) {
  const PassRange alone = parse("a --pass-range 16:64").passes_to_run(1),
                  cut = parse("a --pass-range 16:64 --passes 20").passes_to_run(1);
  EXPECT_EQ(std::make_pair(alone.first, alone.last), std::make_pair(16u, 64u));
  EXPECT_EQ(std::make_pair(cut.first, cut.last), std::make_pair(16u, 20u));
}

TEST(RenderOptions, TimeAndTargetErrorLiftTheQualitysLimitOfPasses) {
  EXPECT_EQ(parse("a --time 3").passes_to_run(1).last, most_passes);
  EXPECT_EQ(parse("a --time 3").time, 3);
  EXPECT_EQ(parse("a --target-error 0.01").passes_to_run(1).last, most_passes);
  EXPECT_EQ(parse("a --target-error 0.01").target_error, 0.01);
  EXPECT_EQ(parse("a --time 3 --passes 5").passes_to_run(1).last, 5u);
  EXPECT_EQ(parse("a --time 3 --pass-range 2:5").passes_to_run(1).last, 5u);
}

class Refused : public ::testing::TestWithParam<std::string> {};

TEST_P(Refused, WithTheOptionsName) {
  const std::string option = GetParam().substr(0, GetParam().find(' '));
  try {
    parse("a " + GetParam());
    ADD_FAILURE() << "accepted";
  } catch (const CLI::ParseError& error) {
    EXPECT_NE(std::string(error.what()).find(option), std::string::npos) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    RenderOptions, Refused,
    ::testing::Values("--photons 0", "--photons -5", "--photons 1.5", "--photons many", "--photons 1e10", "--passes 0",
                      "--pass-range 3", "--pass-range 3:3", "--pass-range 5:2", "--pass-range -1:2",
                      "--pass-range 1:2:3", "--pass-range 16:32 --passes 16", "--radius 0", "--radius nan",
                      "--radius inf", "--radius -1", "--kernel gauss", "--seed -1", "--seed 4294967296",
                      "--resolution 640", "--resolution 640x", "--resolution 0x480", "--resolution 640x480x3",
                      "--resolution 1e9x1", "--crop 1,2,3", "--crop 5,0,5,9", "--crop -1,0,5,9",
                      "--crop 0,0,9,9 --resolution 8x9", "--crop 0,0,8,10 --resolution 8x9", "--map-scale targeted",
                      "--map-scale sun=1", "--map-scale targeted=nan", "--map-scale targeted=-1",
                      "--map-scale targeted=1,", "--tonemap filmic", "--meniscus flat", "--meniscus-tolerance 0",
                      "--exposure nan", "--exposure bright", "--aov depth,colour", "--diffuse-bounces -1",
                      "--quiet --json-progress", "--integrator light", "--quality best", "--time 0", "--time nan",
                      "--time -1", "--target-error 0", "--target-error inf", "--output a", "--output ./b/../a",
                      "--preview a", "--preview p.png --output ./p.png", "--stats p --preview p", "--checkpoint a",
                      "--checkpoint p --stats p"));

TEST(RenderOptions, SceneIsNeeded) { EXPECT_THROW(parse("--passes 3"), CLI::RequiredError); }

}  // namespace
}  // namespace meniscal
