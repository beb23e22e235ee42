#version 460
#extension GL_GOOGLE_include_directive : require
// Closest hits of given rays: the traversal alone, for testing and measuring it.
#include "scene.glsl"

struct Ray {
  vec3 origin;
  uint skip;
  vec3 direction;
  float reach;
};
layout(push_constant) uniform Push { uint count; };
layout(set = 0, binding = BIND_OUTPUT, std430) readonly buffer Rays { Ray rays[]; };
layout(set = 0, binding = BIND_OUTPUT + 1, std430) writeonly buffer Hits { Hit hits[]; };

void main() {
  uint i = invocation_index();
  if (i >= count) return;
  Ray ray = rays[i];
  hits[i] = intersect(ray.origin, ray.direction, ray.reach, ray.skip, false);
}
