// Outer faces: what their lobes reflect against quadrature, and what of it sampling finds.
#include "host/reference/reflection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "shaders/shared/geometry.h"

namespace meniscal::reference {
namespace {

constexpr double pi = glm::pi<double>();

Face face_at(double degrees, double alpha, double f0 = 1) {
  const double angle = glm::radians(degrees);
  return {{0, 1, 0}, {std::sin(angle), std::cos(angle), 0}, alpha, glm::dvec3(f0), 1};
}

// Integral over the hemisphere, by the midpoint rule in the half-angle's polar coordinates, in which lobes are smooth.
template <class Function>
double integral(const Face& face, const Function& f) {
  constexpr int rings = 2000, sectors = 720;
  double sum = 0;
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < sectors; ++k) {
      // Rings crowd together where the facets do.
      const double t = (i + 0.5) / rings, spread = face.alpha * std::tan(t * std::atan(1 / face.alpha * 50));
      const double polar = std::atan(spread), turn = 2 * pi * (k + 0.5) / sectors;
      const double width = face.alpha * std::atan(50 / face.alpha) /
                           (rings * std::pow(std::cos(t * std::atan(50 / face.alpha)), 2)) / (1 + spread * spread);
      const glm::dvec3 facet(std::sin(polar) * std::cos(turn), std::cos(polar), std::sin(polar) * std::sin(turn));
      const double met = glm::dot(facet, face.outgoing);
      const glm::dvec3 incoming = 2 * met * facet - face.outgoing;
      if (met <= 0 || incoming.y <= 0) continue;
      sum += f(incoming) * 4 * met * std::sin(polar) * width * 2 * pi / sectors;  // d incoming = 4 met d facet
    }
  return sum;
}

class Lobe : public testing::TestWithParam<double> {};

TEST_P(Lobe, IsFoundBySamplingAsByQuadrature) {
  for (const double degrees : {0.0, 40.0, 75.0}) {
    const Face face = face_at(degrees, GetParam(), 0.3);
    const double albedo = integral(face, [&](const glm::dvec3& in) { return lobe(face, in).x * in.y; });
    double sampled = 0, squares = 0;
    constexpr int side = 300;
    for (int i = 0; i < side * side; ++i) {
      const LobeSample s = sample_lobe(face, {(i % side + 0.5) / side, (double(i / side) + 0.5) / side});
      sampled += s.weight.x;
      // The second moment of the direction too: the weights alone would not tell where samples go.
      squares += s.weight.x * s.incoming.x * s.incoming.x;
    }
    EXPECT_NEAR(sampled / side / side, albedo, 2e-3) << degrees;
    const double moment = integral(face, [&](const glm::dvec3& in) { return lobe(face, in).x * in.y * in.x * in.x; });
    EXPECT_NEAR(squares / side / side, moment, 2e-3) << degrees;
    EXPECT_LE(albedo, 1);
  }
}

TEST_P(Lobe, DensityIntegratesToWhatIsAboveTheSurface) {
  const Face face = face_at(55, GetParam());
  double above = 0;
  constexpr int side = 300;
  for (int i = 0; i < side * side; ++i)
    above += sample_lobe(face, {(i % side + 0.5) / side, (double(i / side) + 0.5) / side}).incoming.y > 0;
  EXPECT_NEAR(integral(face, [&](const glm::dvec3& in) { return lobe_pdf(face, in); }), above / side / side, 2e-3);
}

TEST_P(Lobe, IsTheSameForwardsAndBackwards) {
  const Face face = face_at(30, GetParam(), 0.04);
  Face back = face;
  const glm::dvec3 incoming = glm::normalize(glm::dvec3(-0.4, 0.7, 0.2));
  back.outgoing = incoming;
  EXPECT_NEAR(lobe(face, incoming).x, lobe(back, face.outgoing).x, 1e-12);
  EXPECT_NEAR(passed(face, incoming), passed(back, face.outgoing), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Alpha, Lobe, testing::Values(0.0025, 0.04, 0.25, 1.0), [](const auto& tested) {
  return "of_" + std::to_string(static_cast<int>(1e4 * tested.param));
});

// Where nothing is absorbed, what the face reflects and what Lambert's surface does below are all light together, but
// for what facets hide from each other.
TEST(Face, ReflectsNoMoreThanItGets) {
  for (const double degrees : {0.0, 60.0, 85.0}) {
    const Face face = face_at(degrees, 0.25, 0.04);
    const double by_lobe = integral(face, [&](const glm::dvec3& in) { return lobe(face, in).x * in.y; });
    const double all = integral(
        face, [&](const glm::dvec3& in) { return (beyond_lambert(face, glm::dvec3(1), in, 1).x + 1 / pi) * in.y; });
    const double mirrored = reflectance(face, std::cos(glm::radians(degrees))).x;
    EXPECT_NEAR(all - by_lobe, 1 - mirrored, 1e-3) << degrees;
    EXPECT_LE(all, 1 + 1e-2) << degrees;
  }
}

TEST(Directions, KeepToAHundredthOfADegreeInAWord) {
  for (int i = 0; i < 2000; ++i) {
    const double z = 1 - (2 * i + 1) / 2000.0, turn = 2.399963 * i, r = std::sqrt(1 - z * z);
    const glm::vec3 d(r * std::cos(turn), r * std::sin(turn), z);
    EXPECT_LT(glm::distance(shared::unpack_direction(shared::pack_direction(d)), d), 1e-4f);
  }
}

}  // namespace
}  // namespace meniscal::reference
