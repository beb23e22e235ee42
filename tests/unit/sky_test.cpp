// Directions to suns and the environment: what is sampled, its density, and what is seen there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <map>

#include "host/reference/path.h"
#include "host/reference/sky.h"
#include "host/world/lights.h"
#include "tests/support/scene_objects.h"
#include "tests/support/skies.h"

namespace meniscal {
namespace {

using glm::dvec3;
constexpr double pi = glm::pi<double>();

World world_under(const std::function<void(Scene&)>& edit) {
  Scene scene = load_gltf(std::string(SCENES) + "/post.gltf");
  edit(scene);
  return build_world(scene, MeniscusModel::none);
}

// Calls take(direction, solid angle) for small parts of the whole sphere.
template <class Take>
void over_sphere(int rows, const Take& take) {
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < 2 * rows; ++j) {
      const double high = 1 - 2.0 * i / rows, y = high - 1.0 / rows, turn = pi * (j + 0.5) / rows;
      const double sine = std::sqrt(1 - y * y);
      take(dvec3(sine * std::cos(turn), y, sine * std::sin(turn)), 4 * pi / (2.0 * rows * rows));
    }
}

// The rotation of a glTF file's parallel light keeps float's digits only.
TEST(Sky, DensityIsThatOfTheSamplesAndIntegratesToOne) {
  const World world = world_under([](Scene& scene) {
    scene.environment = test::day();
    scene.environment->rotation = 1.1;
    test::widen_suns(scene, 30);
    scene.lights[0].direction = glm::normalize(dvec3(-1, -1, 0.3));
  });
  ASSERT_EQ(world.lights.size(), 2u);
  ASSERT_EQ(world.suns, 1u);
  double sum = 0;
  over_sphere(1200, [&](const dvec3& w, double part) { sum += part * reference::sky(world, w).pdf; });
  EXPECT_NEAR(sum, 1, 2e-3);

  // Samples by rings of height and by direction round: as many as the density says.
  constexpr int rings = 12, samples = 400000;
  std::vector<double> expected(rings * rings), found(rings * rings);
  const auto cell = [&](const dvec3& w) {
    const auto ring = std::min(int((1 - w.y) / 2 * rings), rings - 1);
    return ring * rings + std::min(int((std::atan2(w.z, w.x) / (2 * pi) + 0.5) * rings), rings - 1);
  };
  over_sphere(1200,
              [&](const dvec3& w, double part) { expected[cell(w)] += part * samples * reference::sky(world, w).pdf; });
  for (std::uint32_t i = 0; i < samples; ++i) {
    const auto s = reference::sample_lights(world, world.light_first, dvec3(0), {1, 2, 3, i}, false);
    EXPECT_NEAR(glm::length(s.direction), 1, 1e-12);
    found[cell(s.direction)] += 1;
  }
  double chi2 = 0;
  int cells = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (expected[i] < 20) continue;
    // The quadrature's own error is a thousandth, beside the samples'.
    chi2 += std::pow(found[i] - expected[i], 2) / (expected[i] + std::pow(3e-3 * expected[i], 2));
    ++cells;
  }
  EXPECT_GT(cells, 60);
  std::printf("chi^2 %.1f of %d cells\n", chi2, cells);
  EXPECT_LT(chi2, cells + 5 * std::sqrt(2.0 * cells));
}

TEST(Sky, SamplesBringTheRadianceThatIsSeen) {
  const World world = world_under([](Scene& scene) {
    scene.environment = test::day();
    scene.lights.clear();
  });
  ASSERT_EQ(world.lights.size(), 1u);
  int differ = 0;
  for (std::uint32_t i = 0; i < 10000; ++i) {
    const auto s = reference::sample_lights(world, world.light_first, dvec3(0), {1, 2, 3, i}, true);
    const auto seen = reference::sky(world, s.direction);
    const dvec3 radiance = s.irradiance * seen.pdf;
    differ += glm::distance(radiance, seen.radiance) > 1e-5 * glm::length(seen.radiance);
  }
  EXPECT_LE(differ, 3) << "samples are in the pixel that is seen, but for rounding at its edge";
}

