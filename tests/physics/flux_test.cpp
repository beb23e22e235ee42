// Flux that enters the targeted map against quadrature over the meniscus, for each kind of light.
#include <cmath>

#include "tests/support/scene_setup.h"

namespace meniscal {
namespace {

// Irradiance through a facet of a point with this normal, from all lights, by the midpoint rule on each light.
double irradiance(const reference::Tracer& tracer, const WorldTriangle& facet, std::uint32_t index,
                  const glm::dvec3& point) {
  double sum = 0;
  const auto add = [&](const glm::dvec3& towards, double reach, std::uint32_t emitter, double facing) {
    const double cosine = glm::dot(facet.geometric, towards);
    const reference::LightSample sample{towards, reach, glm::dvec3(1), emitter, {}};
    if (facing > 0 && reference::visible(tracer, point, index, cosine > 0 ? facet.geometric : -facet.geometric, sample))
      sum += facing * std::abs(cosine);
  };
  for (const shared::Light& light : tracer.world().lights) {
    const glm::dvec3 axis(light.direction), position(light.position);
    const double intensity = mean_of(light.intensity);
    if (light.type == shared::LIGHT_DIRECTIONAL) {
      add(-axis, INFINITY, reference::no_triangle, intensity);
    } else if (light.type == shared::LIGHT_AREA) {
      constexpr int n = 16;  // cells along each edge of the triangle
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < 2 * (n - i) - 1; ++j) {
          const double third = j % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
          const glm::dvec3 on_light =
              position + (i + third) / n * glm::dvec3(light.edge1) + (j / 2 + third) / n * glm::dvec3(light.edge2);
          const double distance = glm::distance(on_light, point);
          const glm::dvec3 towards = (on_light - point) / distance;
          add(towards, distance, light.triangle,
              intensity * -glm::dot(towards, axis) * double(light.area) / (n * n) / (distance * distance));
        }
    } else {
      const double distance = glm::distance(position, point);
      const glm::dvec3 towards = (position - point) / distance;
      double falloff = 1;
      if (light.type == shared::LIGHT_SPOT)
        falloff =
            std::clamp((double(light.cone_versine) - 1 - glm::dot(towards, axis)) * double(light.cone_scale), 0.0, 1.0);
      add(towards, distance, reference::no_triangle, intensity * falloff * falloff / (distance * distance));
    }
  }
  return sum;
}

class Flux : public testing::TestWithParam<const char*> {};

TEST_P(Flux, EnteringTheTargetedMapEqualsQuadrature) {
  REQUIRE_DEVICE();
  const auto setup = test::make_setup(GetParam(), test::small_options(400000, 8, 8));
  const Stratum* targeted = test::find_stratum(setup->world, "targeted");
  ASSERT_NE(targeted, nullptr);

  const reference::Tracer tracer(setup->world);
  double expected = 0;
  for (std::uint32_t i = targeted->first; i < targeted->first + targeted->count; ++i) {
    const std::uint32_t index = setup->world.targets[i];
    const WorldTriangle& t = setup->world.triangles[index];
    expected += t.area * irradiance(tracer, t, index, (t.corner[0] + t.corner[1] + t.corner[2]) / 3.0);
  }

  GpuBackend gpu(gpu::Device::open("auto"), setup->world, setup->settings);
  constexpr int passes = 4;
  double sum = 0, squares = 0;
  for (int pass = 0; pass < passes; ++pass) {
    const double flux = test::render_pass(gpu, pass).tallies[shared::MAP_TARGETED].flux_in;
    sum += flux / passes;
    squares += flux * flux / passes;
  }
  const double sigma = std::sqrt(std::max(squares - sum * sum, 0.0) / (passes - 1));
  std::printf("%s: flux %.6g, quadrature %.6g (%+.3f %%), sigma %.3f %%\n", GetParam(), sum, expected,
              100 * (sum / expected - 1), 100 * sigma / sum);
  ASSERT_GT(expected, 0);
  EXPECT_LT(sigma, 0.002 * sum);
  EXPECT_NEAR(sum, expected, 0.005 * expected);
}

INSTANTIATE_TEST_SUITE_P(Lights, Flux,
                         testing::Values("post", "shadow_sausage", "area_light", "point_light", "spot_light"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace meniscal
