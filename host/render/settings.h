// What a render was asked for, complete: nothing is left to default any more.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "host/render/beams.h"
#include "host/scene/scene.h"

namespace meniscal {

struct Crop {
  std::uint32_t x0, y0, x1, y1;  // pixels, half-open
  std::uint32_t width() const { return x1 - x0; }
  std::uint32_t height() const { return y1 - y0; }
  std::size_t pixels() const { return std::size_t(width()) * height(); }
};

// The discs over which photons spread. Half-widths follow the photon's differentials: its beam's reach on a plane that
// light reaches unbent, and carried with the light to where the photon landed, within [narrowest, widest]. With
// narrowest = widest all discs are round and of that radius.
struct Discs {
  double narrowest = 0, widest = 0;  // m
  double shrink = 1;                 // of the beams' reaches
  bool round() const { return narrowest == widest; }
};

// Discs of a pass, from those of pass 0; they shrink so that the mean over the passes converges. Round ones by r_i^2 =
// r_0^2 prod_{k=1..i} (k + a) / (k + 1), a = 2/3 (Knaus and Zwicker 2011, eq. 20, from 0); the others as (i +
// 1)^(-1/4), the power at which measured errors fell fastest, but for the narrowest, which is a pixel's filter.
inline Discs pass_discs(const Discs& first, std::uint32_t pass) {
  constexpr double a = 2.0 / 3.0;
  const double i = pass;
  if (first.round()) {
    // The product in closed form: Gamma(i + 1 + a) / (Gamma(1 + a) Gamma(i + 2)).
    const double radius =
        first.narrowest * std::exp(0.5 * (std::lgamma(i + 1 + a) - std::lgamma(1 + a) - std::lgamma(i + 2)));
    return {radius, radius};
  }
  const double shrink = std::pow(i + 1, -0.25);
  return {first.narrowest, std::max(shrink * first.widest, 1.001 * first.narrowest), shrink};
}

// Where photons start: on targets and in lights' views of them, where the camera sees what they give; or, as in
// ordinary photon mapping, on the lights. Or no photons: path tracing, by the reference path alone.
enum class Integrator { targeted, ordinary, path };

// By shared::KERNEL_*.
constexpr std::array<const char*, 3> kernel_names = {"uniform", "epanechnikov", "biweight"};

// Photons that every pass starts.
struct PhotonSet {
  std::vector<shared::Beam> beams;  // in order of their first photons; none: no photons
  Discs discs;                      // of pass 0
  std::uint32_t scatterings = 0;    // diffuse ones of a photon, at the most
  bool keeps_caustics = false;      // of the global map: it has what the other maps have, too
  std::uint32_t count() const { return beams.empty() ? 0 : beams.back().first + beams.back().count; }
};

// On the device: a pass of more takes them in turns, so that memory is bounded.
constexpr std::uint32_t kPhotonsAtOnce = 1u << 20;

struct RenderSettings {
  Integrator integrator = Integrator::targeted;
  std::uint32_t seed = 0;
  std::uint32_t width = 640, height = 480;
  Crop crop{0, 0, 640, 480};
  Camera camera;
  glm::uvec4 camera_media{0};                      // dielectrics that it is inside of, as shared::medium_of
  PhotonSet caustics;                              // of the targeted and the caustic map
  PhotonSet global;                                // of the global map; their discs are round
  double footprint = 0;                            // side of a pixel on what is seen, m
  std::uint32_t kernel = shared::KERNEL_BIWEIGHT;  // by which discs spread their photons
  std::uint32_t photons = 0;                       // asked for, a pass; what they are shared out to follows
  std::uint32_t specular_bounces = 8, diffuse_bounces = 0;
  // Interreflection: shown as the global map has it, or gathered by a diffuse bounce of as many more camera paths from
  // all maps and the lights.
  bool final_gathering = false;
  // The lobes of rough outer faces are followed by as many more camera paths, too, where they reflect the scene.
  bool bounces_gloss = false;
  std::uint32_t photons_at_once = kPhotonsAtOnce;
  std::uint32_t samples = 1;  // camera paths a pixel and pass
  // Where light is reflected in part, camera paths go 0: one way, by roulette; 1: both ways at the first such surface;
  // 2: at later ones, too.
  std::uint32_t split = 0;
  // Lights that are seen in menisci, HIGHLIGHTS_*, and the cells of a pixel, along each side, in which they are; 0: not
  // asked for.
  std::uint32_t highlights = shared::HIGHLIGHTS_NONE, highlight_cells = 0;
};

// Whether paths carry the derivatives that shape photons' discs, and that lead samples to their pixels' centres.
inline bool carries_differentials(const RenderSettings& settings) {
  return !settings.caustics.discs.round() && settings.caustics.count() + settings.global.count() > 0;
}

// Radius in a pass of the finest beam's discs where light is neither focused nor spread, m.
double disc_radius(const RenderSettings& settings, std::uint32_t pass);

// Part of a pixel's side that camera rays are spread over in a pass: all of it, but that a single ray looks better
// without. Round discs of any size leave the pixel's filter to the rays from the beginning.
inline float pixel_jitter(const RenderSettings& settings, std::uint32_t pass) {
  return pass == 0 && settings.samples == 1 && !settings.caustics.discs.round() ? 0 : 1;
}

// From where a ray ends to where the pixel's centre sees the same plane, at the most, m. Where it is further, the pixel
// sees so much through a curved surface that its differentials tell nothing.
inline double most_shift(const RenderSettings& settings) { return 2 * settings.footprint; }

// Image-plane axes of a camera, scaled: a ray through (x, y) in [-1, 1]^2 has offset x right + y up. A camera without
// an aspect ratio takes the image's; one with another than the image's keeps its vertical extent.
struct CameraAxes {
  glm::dvec3 right, up, forward, origin;
};
CameraAxes camera_axes(const Camera& camera, std::uint32_t width, std::uint32_t height);

// Side of a pixel of an orthographic camera, metres; of another per metre of distance.
inline double pixel_side(const CameraAxes& axes, std::uint32_t height) { return 2 * glm::length(axes.up) / height; }

// Side of a pixel on what the middle of the image sees; on the scene's centre where it sees nothing. Metres.
double pixel_footprint(const World& world, const RenderSettings& settings);

}  // namespace meniscal
