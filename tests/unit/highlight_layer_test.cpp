// How highlights get into a picture: once a pass, whatever its camera rays, in the beauty and in a layer of their own.
#include "tests/support/scene_setup.h"

namespace meniscal {
namespace {

// The picture of some passes; the sums over them, by pixel, of what the backend said of highlights, and of the means of
// what its camera paths met of lights, which has no layer.
struct Rendered {
  Image image;
  std::vector<glm::dvec3> highlights, emitted;
};

Rendered render(const test::Setup& setup, std::uint32_t passes) {
  const RenderSettings& settings = setup.settings;
  const std::size_t pixels = settings.crop.pixels();
  Rendered rendered{{}, std::vector<glm::dvec3>(pixels), std::vector<glm::dvec3>(pixels)};
  reference::ReferenceBackend backend(setup.world, settings);
  Film film(settings.crop, aov_names(), {});
  render_passes(backend, {0, passes}, film, [](const Tallies&) { return true; });
  rendered.image = film.image(settings.width, settings.height);
  for (std::uint32_t pass = 0; pass < passes; ++pass)
    backend.render_pass(pass, [&](const Samples& samples, const View&) {
      for (std::size_t i = 0; i < samples.highlights.size(); ++i)
        rendered.highlights[i] += glm::dvec3(samples.highlights[i]);
      for (std::size_t i = 0; i < pixels; ++i)
        rendered.emitted[i] += glm::dvec3(samples.pixels[i].emitted) / double(settings.samples);
    });
  return rendered;
}

// A lamp that is seen in level water, too, and a sun, which there is not; paths by roulette, and split.
TEST(HighlightLayer, IsTheMeanOverPassesHoweverManyRaysAPassHas) {
  const std::pair<const char*, Crop> views[] = {{"tank", {136, 112, 152, 124}}, {"shadow_sausage", {156, 76, 172, 88}}};
  for (const auto& [scene, crop] : views)
    for (const auto& [samples, split] : {std::pair(1U, 0U), std::pair(4U, 0U), std::pair(4U, 2U)}) {
      RenderOptions options = test::small_options(500, 320, 240);
      options.crop = crop;
      options.samples = samples;
      const auto setup = test::make_setup(scene, options);
      setup->settings.split = split;
      constexpr std::uint32_t passes = 3;
      const Rendered r = render(*setup, passes);
      const Layer &layer = *r.image.find("highlight"), &beauty = *r.image.find("");
      double brightest = 0, highest = 0;
      for (const float v : beauty.pixels) brightest = std::max(brightest, double(v));
      for (std::size_t i = 0; i < layer.pixels.size(); ++i) {
        const int c = static_cast<int>(i % 3);
        const double expected = r.highlights[i / 3][c] / passes;
        highest = std::max(highest, expected);
        ASSERT_NEAR(layer.pixels[i], expected, 1e-6 * expected + 1e-12 * brightest)
            << scene << " " << samples << " " << i;
        double left = double(beauty.pixels[i]) - r.emitted[i / 3][c] / passes;
        for (const char* part : {"direct", "targeted", "caustic", "global"})
          left -= double(r.image.find(part)->pixels[i]);
        ASSERT_NEAR(left, expected, 1e-6 * brightest) << scene << " " << samples << " " << i;
      }
      EXPECT_GT(highest, 0.01 * brightest) << scene;
    }
}

}  // namespace
}  // namespace meniscal
