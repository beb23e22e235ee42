// What happens to a path at a specular surface.
#include "scene.glsl"
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
  vec3 absorption;       // of the medium it is in, 1/m
  float radiance_scale;  // product of (n_beyond / n_arrival)^-2: for camera paths, not for photons
};

// Sends the path on from a specular surface: mirror, Fresnel reflection or refraction by roulette with `random`, or straight through a
// thin sheet. Directions bend with the shading normal, sides are told by the geometric one; where the two disagree on the outcome's
// side, the geometric one bends.
void scatter_specular(inout Path path, vec3 point, uint triangle, vec3 shading, Surface surface, float random) {
  vec3 geometric = geometric_normal(triangle);
  bool front = dot(path.direction, geometric) < 0.0;
  vec3 side = front ? geometric : -geometric;
  vec3 normal = dot(shading, geometric) < 0.0 == front ? -shading : shading;
  if (dot(path.direction, normal) >= 0.0) normal = side;
  float cosine = -dot(path.direction, normal);

  bool reflected = true;
  vec3 direction = path.direction + 2.0 * cosine * normal;
  if (HAS_DIELECTRIC && surface.kind == SPECULAR_DIELECTRIC) {
    float eta = front ? 1.0 / surface.ior : surface.ior;
    float transmitted;
    reflected = random < fresnel(cosine, eta, transmitted);
    if (!reflected) {
      direction = eta * path.direction + (eta * cosine - transmitted) * normal;
      if (dot(direction, side) >= 0.0) {
        direction = refract(path.direction, side, eta);
        reflected = direction == vec3(0.0);
      }
    }
    if (!reflected) {
      path.throughput *= surface.tint;
      path.radiance_scale *= eta * eta;
      path.absorption = front ? surface.absorption : vec3(0.0);
    }
  } else if (HAS_THIN && surface.kind == SPECULAR_THIN) {
    float transmitted;
    float once = fresnel(cosine, 1.0 / surface.ior, transmitted);
    reflected = random < 2.0 * once / (1.0 + once);  // both faces, all orders
    if (!reflected) {
      direction = path.direction;
      path.throughput *= surface.tint;
    }
  } else {
    path.throughput *= surface.tint;
  }
  if (reflected && dot(direction, side) <= 0.0) direction = path.direction - 2.0 * dot(path.direction, side) * side;
  path.direction = normalize(direction);
  path.origin = leave(point, reflected ? side : -side);
  path.triangle = triangle;
}

// Light lost on the way from the path's origin to a hit at distance t.
void absorb(inout Path path, float t) {
  if (HAS_ABSORPTION) path.throughput *= exp(-path.absorption * t);
}
