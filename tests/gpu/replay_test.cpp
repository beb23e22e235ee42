// The same photon on both sides: the GPU against the reference path, photon by photon.
#include <algorithm>
#include <cstdio>

#include "tests/support/scene_setup.h"
#include "tests/support/skies.h"

namespace meniscal {
namespace {

using reference::Perturbation, reference::Photon, reference::trace_photon;

constexpr std::uint32_t replayed_pass = 3;

struct Mismatch {
  std::uint32_t index, gpu_end, reference_end;
  std::string reason;  // "edge", "roulette" or "unexplained"
};

// Whether one of many perturbations makes the reference end where the GPU did.
template <class MakePerturbation>
bool explains(const reference::Tracer& tracer, const RenderSettings& settings, std::uint32_t index,
              std::uint32_t gpu_end, MakePerturbation perturbation) {
  for (int k = 0; k < 2048; ++k)
    if (trace_photon(tracer, settings, replayed_pass, index, perturbation(k)).end == gpu_end) return true;
  return false;
}

// Why a photon ended elsewhere: a start or hit within float's rounding of an edge or of another surface, or a decision
// within rounding of its random number.
std::string reason(const reference::Tracer& tracer, const RenderSettings& settings, std::uint32_t index,
                   std::uint32_t gpu_end) {
  // Directions over the sphere, four sizes from a hundredth of float's rounding at the scene's radius up.
  const auto shifted = [&](int k) {
    const double angle = 2.399963 * k, height = 1 - (2 * k + 1) / 2048.0, ring = std::sqrt(1 - height * height);
    const double size = tracer.world().radius * std::pow(10, k % 4) * 3e-9;
    return Perturbation{size * glm::dvec3(ring * std::cos(angle), height, ring * std::sin(angle)), 0};
  };
  const auto decided = [&](int k) { return Perturbation{glm::dvec3(0), (k - 1023.5) / 1024 * 3e-6}; };
  if (explains(tracer, settings, index, gpu_end, shifted)) return "edge";
  if (explains(tracer, settings, index, gpu_end, decided)) return "roulette";
  return "unexplained";
}

class Replay : public testing::TestWithParam<const char*> {};

TEST_P(Replay, EveryPhotonEndsAlike) {
  REQUIRE_DEVICE();
  const test::NamedLight named = test::named_light(GetParam());
  const auto setup = test::make_setup(named.file, test::small_options(200000), named.edit);
  GpuBackend gpu(gpu::Device::open("auto", true), setup->world, setup->settings);
  const reference::Tracer tracer(setup->world);
  const std::vector<PhotonEnd> ends = gpu.trace_photons(replayed_pass);
  ASSERT_EQ(ends.size(), setup->settings.caustics.count());
  std::vector<Photon> expected;
  for (std::uint32_t i = 0; i < ends.size(); ++i)
    expected.push_back(trace_photon(tracer, setup->settings, replayed_pass, i));
  double brightest = 0;
  for (const Photon& p : expected) brightest = std::max(brightest, mean_of(p.entered));

  std::vector<Mismatch> mismatches;
  for (std::uint32_t i = 0; i < ends.size(); ++i) {
    if (ends[i].end != expected[i].end) {
      mismatches.push_back({i, ends[i].end, expected[i].end, reason(tracer, setup->settings, i, ends[i].end)});
      continue;
    }
    // Where a window fades, weights are differences of like numbers: what counts is what a photon may carry.
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(ends[i].flux[c], expected[i].flux[c], 1e-5 * brightest) << "photon " << i;
    if (ends[i].end >= shared::END_FIRST) continue;
    EXPECT_EQ(ends[i].map, expected[i].map) << "photon " << i;
    EXPECT_LT(glm::distance(ends[i].position, expected[i].position), 1e-3 * setup->world.radius) << "photon " << i;
  }
  for (const Mismatch& m : mismatches) {
    std::printf("{\"scene\":\"%s\",\"photon\":%u,\"gpu\":%u,\"cpu\":%u,\"reason\":\"%s\"}\n", GetParam(), m.index,
                m.gpu_end, m.reference_end, m.reason.c_str());
    EXPECT_NE(m.reason, "unexplained");
  }
  EXPECT_LE(mismatches.size(), ends.size() / 10000);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Replay,
                         testing::Values("post", "shadow_sausage", "sphere", "area_light", "point_light", "spot_light",
                                         "post-sun", "post-wide_sun", "shadow_sausage-day"),
                         test::name_of_test);

}  // namespace
}  // namespace meniscal