// Direction by direction, as three.js and Blender have it: columns go from -X by -Z and +X to +Z.
TEST(Sky, LooksWhereItShould) {
  for (const auto& [degrees, wheres] :
       {std::pair(0.0, std::array{dvec3(0, 0, -1), dvec3(1, 0, 0), dvec3(0, 0, 1)}),
        std::pair(90.0, std::array{dvec3(-1, 0, 0), dvec3(0, 0, -1), dvec3(1, 0, 0)})}) {
    const World world = world_under([&, turn = degrees](Scene& scene) {
      test::light_by(scene, test::make_sky(8, 4, [](int row, int column) {
                       return glm::vec3(float(column == 2), float(column == 4), float(column == 6)) + float(row == 0);
                     }));
      scene.environment->rotation = glm::radians(turn);
    });
    for (int c = 0; c < 3; ++c) {
      dvec3 expected(0);
      expected[c] = 1;
      // A little on, so as not to hang on a pixel's edge.
      const dvec3 w = glm::normalize(wheres[c] + 0.05 * glm::cross(wheres[c], dvec3(0, 1, 0)) + dvec3(0, 0.1, 0));
      EXPECT_EQ(reference::sky(world, w).radiance, expected) << degrees << " degrees, channel " << c;
    }
    const dvec3 aside = glm::normalize(glm::cross(wheres[1], dvec3(0, 1, 0)) + wheres[1]);  // half-way on to the next
    EXPECT_EQ(reference::sky(world, glm::normalize(0.1 * aside + dvec3(0, 1, 0))).radiance, dvec3(1)) << "top row";
    EXPECT_EQ(reference::sky(world, glm::normalize(0.1 * aside - dvec3(0, 1, 0))).radiance, dvec3(0)) << "bottom";
  }
}

// The sun's edge, and its radiance: normal irradiance over pi sin^2 of half its diameter.
TEST(Sky, SunIsADisc) {
  for (const double degrees : {0.01, 0.53, 10.0, 180.0}) {
    SCOPED_TRACE(degrees);
    const World world = world_under([&](Scene& scene) { test::widen_suns(scene, degrees); });
    ASSERT_EQ(world.suns, 1u);
    const dvec3 axis = -glm::normalize(dvec3(world.lights[0].direction));
    const double half = glm::radians(degrees) / 2, irradiance = 1;
    const auto seen = [&](double angle) {
      return reference::sky(world, reference::around(axis, std::sin(angle), std::cos(angle), 0.3));
    };
    EXPECT_NEAR(seen(0.999 * half).radiance.x, irradiance / (pi * std::pow(std::sin(half), 2)),
                1e-6 * seen(0).radiance.x);
    EXPECT_EQ(seen(1.001 * half).radiance, dvec3(0));
    EXPECT_NEAR(seen(0).pdf * 4 * pi * std::pow(std::sin(half / 2), 2), 1, 1e-6);
  }
}

// Whatever the target and the direction to the sun, light on its way there goes through the view.
TEST(SunView, MissesNoTarget) {
  const World world = world_under([](Scene& scene) {
    test::widen_suns(scene, 0.9);
    scene.lights[0].direction = glm::normalize(dvec3(0.5, -1, 0.2));
  });
  ASSERT_TRUE(world.views.at(0));
  const LightView& view = *world.views[0];
  const dvec3 axis = glm::normalize(dvec3(world.lights[0].direction));
  const double half = glm::radians(0.9) / 2;
  glm::dvec2 low(1), high(0);
  for (const std::uint32_t i : world.targets)
    for (const dvec3& corner : world.triangles[i].corner)
      for (int k = 0; k < 8; ++k) {
        const dvec3 along = reference::around(axis, std::sin(half), std::cos(half), k / 8.0);
        const dvec3 through = corner + glm::dot(view.corner - corner, axis) / glm::dot(along, axis) * along;
        const dvec3 from_corner = through - view.corner;
        const glm::dvec2 place(glm::dot(from_corner, view.u) / glm::dot(view.u, view.u),
                               glm::dot(from_corner, view.v) / glm::dot(view.v, view.v));
        low = glm::min(low, place);
        high = glm::max(high, place);
      }
  EXPECT_GE(std::min(low.x, low.y), 0);
  EXPECT_LE(std::max(high.x, high.y), 1);
  EXPECT_LT(std::max(low.x, low.y), 0.01) << "and no more than that";
  EXPECT_GT(std::min(high.x, high.y), 0.99);
}

