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

  vec2 inside = 0.5 + push.jitter * (vec2(random_unit(random, 0u), random_unit(random, 1u)) - 0.5);
  float px = 2.0 * (float(x) + inside.x) / float(push.width) - 1.0;
  float py = 1.0 - 2.0 * (float(y) + inside.y) / float(push.height);
  vec3 offset = px * push.right.xyz + py * push.up.xyz;
  bool orthographic = push.origin.w != 0.0;
  vec3 forward = orthographic ? push.forward.xyz : push.forward.xyz + offset;
  Path path = start_path(orthographic ? push.origin.xyz + offset : push.origin.xyz, normalize(forward), NO_TRIANGLE, vec3(1.0));
  if (HAS_DIFFERENTIALS) {
    vec3 step0 = 2.0 / float(push.width) * push.right.xyz, step1 = -2.0 / float(push.height) * push.up.xyz;
    path.differential = camera_differential(step0, step1, path.direction, length(forward), orthographic);
  }

  PixelSample s = PixelSample(vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0), END_CUT, vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0), 0.0,
                              vec3(0.0), 0.0, vec3(0.0), 0.0);
  // The path, and behind it the shadow ray: one place that traces rays, so that the shader stays small.
  vec3 unshadowed = vec3(0.0);
  float reach = FAR;
  bool shadow = false;
  for (uint k = 0u; k <= push.specular_bounces + 1u; ++k) {
    Hit hit = intersect(path.origin, path.direction, reach, path.triangle, shadow);
    if (shadow) {
      if (hit.triangle == NO_TRIANGLE) s.direct = unshadowed;
      break;
    }
    if (hit.triangle == NO_TRIANGLE) s.triangle = END_ESCAPED;
    if (hit.triangle == NO_TRIANGLE || k > push.specular_bounces) break;
    absorb(path, hit.t);
    SurfacePoint point = surface_point(hit.triangle, hit.u, hit.v);
    if (HAS_DIFFERENTIALS) transfer(path.differential, path.direction, hit.t, point.geometric);
    Surface surface = surfaces[point.material];
    bool front = dot(point.geometric, path.direction) < 0.0;
    if (k == 0u) {
      s.depth = hit.t;
      s.meniscus = float(point.meniscus);
    }
    if (front || surface.double_sided != 0u) s.emitted += path.throughput * path.radiance_scale * surface.emission;
    uint dimension = DIM_FIRST_BOUNCE + BOUNCE_DIMENSIONS * k;
    if (random_unit(random, dimension) < surface.specular) {
      scatter_specular(path, point, surface, random_unit(random, dimension + 1u));
      continue;
    }
    vec3 side = front ? point.geometric : -point.geometric;
    // Discs are filters as wide as a pixel: they are gathered at its centre, however its rays are spread to smooth edges.
    vec3 shift = (0.5 - inside.x) * path.differential.place0 + (0.5 - inside.y) * path.differential.place1;
    s.position = point.position + (HAS_DIFFERENTIALS && dot(shift, shift) < push.most_shift * push.most_shift ? shift : vec3(0.0));
    s.normal = side;
    s.albedo = surface.albedo;
    s.triangle = point.triangle;
    s.weight = path.throughput * path.radiance_scale * surface.albedo * 0.318309886183791;
    if (push.light_count == 0u) break;
    LightSample light = sample_lights(point.position, push.light_first, push.light_count, random);
    float cosine = dot(light.direction, front ? point.shading : -point.shading);
    unshadowed = light.irradiance * cosine;
    // Nothing will stand between: the light is in the medium that the camera path has come through.
    if (HAS_ABSORPTION && light.distance < FAR) unshadowed *= exp(-path.absorption * light.distance);
    if (cosine <= 0.0 || dot(light.direction, side) <= 0.0 || all(equal(light.irradiance, vec3(0.0)))) break;
    shadow = true;
    reach = shadow_reach(light);
    path.origin = leave(point.position, side);
    path.direction = light.direction;
    path.triangle = point.triangle;
  }
  samples[slot - push.buffer_first] = s;
  atomicAdd(counters[COUNTER_RAYS], rays_traced);
}
