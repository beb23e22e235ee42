#version 460
#extension GL_GOOGLE_include_directive : require
// One camera path a pixel: through specular surfaces to the first diffuse one, and the light that reaches it directly.
#include "lights.glsl"

layout(push_constant) uniform Push { CameraPush push; };
layout(set = 0, binding = BIND_OUTPUT, std430) writeonly buffer Samples { PixelSample samples[]; };

void main() {
  uint i = invocation_index();
  if (i >= push.count) return;
  uint slot = push.first + i;
  uint x = push.crop_x + slot % push.crop_width, y = push.crop_y + slot / push.crop_width;
  RandomKey random = RandomKey(push.seed, push.pass, STREAM_CAMERA, y * push.width + x);

  float px = 2.0 * (float(x) + random_unit(random, 0u)) / float(push.width) - 1.0;
  float py = 1.0 - 2.0 * (float(y) + random_unit(random, 1u)) / float(push.height);
  vec3 offset = px * push.right.xyz + py * push.up.xyz;
  bool orthographic = push.origin.w != 0.0;
  Path path = Path(orthographic ? push.origin.xyz + offset : push.origin.xyz,
                   normalize(orthographic ? push.forward.xyz : push.forward.xyz + offset), NO_TRIANGLE, vec3(1.0), vec3(0.0), 1.0);

  PixelSample s = PixelSample(vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0), END_CUT, vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0), 0.0,
                              vec3(0.0), 0.0, vec3(0.0), 0.0);
  for (uint bounce = 0u; bounce <= push.specular_bounces; ++bounce) {
    Hit hit = intersect(path.origin, path.direction, FAR, path.triangle, false);
    if (hit.triangle == NO_TRIANGLE) {
      s.triangle = END_ESCAPED;
      break;
    }
    absorb(path, hit.t);
    uint triangle = hit.triangle;
    Surface surface = surfaces[triangle_material(triangle)];
    vec3 point = triangle_point(triangle, hit.u, hit.v);
    vec3 shading = shading_normal(triangle, hit.u, hit.v);
    vec3 normal = geometric_normal(triangle);
    bool front = dot(normal, path.direction) < 0.0;
    if (bounce == 0u) {
      s.depth = hit.t;
      s.meniscus = float(triangle_meniscus(triangle));
    }
    if (front || surface.double_sided != 0u) s.emitted += path.throughput * path.radiance_scale * surface.emission;
    uint dimension = DIM_FIRST_BOUNCE + BOUNCE_DIMENSIONS * bounce;
    if (random_unit(random, dimension) >= surface.specular) {
      vec3 side = front ? normal : -normal;
      s.position = point;
      s.normal = side;
      s.albedo = surface.albedo;
      s.triangle = triangle;
      s.weight = path.throughput * path.radiance_scale * surface.albedo * 0.318309886183791;
      if (push.light_count > 0u) {
        LightSample light = sample_light(point, push.light_first, push.light_count, random);
        vec3 bent = front ? shading : -shading;
        float cosine = dot(light.direction, bent);
        if (cosine > 0.0 && dot(light.direction, side) > 0.0 && any(greaterThan(light.irradiance, vec3(0.0))) &&
            visible(point, triangle, side, light)) {
          s.direct = light.irradiance * cosine;
        }
      }
      break;
    }
    scatter_specular(path, point, triangle, shading, surface, random_unit(random, dimension + 1u));
  }
  samples[slot - push.buffer_first] = s;
  atomicAdd(counters[COUNTER_RAYS], rays_traced);
}