// What sampling finds, density and radiance say again, whether points of the lamp are spread over its area or, of one
// that is wide, over the solid angle.
class AreaLight : public testing::TestWithParam<double> {};

TEST_P(AreaLight, DensityIsThatOfTheSamples) {
  Scene scene = load_gltf(std::string(SCENES) + "/area_light.gltf");
  test::move(scene, "lamp", {GetParam(), 1, GetParam()}, {});
  const World world = build_world(scene, MeniscusModel::none);
  ASSERT_EQ(world.lights.size(), 2u);
  const dvec3 point(0.004, 0.05, 0.002);  // nothing stands between
  const bool wide = GetParam() > 1;
  std::map<std::uint32_t, double> densities;  // of triangles' first samples
  for (std::uint32_t i = 0; i < 100; ++i) {
    const auto s = reference::sample_lights(world, world.light_first, point, {1, 2, 3, i}, false);
    const double cosine = std::abs(glm::dot(s.direction, world.triangles[s.triangle].geometric));
    const double pdf = reference::area_light_pdf(world, s.triangle, point, s.distance, cosine);
    EXPECT_EQ(reference::asked_pdf(world, s, point), pdf);
    const dvec3 radiance = glm::dvec3(world.surfaces[world.triangles[s.triangle].material].emission);
    EXPECT_LT(glm::distance(s.irradiance * pdf, radiance), 1e-5 * glm::length(radiance));
    EXPECT_NEAR(s.extent * s.extent * pdf, wide ? std::min(1 / cosine, pdf) : 1 / cosine, 1e-4 / cosine);
    const double first = densities.emplace(s.triangle, pdf).first->second;
    if (wide) {
      EXPECT_EQ(pdf, first);
    }
  }
  const reference::Tracer tracer(world);
  double sum = 0;
  over_sphere(400, [&](const dvec3& w, double part) {
    const auto hit = tracer.closest({point, w}, 1e30, reference::no_triangle);
    if (!hit) return;
    const double cosine = std::abs(glm::dot(w, world.triangles[hit->triangle].geometric));
    sum += part * reference::area_light_pdf(world, hit->triangle, point, hit->t, cosine);
  });
  EXPECT_NEAR(sum, 1, 1e-2);

  const auto dark = std::find_if(world.triangles.begin(), world.triangles.end(), [&](const WorldTriangle& t) {
    return world.surfaces[t.material].emission == glm::vec3(0);
  });
  EXPECT_EQ(reference::area_light_pdf(world, static_cast<std::uint32_t>(dark - world.triangles.begin()), point, 1, 1),
            0);
}
INSTANTIATE_TEST_SUITE_P(Scales, AreaLight, testing::Values(1, 10, 1e3));

// The pixel of a very bright spot in a large image, and pixels beside it that are dark, or black.
TEST(Sky, DarkPixelsHaveTheirShare) {
  Environment sky = test::make_sky(512, 256, [](int row, int column) {
    return glm::vec3(row == 40 && column == 100 ? 1e6f : row < 128 ? 1e-3f : 0.0f);
  });
  std::vector<std::uint32_t> cdf = {7};
  const SampledEnvironment e = make_environment(sky, cdf);
  EXPECT_EQ(e.first, 1u);
  EXPECT_EQ(cdf.size(), 1 + 256 + 512 * 256u);
  double sum = 0;
  for (std::size_t i = 0; i < e.pixels.size(); ++i) {
    const double row = double(i / 512), angle = pi / 256;
    sum += double(e.pixels[i].w) * 2 * pi / 512 * (std::cos(angle * row) - std::cos(angle * (row + 1)));
    EXPECT_TRUE(row < 128 || e.pixels[i].w == 0);
  }
  EXPECT_NEAR(sum, 1, 1e-6);
  EXPECT_GT(e.pixels[5].w, 0);
}

}  // namespace
}  // namespace meniscal
