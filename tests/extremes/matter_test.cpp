// Indices of refraction and contact angles at their limits; geometry that is thin, coincident, or seen from within.
#include <glm/gtc/constants.hpp>

#include "host/world/menisci.h"
#include "meniscus/young_laplace.h"
#include "tests/extremes/extremes.h"

namespace meniscal::extremes {
namespace {

class Ior : public testing::TestWithParam<double> {};

TEST_P(Ior, GivesFiniteLight) {
  REQUIRE_DEVICE();
  const auto liquid_of = [](Scene& scene) {
    for (Material& m : scene.materials)
      if (m.liquid) m.ior = GetParam();
  };
  const RenderOptions options = test::small_options(40000, 48, 36);
  const Both curved = render_both(*test::make_setup("post", options, liquid_of));
  EXPECT_GT(mean(curved.cpu), 0);
  if (std::abs(GetParam() - 1) > 2e-4) return;
  // Nothing is deflected: as if the liquid were level.
  RenderOptions flat = options;
  flat.meniscus = MeniscusModel::none;
  const Both level = render_both(*test::make_setup("post", flat, liquid_of));
  EXPECT_NEAR(mean(curved.cpu) / mean(level.cpu), 1, 5e-3);
  EXPECT_NEAR(mean(curved.gpu) / mean(level.gpu), 1, 5e-3);
}
INSTANTIATE_TEST_SUITE_P(Indices, Ior, testing::Values(1.0, 1.0001, 2.4, 10.0, 0.75));

// Degrees from the vertical.
struct Beam {
  double ior, angle;
};
void PrintTo(const Beam& b, std::ostream* out) { *out << b.ior << "_at_" << b.angle; }
class LevelLiquid : public testing::TestWithParam<Beam> {};

// What Fresnel's equations let in; nothing from an index below 1 beyond the critical angle.
double let_through(const Beam& b) {
  const double in = glm::radians(b.angle), sine = std::sin(in) / b.ior;
  if (sine >= 1) return 0;
  const double c = std::cos(in), d = std::sqrt(1 - sine * sine);
  const double s = (c - b.ior * d) / (c + b.ior * d), p = (b.ior * c - d) / (b.ior * c + d);
  return 1 - (s * s + p * p) / 2;
}

// A tenth of a sheet of that liquid, from below.
std::unique_ptr<test::Setup> under(const Beam& beam, std::uint32_t photons) {
  const double angle = glm::radians(beam.angle);
  return test::make_setup("flat_water", test::small_options(photons, 16, 16), [&](Scene& scene) {
    for (Material& m : scene.materials)
      if (m.liquid) m.ior = beam.ior;
    // So shallow that no light comes in beside the sheet.
    test::move(scene, "floor", {1, 1, 1}, {0, 0.05 - 1e-4, 0});
    test::look_down_on(scene, {0, -5e-5, 0}, 0.01);
    scene.lights[0].direction = {std::sin(angle), -std::cos(angle), 0};
  });
}

double radiance_under(const Beam& beam) {
  return 0.5 * glm::one_over_pi<double>() * std::cos(glm::radians(beam.angle)) * let_through(beam);
}

TEST_P(LevelLiquid, LetsFresnelsPartThrough) {
  REQUIRE_DEVICE();
  constexpr std::uint32_t photons = 1000000;
  const Beam& beam = GetParam();
  const Both both = render_both(*under(beam, photons));
  const double expected = radiance_under(beam);
  // 3 sigma of the photons' number that go through where it is seen.
  const double noise = 3 / std::sqrt(0.1 * photons * std::max(let_through(beam), 1e-2));
  for (const Picture* picture : {&both.cpu, &both.gpu})
    EXPECT_NEAR(mean(*picture), expected, std::max(0.01, noise) * expected);
}
INSTANTIATE_TEST_SUITE_P(Beams, LevelLiquid,
                         testing::Values(Beam{1.0001, 0}, Beam{1.333, 0}, Beam{2.4, 0}, Beam{10, 0}, Beam{0.75, 0},
                                         Beam{1.333, 89}, Beam{1.333, 89.5}, Beam{10, 89}, Beam{0.75, 48},
                                         Beam{0.75, 60}));

// Sums of so many in single precision, in every pixel; counts that no 32 bits of a pass' rounds may wrap.
TEST(Photons, SlowMayBeABillionInPasses) {
  REQUIRE_DEVICE();
  constexpr std::uint32_t photons = 125000000, passes = 8;
  const Beam straight{1.333, 0};
  const auto setup = under(straight, photons);
  GpuBackend backend(gpu::Device::open("auto"), setup->world, setup->settings);
  Film film(setup->settings.crop, {}, MapScale{});
  const Tallies tallies = render_passes(backend, {0, passes}, film, [](const Tallies&) { return true; });
  std::uint64_t started = 0;
  for (const Tally& t : tallies) started += t.started;
  expect_accounted(tallies, 1e-6);
  EXPECT_EQ(started, std::uint64_t(photons) * passes);
  EXPECT_EQ(backend.statistics().traversal_limits, 0u);
  const Picture picture = layer_of(film.image(16, 16), "");
  const double expected = radiance_under(straight);
  double worst = 0;
  for (const glm::dvec3& radiance : picture) worst = std::max(worst, std::abs(radiance.y / expected - 1));
  std::printf("mean off by %.2g, a pixel by %.2g\n", mean(picture) / expected - 1, worst);
  EXPECT_NEAR(mean(picture), expected, 1e-4 * expected);
  EXPECT_LT(worst, 1e-3);
}

struct Angle {
  double degrees, limit;  // which it is as good as
};
void PrintTo(const Angle& a, std::ostream* out) { *out << a.degrees; }
class ContactAngle : public testing::TestWithParam<Angle> {};

TEST_P(ContactAngle, GivesThePictureOfItsLimit) {
  REQUIRE_DEVICE();
  const auto [degrees, limit] = GetParam();
  const auto wetted = [](double theta) {
    return [=](Scene& scene) {
      for (Material& m : scene.materials) m.contact_angle = theta;
    };
  };
  for (const MeniscusModel model : {MeniscusModel::paper, MeniscusModel::exact}) {
    RenderOptions options = test::small_options(40000, 48, 36);
    options.meniscus = model;
    const auto setup = test::make_setup("post", options, wetted(degrees));
    const LiquidReport& liquid = setup->world.liquids.at(0);
    if (degrees == 90) {
      EXPECT_EQ(liquid.triangles, 0u) << "nothing is built";
    } else if (model == MeniscusModel::exact) {
      const double length = capillary_length(*setup->scene.materials[1].liquid, setup->scene.gravity);
      const double rise = length * meniscus::exact_rise(glm::radians(90 - degrees), length / 2e-3);
      ASSERT_EQ(liquid.contacts.size(), 1u);
      EXPECT_NEAR(liquid.contacts[0].rise_max / rise, 1, limit == 90 ? 0.02 : 0.01);
    }
    const Both both = render_both(*setup);
    if (limit == 90) options.meniscus = MeniscusModel::none;
    const Both as_limit = render_both(*test::make_setup("post", options, wetted(limit)));
    expect_same(both, as_limit, with_other_seed("post", options, wetted(limit)), name_of(model));
  }
}
INSTANTIATE_TEST_SUITE_P(Degrees, ContactAngle,
                         testing::Values(Angle{0, 1e-6}, Angle{90 - 1e-6, 90}, Angle{90, 90}, Angle{90 + 1e-6, 90},
                                         Angle{180, 180 - 1e-6}));

struct Eye {
  const char* name;
  glm::dvec3 from, to;
  double yfov;
  double factor;  // of the radiance within the water: 1 / n^2 in the air, of paths that get in; 0 in the solid
};
void PrintTo(const Eye& eye, std::ostream* out) { *out << eye.name; }
class CameraAt : public testing::TestWithParam<Eye> {};

// The floor where no meniscus sends light to or takes it from.
TEST_P(CameraAt, SeesTheFloorAsBrightAsItIs) {
  REQUIRE_DEVICE();
  const Eye& eye = GetParam();
  const auto setup = test::make_setup("post", test::small_options(100000, 32, 32), [&](Scene& scene) {
    Camera& c = scene.cameras[0];
    c.orthographic = false;
    c.yfov = eye.yfov;
    const glm::dvec3 back = glm::normalize(eye.from - eye.to);
    const glm::dvec3 right =
        glm::normalize(glm::cross(std::abs(back.y) > 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0), back));
    c.pose = glm::dmat4(glm::dvec4(right, 0), glm::dvec4(glm::cross(back, right), 0), glm::dvec4(back, 0),
                        glm::dvec4(eye.from - scene.origin, 1));
  });
  const Both both = render_both(*setup, 5e-3);
  for (const Picture* picture : {&both.cpu, &both.gpu}) {
    if (eye.factor == 0) {
      EXPECT_EQ(mean(*picture), 0);
      continue;
    }
    double sum = 0;
    int seen = 0;
    for (std::size_t i = 0; i < picture->size(); ++i) {
      const glm::dvec3& p = both.positions[i];
      const double r = std::hypot(p.x, p.z);
      if (std::abs(p.y + 0.05) > 1e-4 || r < 0.014 || r > 0.024) continue;
      sum += (*picture)[i].y, ++seen;
    }
    ASSERT_GT(seen, 10);
    const double expected = eye.factor * radiance_under({1.333, 0});
    EXPECT_NEAR(sum / seen, expected, 0.01 * expected);
  }
}
constexpr double kFromAir = 1 / (1.333 * 1.333);
// The post is 2 mm thick, its water rises by 0.9 mm; level 0, floor at -50 mm.
INSTANTIATE_TEST_SUITE_P(Places, CameraAt,
                         testing::Values(Eye{"on_the_level", {0.02, 0, 0}, {0.02, -0.05, 0.001}, 0.4, kFromAir},
                                         Eye{"under_the_level", {0.02, -1e-7, 0}, {0.02, -0.05, 0.001}, 0.4, 1},
                                         Eye{"in_the_meniscus", {0.0023, 2e-4, 0}, {0.018, -0.05, 0}, 0.4, 1},
                                         Eye{"in_the_solid", {0, -0.01, 0}, {0.01, -0.02, 0}, 1, 0},
                                         Eye{"a_kilometre_up", {0, 1000, 0}, {0, 0, 0}, 5e-5, kFromAir}),
                         [](const auto& tested) { return tested.param.name; });

// A floor lit by a sun, in so many parts: the picture of one.
Picture floor_of(const std::function<void(Scene&)>& divide) {
  const auto setup = test::make_setup("post", test::small_options(1000, 32, 32), [&](Scene& scene) {
    const PunctualLight sun = scene.lights[0];
    make_floor(scene, 1, 0.5);
    scene.lights = {sun};
    divide(scene);
  });
  return render_both(*setup).gpu;
}

TEST(Geometry, OfCoincidentFacesIsThatOfOne) {
  REQUIRE_DEVICE();
  const Picture one = floor_of([](Scene&) {});
  const Picture many = floor_of([](Scene& scene) {
    meniscus::TriangleMesh& mesh = scene.objects[0].mesh;
    const auto triangles = mesh.triangles;
    for (int i = 0; i < 2000; ++i) mesh.triangles.insert(mesh.triangles.end(), triangles.begin(), triangles.end());
  });
  EXPECT_LT(relative_rms(many, one), 1e-5);
}

TEST(Geometry, OfSliversIsThatOfTheWhole) {
  REQUIRE_DEVICE();
  const Picture one = floor_of([](Scene&) {});
  const Picture strips = floor_of([](Scene& scene) {
    meniscus::TriangleMesh& mesh = scene.objects[0].mesh;
    mesh = {};
    const auto strip = [&](double x0, double x1) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (const glm::dvec3& p : {glm::dvec3(x0, 0, -1), {x0, 0, 1}, {x1, 0, 1}, {x1, 0, -1}})
        mesh.positions.push_back(p), mesh.normals.push_back({0, 1, 0});
      mesh.triangles.emplace_back(first, first + 1, first + 2);
      mesh.triangles.emplace_back(first, first + 2, first + 3);
    };
    constexpr double width = 2e-6;
    constexpr int slivers = 2000;
    strip(-1, 0);
    for (int i = 0; i < slivers; ++i) strip(i * width, (i + 1) * width);
    strip(slivers * width, 1);
    scene.objects[0].closed = false;
  });
  EXPECT_LT(relative_rms(strips, one), 1e-5);
}

