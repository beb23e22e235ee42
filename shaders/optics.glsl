// What happens to a path at a specular surface.
#include "media.glsl"
#include "differentials.glsl"
#include "shared/random.h"

// Unpolarised Fresnel reflectance; `cosine` > 0 on the side of arrival, `eta` = n_arrival / n_beyond. 1 at total internal reflection;
// `transmitted` is the cosine beyond.
float fresnel(float cosine, float eta, out float transmitted) {
  float sine2 = eta * eta * max(1.0 - cosine * cosine, 0.0);
  transmitted = sqrt(max(1.0 - sine2, 0.0));
  float parallel = (cosine - eta * transmitted) / (cosine + eta * transmitted);
  float perpendicular = (eta * cosine - transmitted) / (eta * cosine + transmitted);
  return sine2 >= 1.0 ? 1.0 : 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

struct Path {
  vec3 origin, direction;
  uint triangle;         // it starts on
  vec3 throughput;
  float let_through;     // part of the paths that a mirror's face lets through to Lambert's surface, where this one is: it stands for all
  vec3 absorption;       // of the medium it is in, 1/m
  uvec4 media;           // dielectrics that it is inside of, where some lie in each other
  float radiance_scale;  // product of (n_beyond / n_arrival)^-2: for camera paths, not for photons
  Differential differential;  // by where it starts
  Differential by_light;      // by the point on an extended light
};

Path start_path(vec3 origin, vec3 direction, uint triangle, vec3 throughput) {
  Differential none = Differential(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
  return Path(origin, direction, triangle, throughput, 1.0, vec3(0.0), uvec4(0u), 1.0, none, none);
}

void be_in(inout Path path, uvec4 media) {
  path.media = media;
  if (HAS_ABSORPTION) path.absorption = medium_absorption(media.x);
}

// Through a surface that is no optical event.
void pass_straight(inout Path path, SurfacePoint point, uvec4 beyond) {
  path.origin = leave(point.position, dot(path.direction, point.geometric) < 0.0 ? -point.geometric : point.geometric);
  path.triangle = point.triangle;
  be_in(path, beyond);
}

// `turned`: 1 or -1 times the shading normal bends; 0: the facet's.
void reflect_differential(inout Differential d, SurfacePoint point, float turned, vec3 arrival, vec3 normal) {
  d.direction0 = reflect_derivative(d.direction0, turned * normal_derivative(point, d.place0), arrival, normal);
  d.direction1 = reflect_derivative(d.direction1, turned * normal_derivative(point, d.place1), arrival, normal);
}
void refract_differential(inout Differential d, SurfacePoint point, float turned, vec3 arrival, vec3 normal, float eta, float beyond) {
  d.direction0 = refract_derivative(d.direction0, turned * normal_derivative(point, d.place0), arrival, normal, eta, beyond);
  d.direction1 = refract_derivative(d.direction1, turned * normal_derivative(point, d.place1), arrival, normal, eta, beyond);
}

// Whether the path meets the specular part of a surface, by roulette with `random`. A mirror's face divides the light: see
// Path; `certain`: the path takes the face's part in any case.
bool meets_specular(inout Path path, SurfacePoint point, Surface surface, float random, bool certain) {
  if (!HAS_MIRROR || surface.kind != SPECULAR_MIRROR) return random < surface.specular;
  vec3 reflectance = mirror_reflectance(surface, abs(dot(path.direction, point.shading)));
  float probability = certain ? 1.0 : mirror_probability(surface, reflectance);
  bool specular = random < probability;
  if (specular) path.throughput *= reflectance / probability;
  path.let_through = specular ? 1.0 : 1.0 - probability;
  return specular;
}

// Sends the path on from the specular part of a surface: mirror, Fresnel reflection or refraction by roulette with `random`, or straight
// through a thin sheet. Returns the probability of reflection. Directions bend with the shading normal, sides are told by the geometric
// one; where the two disagree on the outcome's side, the geometric one bends. Rough surfaces bend them with a microfacet's, picked by
// `place`; what is then on the wrong side is lost.
float scatter_specular(inout Path path, SurfacePoint point, Surface surface, Crossing crossing, float random, vec2 place) {
  vec3 arrival = path.direction;
  bool front = dot(arrival, point.geometric) < 0.0;
  vec3 side = front ? point.geometric : -point.geometric;
  float turned = dot(point.shading, side) < 0.0 ? -1.0 : 1.0;
  vec3 normal = turned * point.shading;
  if (dot(arrival, normal) >= 0.0) {
    normal = side;
    turned = 0.0;
  }

  vec3 mean = normal;  // of the microfacets
  bool rough = HAS_ROUGH && surface.alpha > 0.0;
  if (rough) normal = visible_normal(normal, -arrival, surface.alpha, place);

  bool reflected = true;
  float reflectance = 1.0;
  float eta = 1.0, transmitted = 1.0;
  if (HAS_DIELECTRIC && surface.kind == SPECULAR_DIELECTRIC) {
    eta = front ? 1.0 / surface.ior : surface.ior;
    if (HAS_NESTED) eta = medium_ior(crossing.before.x) / medium_ior(crossing.beyond.x);
    float cosine = -dot(arrival, normal);
    reflectance = fresnel(cosine, eta, transmitted);
    reflected = random < reflectance;
    if (!reflected && !rough && dot(eta * arrival + (eta * cosine - transmitted) * normal, side) >= 0.0) {
      normal = side;
      turned = 0.0;
      float slanted = dot(arrival, side), sine2 = eta * eta * max(1.0 - slanted * slanted, 0.0);
      transmitted = sqrt(max(1.0 - sine2, 0.0));
      reflected = sine2 >= 1.0;
    }
  } else if (HAS_THIN && surface.kind == SPECULAR_THIN) {
    float once = fresnel(-dot(arrival, normal), 1.0 / surface.ior, transmitted);
    reflectance = 2.0 * once / (1.0 + once);  // both faces, all orders
    reflected = random < reflectance;
  }
  if (reflected && !rough && dot(arrival - 2.0 * dot(arrival, normal) * normal, side) <= 0.0) {
    normal = side;
    turned = 0.0;
  }

  if (reflected) {
    path.direction = arrival - 2.0 * dot(arrival, normal) * normal;
    if (HAS_DIFFERENTIALS) reflect_differential(path.differential, point, turned, arrival, normal);
    if (HAS_DIFFERENTIALS && HAS_EXTENDED) reflect_differential(path.by_light, point, turned, arrival, normal);
  } else {
    path.throughput *= surface.tint;
    if (HAS_DIELECTRIC && surface.kind == SPECULAR_DIELECTRIC) {
      path.direction = eta * arrival + (-eta * dot(arrival, normal) - transmitted) * normal;
      path.radiance_scale *= eta * eta;
      path.absorption = front ? surface.absorption : vec3(0.0);
      if (HAS_DIFFERENTIALS) refract_differential(path.differential, point, turned, arrival, normal, eta, transmitted);
      if (HAS_DIFFERENTIALS && HAS_EXTENDED) refract_differential(path.by_light, point, turned, arrival, normal, eta, transmitted);
    } else if (rough) {
      // A rough sheet lets light through as it reflects it, to the other side.
      path.direction = reflect(reflect(arrival, normal), mean);
    }
  }
  vec3 beyond = reflected ? side : -side;
  if (rough) {
    float left = dot(path.direction, mean);
    bool lost = dot(path.direction, beyond) <= 0.0 || (reflected ? left <= 0.0 : left >= 0.0);
    path.throughput *= lost ? 0.0 : unhidden(abs(left), surface.alpha);
  }
  if (HAS_NESTED) be_in(path, reflected ? crossing.before : crossing.beyond);
  path.direction = normalize(path.direction);
  path.origin = leave(point.position, beyond);
  path.triangle = point.triangle;
  return reflectance;
}

// Light lost on the way from the path's origin to a hit at distance t.
void absorb(inout Path path, float t) {
  if (HAS_ABSORPTION) path.throughput *= exp(-path.absorption * t);
}
