// Scenes at the limits of what numbers hold, rendered by both paths.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>
#include <vector>

#include "host/render/statistics.h"
#include "tests/support/scene_objects.h"
#include "tests/support/scene_setup.h"

namespace meniscal::extremes {

using Picture = std::vector<glm::dvec3>;  // radiances of the pixels in one pass

// Of the difference to the second, per that. `left_out`: what part of the pixels, of those that differ most.
inline double relative_rms(const Picture& a, const Picture& b, double left_out = 0) {
  std::vector<double> differences;
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    differences.push_back(glm::dot(a[i] - b[i], a[i] - b[i]));
    squares += glm::dot(b[i], b[i]);
  }
  std::sort(differences.begin(), differences.end());
  differences.resize(differences.size() - static_cast<std::size_t>(left_out * double(differences.size())));
  return std::sqrt(std::accumulate(differences.begin(), differences.end(), 0.0) / squares);
}

inline double mean(const Picture& picture) {
  double sum = 0;
  for (const glm::dvec3& p : picture) sum += p.y / double(picture.size());
  return sum;
}

inline Picture scaled(Picture picture, double factor) {
  for (glm::dvec3& p : picture) p *= factor;
  return picture;
}

struct Both {
  Picture cpu, gpu;
  Picture positions;  // of what the CPU saw, in the world
};

inline Picture layer_of(const Image& image, const std::string& name) {
  const std::vector<float>& pixels = image.find(name)->pixels;
  Picture picture;
  for (std::size_t i = 0; i < pixels.size(); i += 3) picture.emplace_back(pixels[i], pixels[i + 1], pixels[i + 2]);
  return picture;
}

// All caustics' light that met a target has ended somewhere.
inline void expect_accounted(const Tallies& tallies, double tolerance = 1e-5) {
  for (const std::uint32_t map : {shared::MAP_TARGETED, shared::MAP_CAUSTIC}) {
    const Tally& t = tallies[map];
    const double landed = std::accumulate(t.flux_landed.begin(), t.flux_landed.end(), 0.0);
    EXPECT_NEAR(landed + t.flux_escaped + t.flux_cut + t.flux_absorbed, t.flux_in, tolerance * t.flux_in);
  }
}

// One pass by the reference path and by the GPU. Expects numbers that are finite and not negative, no limit that was
// hit, all caustics' flux accounted for, and that the two differ by no more than `tolerance` but for one pixel in a
// hundred, whose paths hang on rounding.
inline Both render_both(const test::Setup& setup, double tolerance = 1e-3) {
  Both both;
  const auto render = [&](Backend& backend) {
    Film film(setup.settings.crop, {"position"}, MapScale{}, setup.scene.origin);
    expect_accounted(render_passes(backend, {0, 1}, film, [](const Tallies&) { return true; }));
    EXPECT_TRUE(limits_hit(backend.statistics()).empty()) << limits_hit(backend.statistics()).front();
    const Image image = film.image(setup.settings.width, setup.settings.height);
    both.positions = layer_of(image, "position");
    const Picture picture = layer_of(image, "");
    for (std::size_t i = 0; i < picture.size(); ++i) {
      const glm::dvec3& radiance = picture[i];
      EXPECT_TRUE(std::isfinite(radiance.x + radiance.y + radiance.z)) << "pixel " << i;
      EXPECT_GE(std::min({radiance.x, radiance.y, radiance.z}), 0) << "pixel " << i;
    }
    return picture;
  };
  GpuBackend gpu(gpu::Device::open("auto"), setup.world, setup.settings);
  both.gpu = render(gpu);
  reference::ReferenceBackend cpu(setup.world, setup.settings);
  both.cpu = render(cpu);
  const double difference = both.gpu == both.cpu ? 0 : relative_rms(both.gpu, both.cpu, 0.01);  // black, too
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  std::printf("%s.%s: GPU off by %.2g\n", test->test_suite_name(), test->name(), difference);
  EXPECT_LT(difference, tolerance);
  return both;
}

inline Both with_other_seed(const std::string& name, RenderOptions options,
                            const std::function<void(Scene&)>& edit = {}) {
  options.seed = 7;
  return render_both(*test::make_setup(name, options, edit));
}

// But photons may hit elsewhere, by what a solver rounds: two pictures differ as those of two seeds do.
inline void expect_same(const Both& a, const Both& b, const Both& other_seed, const std::string& what) {
  std::printf("%s: %.3g, by another seed %.3g\n", what.c_str(), relative_rms(a.cpu, b.cpu),
              relative_rms(other_seed.cpu, b.cpu));
  for (const auto side : {&Both::cpu, &Both::gpu})
    EXPECT_LT(relative_rms(a.*side, b.*side), 1e-3 + 1.2 * relative_rms(other_seed.*side, b.*side)) << what;
}

// A scene and all lengths in it, capillary lengths too: its picture stays. Irradiances, radiances and angles do.
inline void scale_by(Scene& scene, double s) {
  scene.origin *= s;
  for (Object& o : scene.objects)
    for (glm::dvec3& p : o.mesh.positions) p *= s;
  for (Camera& c : scene.cameras) {
    c.pose[3] = glm::dvec4(glm::dvec3(c.pose[3]) * s, 1);
    c.xmag *= s, c.ymag *= s, c.znear *= s;
  }
  for (PunctualLight& l : scene.lights) {
    l.position *= s;
    if (l.type != PunctualLight::Type::directional) l.intensity *= s * s;
  }
  for (Material& m : scene.materials) {
    m.absorption /= s;
    if (!m.liquid) continue;
    m.liquid->surface_tension *= s * s;
    if (m.liquid->tolerance) *m.liquid->tolerance *= s;
  }
}

// Nothing but a white floor at y = 0, 2 `half` wide, and a camera that looks straight down on a part of it.
inline void make_floor(Scene& scene, double half, double seen) {
  Material white;
  white.name = "white";
  white.metallic = 0;
  white.specular = 0;
  scene.materials = {white};
  scene.objects = {test::make_box("floor", 0, {-half, -half, -half}, {half, 0, half})};
  scene.lights.clear();
  scene.environment.reset();
  scene.origin = glm::dvec3(0);
  test::look_down_on(scene, {0, 10 * seen, 0}, seen);
}

inline PunctualLight point_light(const glm::dvec3& position, double intensity) {
  PunctualLight light;
  light.type = PunctualLight::Type::point;
  light.position = position;
  light.intensity = glm::dvec3(intensity);
  return light;
}

}  // namespace meniscal::extremes