TEST(Geometry, MayBeOneTriangle) {
  REQUIRE_DEVICE();
  const Picture triangle = floor_of([](Scene& scene) {
    meniscus::TriangleMesh& mesh = scene.objects[0].mesh;
    mesh.positions = {{-3, 0, -2}, {0, 0, 4}, {3, 0, -2}};
    mesh.normals.assign(3, {0, 1, 0});
    mesh.triangles = {{0, 1, 2}};
    scene.objects[0].closed = false;
  });
  EXPECT_LT(relative_rms(triangle, floor_of([](Scene&) {})), 1e-5);
}

TEST(Geometry, SlowMayBeFiveMillionTriangles) {
  REQUIRE_DEVICE();
  const Picture grid = floor_of([](Scene& scene) {
    constexpr std::uint32_t side = 1600;
    meniscus::TriangleMesh& mesh = scene.objects[0].mesh;
    mesh = {};
    for (std::uint32_t i = 0; i <= side; ++i)
      for (std::uint32_t j = 0; j <= side; ++j) {
        mesh.positions.emplace_back(2.0 * i / side - 1, 0, 2.0 * j / side - 1);
        mesh.normals.emplace_back(0, 1, 0);
      }
    for (std::uint32_t i = 0; i < side; ++i)
      for (std::uint32_t j = 0; j < side; ++j) {
        const std::uint32_t a = i * (side + 1) + j, b = a + side + 1;
        mesh.triangles.emplace_back(a, a + 1, b);
        mesh.triangles.emplace_back(b, a + 1, b + 1);
      }
    scene.objects[0].closed = false;
  });
  EXPECT_LT(relative_rms(grid, floor_of([](Scene&) {})), 1e-5);
}

}  // namespace
}  // namespace meniscal::extremes
