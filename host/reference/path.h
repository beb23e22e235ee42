// What both kinds of path, photons and camera paths, do on their way: meet specular surfaces and sample lights.
#pragma once

#include "host/reference/differentials.h"
#include "host/reference/materials.h"
#include "shaders/shared/random.h"

namespace meniscal::reference {

// Shifts the decisions of a path by less than float can resolve: an end that such a shift changes hangs on rounding.
// See replay tests.
struct Perturbation {
  glm::dvec3 start{0};  // metres, added to where the path starts
  double roulette = 0;  // added to every random number that decides
};

// Dielectrics that a path is inside of, surfaces in the order in which it entered them.
using Media = std::vector<std::uint32_t>;

struct Path {
  Ray ray;
  std::uint32_t triangle = no_triangle;  // it starts on
  glm::dvec3 throughput{1};
  // Part of the paths that a mirror's face lets through to Lambert's surface, where this one is: it stands for the
  // others, too, which the face has reflected. What they lose by its reflection, `passed` tells.
  double let_through = 1;
  Media media{};
  glm::dvec3 absorption{0};     // of the medium it is in, 1/m
  double radiance_scale = 1;    // product of (n_beyond / n_arrival)^-2: for radiance, not for flux
  Differential differential{};  // by where it starts
  Differential by_light{};      // by the point on an extended light
};

// Media as the world's lights and the settings tell them.
Media unpack_media(const glm::uvec4& media);
// Starts in these media.
void be_in(Path& path, const World& world, Media media);
// Through a surface at which the medium that the path is in stays the same, as dielectrics lie in each other: true, and
// the path goes straight on; else it is a specular surface.
bool pass_straight(Path& path, const Hit& hit, const Tracer& tracer);

// Whether the path meets the specular part of `surface`, by roulette with `random`. A mirror's face divides the light:
// see Path::let_through; `certain`: the path takes the face's part in any case.
bool meets_specular(Path& path, const Hit& hit, const shared::Surface& surface, double random, bool certain = false);

// Sends the path on from `hit` on the specular part of `surface`: mirror, Fresnel reflection or refraction by roulette
// with `random` in [0, 1), or straight through a thin sheet. Directions bend with the shading normal; where the outcome
// is then on the wrong side of the triangle, with the geometric one. Rough surfaces bend them with a microfacet's,
// picked by `facet` in the unit square; what is then on the wrong side is lost. Returns the probability of reflection.
double scatter_specular(Path& path, const Hit& hit, const shared::Surface& surface, const Tracer& tracer, double random,
                        const glm::dvec2& facet);

// `sine` across the axis, turned by `turn` of a full circle, and `cosine` along it.
glm::dvec3 around(const glm::dvec3& axis, double sine, double cosine, double turn);

// Beer-Lambert over `distance` metres.
void absorb(Path& path, double distance);

struct LightSample {
  glm::dvec3 direction;  // from the point towards the light
  double distance;       // infinite for directional lights
  glm::dvec3
      irradiance;  // on a surface facing the light, over the sample's probability (density); 0: not emitted this way
  std::uint32_t triangle;  // of an area light
  glm::dvec3 normal;       // of an extended light: of its facet, or along its direction
  double extent = 0;    // of an extended light: root of its solid angle over this sample's probability (density), rad
  glm::uvec4 media{0};  // that the light is inside of
};

// `weight`: 1 / probability of having chosen this light. `place`: uniform in the unit square, picks the point of an
// extended light.
LightSample sample_light(const World& world, std::uint32_t light, double weight, const glm::dvec3& point,
                         const glm::dvec2& place);
// One of the lights, by the CDF that begins at `first`. `stratified`: light and point by the sequence that the start is
// of, in its third and fourth dimensions; else at random. For photons.
LightSample sample_lights(const World& world, std::uint32_t first, const glm::dvec3& point,
                          const shared::RandomKey& key, bool stratified);

// The i-th of the lights that a surface of this normal asks, of shared::LIGHTS_ASKED, if there are as many: the sum of
// their irradiances stands for all. Where there are more, each is the likelier, the more it would give the surface if
// nothing stood between; of all lights, or of shared::LIGHT_CANDIDATES picked by power (Talbot et al., "Importance
// Resampling for Global Illumination", EGSR 2005).
LightSample choose_light(const World& world, const glm::dvec3& point, const glm::dvec3& normal,
                         const shared::RandomKey& key, std::uint32_t i);

// The density, per solid angle, with which a light picked by power gives a point the direction of one on a triangle, at
// `distance` under `cosine` to the triangle's normal. 0: no light. Shares out what both shadow rays and lobes find: any
// function would do that both know.
double area_light_pdf(const World& world, std::uint32_t triangle, const glm::dvec3& point, double distance,
                      double cosine);

// The same of a light sample. 0: a point or a direction, which no path meets by chance.
double asked_pdf(const World& world, const LightSample& light, const glm::dvec3& point);

// Whether nothing at all, specular surfaces included, stands between a point of `triangle`, seen from `side`, and the
// light sample.
bool visible(const Tracer& tracer, const glm::dvec3& point, std::uint32_t triangle, const glm::dvec3& side,
             const LightSample& light);

// The entry of cdf[first .. first + count) whose interval holds `bits`, where in the interval it falls, in [0, 1), and
// 1 / the interval's width, its probability. The rest is rounded as on the GPU: further picks hang on its last bits.
struct Picked {
  std::uint32_t index;
  double rest, weight;
};
Picked pick(const std::vector<std::uint32_t>& cdf, std::uint32_t first, std::size_t count, std::uint32_t bits);

}  // namespace meniscal::reference
