// How photons are shared out among the places where they may start.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "host/render/beams.h"
#include "host/scene/scene.h"
#include "shaders/shared/starts.h"

namespace meniscal {
namespace {

World shadow_sausage() {
  return build_world(load_gltf(std::string(SCENES) + "/shadow_sausage.gltf"), MeniscusModel::paper);
}

// Three windows, the inner two touching: borders must keep them in each other.
std::vector<StartSet> nested() {
  StartSet set{0, 0, {}};
  set.windows.push_back({.share = 0.05, .seen = false});
  set.windows.push_back({{0.2, 0.3}, {0.8, 0.7}, 0.35});
  set.windows.push_back({{0.21, 0.4}, {0.5, 0.69}, 0.6});
  return {set};
}

float weight(const shared::Beam& beam, const shared::vec2& place) {
  return shared::window_weight(place, beam.own, beam.own_fade) -
         shared::window_weight(place, beam.finer, beam.finer_fade);
}

TEST(Beams, WeightsSumToOneEverywhere) {
  const World world = shadow_sausage();
  for (const auto& starts : {default_starts(world), nested()}) {
    const std::vector<shared::Beam> beams = make_beams(world, starts, 100000);
    ASSERT_EQ(beams.size(), starts.at(0).windows.size());
    for (int i = 0; i < 10000; ++i) {
      const shared::vec2 place(float(i % 100) / 100, float(i / 100) / 100);
      float sum = 0;
      for (const shared::Beam& b : beams) {
        const float w = weight(b, place);
        sum += w;
        EXPECT_GT(w, -1e-6f);
        const shared::vec2 low = shared::vec2(b.start) / 65536.0f, high = low + shared::vec2(b.extent) / 65536.0f;
        const bool started = place.x >= low.x && place.y >= low.y && place.x < high.x && place.y < high.y;
        EXPECT_TRUE(w <= 0 || started) << place.x << " " << place.y;
      }
      EXPECT_NEAR(sum, 1, 1e-6);
    }
  }
}

TEST(Beams, PowerIsTheAreaOfAPhoton) {
  const World world = shadow_sausage();
  for (const shared::Beam& b : make_beams(world, nested(), 100000)) {
    const double part = double(b.extent.x) * b.extent.y / 0x1p32;
    EXPECT_NEAR(double(b.power) * b.count, part * world.views.at(0)->area, 1e-6 * world.views.at(0)->area);
  }
}

TEST(Beams, EveryStartIsTakenOnceAndNeighboursLieNearEachOther) {
  const World world = shadow_sausage();
  for (std::uint32_t photons : {1u, 7u, 1000u, 5000u, 70000u}) {
    const shared::Beam beam = make_beams(world, {StartSet{0, 0, {StartWindow{.share = 1}}}}, photons).at(0);
    std::vector<std::uint32_t> taken, all(beam.count);
    for (std::uint32_t i = 0; i < beam.count; ++i) taken.push_back(start_index(beam, i));
    std::iota(all.begin(), all.end(), 0u);
    std::vector<std::uint32_t> sorted = taken;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(sorted, all);

    double apart =
        0;  // mean distance of consecutive starts; about a half without an order, as those have that are left over
    for (std::uint32_t i = 0; i + 1 < beam.count; ++i) {
      const auto place = [&](std::uint32_t k) {
        return glm::dvec2(shared::start_bits({1, 2, 3, taken[k]}, beam.start, beam.extent)) * 0x1p-32;
      };
      apart += glm::distance(place(i), place(i + 1)) / beam.count;
    }
    EXPECT_TRUE(photons < 1000 || apart < 7 / std::sqrt(photons) + 0.5 / 8) << apart;
  }
}

TEST(Beams, ADarkSceneStartsNoPhotons) {
  Scene scene = load_gltf(std::string(SCENES) + "/shadow_sausage.gltf");
  scene.lights.clear();
  const World world = build_world(scene, MeniscusModel::none);
  EXPECT_TRUE(make_beams(world, default_starts(world), 1000).empty());
  EXPECT_TRUE(light_beams(world, 1000).empty());
}

}  // namespace
}  // namespace meniscal
