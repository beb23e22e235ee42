// What a render was asked for, complete: nothing is left to default any more.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "host/scene/scene.h"
#include "host/world/world.h"

namespace meniscal {

struct Crop {
  std::uint32_t x0, y0, x1, y1;  // pixels, half-open
  std::uint32_t width() const { return x1 - x0; }
  std::uint32_t height() const { return y1 - y0; }
  std::size_t pixels() const { return std::size_t(width()) * height(); }
};

struct RenderSettings {
  std::uint32_t seed = 0;
  std::uint32_t width = 640, height = 480;
  Crop crop{0, 0, 640, 480};
  Camera camera;
  std::vector<std::uint32_t> photons;  // started per pass, by stratum of the world
  std::vector<double> first_radius;     // gather radius of pass 0 by stratum, m
  std::uint32_t specular_bounces = 8;
};

// Gather radius of a pass: r_i^2 = r_0^2 prod_{k=1..i} (k + a) / (k + 1), a = 2/3 (Knaus and Zwicker 2011, eq. 20, from 0).
inline double pass_radius(double first_radius, std::uint32_t pass) {
  // The product in closed form: Gamma(i + 1 + a) / (Gamma(1 + a) Gamma(i + 2)).
  constexpr double a = 2.0 / 3.0;
  const double i = pass;
  return first_radius * std::exp(0.5 * (std::lgamma(i + 1 + a) - std::lgamma(1 + a) - std::lgamma(i + 2)));
}

// Image-plane axes of a camera, scaled: a ray through (x, y) in [-1, 1]^2 has offset x right + y up. A camera without an aspect
// ratio takes the image's; one with another than the image's keeps its vertical extent.
struct CameraAxes {
  glm::dvec3 right, up, forward, origin;
};
CameraAxes camera_axes(const Camera& camera, std::uint32_t width, std::uint32_t height);

// Side of a pixel on what the middle of the image sees; on the scene's centre where it sees nothing. Metres.
double pixel_footprint(const World& world, const RenderSettings& settings);

}  // namespace meniscal
