#version 460
#extension GL_GOOGLE_include_directive : require
// Highlights: mean radiance, over each of a list of pixels, of the lights that it sees at once in menisci, directly or through other
// surfaces. Each of the pixel's cells sends one ray; its derivatives tell which part of the cell sees which part of a light, so that a
// highlight that is thinner than a cell is seen as bright as it is.
#include "lights.glsl"
#include "camera.glsl"
#include "lens.glsl"
#include "shared/branches.h"

layout(push_constant) uniform Push { HighlightPush push; };
layout(set = 0, binding = BIND_LISTED, std430) readonly buffer Listed { uint listed[]; };  // pixels of the crop
layout(set = 0, binding = BIND_HIGHLIGHTS, std430) buffer Highlights { vec4 highlights[]; };

// Mean radiance of the lights that the cell sees from where the path leaves a meniscus.
vec3 shine(Path path, vec2 place, vec3 side) {
  vec3 sum = vec3(0.0);
  for (uint i = 0u; i < push.light_count; ++i) {
    Light light = fetch_light(i);
    Shining s = NO_SHINING;
    if (light.type == LIGHT_ENVIRONMENT) continue;
    if (HAS_AREA && light.type == LIGHT_AREA) {
      if (HIGHLIGHTS == HIGHLIGHTS_ALL) s = see_area(path, place, light);
    } else {
      s = see_disc(path, place, light, i);
    }
    if (all(equal(s.radiance, vec3(0.0))) || dot(s.direction, side) <= 0.0) continue;
    if (intersect(path.origin, s.direction, s.reach, path.triangle, true).triangle != NO_TRIANGLE) continue;
    if (HAS_ABSORPTION && s.distance < FAR) s.radiance *= exp(-path.absorption * s.distance);
    sum += s.radiance;
  }
  return path.throughput * path.radiance_scale * sum;
}

// The same from a camera ray on: through all it meets.
vec3 cell_highlight(Path path, vec2 place) {
  vec3 sum = vec3(0.0);
  for (uint met = 0u; met <= push.specular_bounces;) {
    Hit hit = intersect(path.origin, path.direction, FAR, path.triangle, false);
    if (hit.triangle == NO_TRIANGLE) break;
    absorb(path, hit.t);
    SurfacePoint point = surface_point(hit.triangle, hit.u, hit.v);
    transfer(path.differential, path.direction, hit.t, point.geometric);
    Surface surface = shade(point);
    Crossing crossing;
    if (HAS_NESTED) {
      crossing = cross_surface(path.media, point.material, surface, dot(point.geometric, path.direction) < 0.0);
      if (passes_straight(crossing, surface)) {
        pass_straight(path, point, crossing.beyond);
        continue;
      }
    }
    if (!shows_highlights(surface) || met == push.specular_bounces) break;
    met += 1u;
    if (surface.kind == SPECULAR_MIRROR) meets_specular(path, point, surface, 0.0, true);
    else path.throughput *= surface.specular;
    Path arrived = path;
    float reflectance = 1.0;
    // First through, where any light goes, then reflected, where only some is.
    for (uint way = WAY_THROUGH; way <= WAY_REFLECTED; ++way) {
      Path next = arrived;
      float part = scatter_specular(next, point, surface, crossing, way_number(way, 0.0), vec2(0.0));
      if (way == WAY_THROUGH) {
        reflectance = part;
        if (reflectance < 1.0) next.throughput *= 1.0 - reflectance;
        path = next;
      } else {
        next.throughput *= reflectance;
      }
      if (point.meniscus == 0u) break;
      vec3 side = dot(point.geometric, next.direction) > 0.0 ? point.geometric : -point.geometric;
      sum += shine(next, place, side);
      if (reflectance == 0.0 || reflectance >= 1.0) break;
    }
  }
  return sum;
}

void main() {
  uint invocation = invocation_index();
  if (invocation >= push.count) return;
  uint item = push.first + invocation, pixel = listed[item];
  uvec4 crop = FETCH(view, 4u);
  uint x = crop.z + pixel % FETCH(view, 5u).x, y = crop.w + pixel / FETCH(view, 5u).x;
  RandomKey key = RandomKey(push.seed, push.pass, STREAM_HIGHLIGHTS, y * crop.x + x);
  float side = 1.0 / float(push.cells);
  uint cells = push.cells * push.cells;
  vec3 sum = vec3(0.0);
  for (uint i = push.first_cell; i < min(push.first_cell + HIGHLIGHT_ROUND, cells); ++i) {
    vec2 place = cell_place(key, i);
    Path path = camera_path(vec2(x, y) + side * (vec2(i % push.cells, i / push.cells) + place));
    path.differential.place0 *= side;
    path.differential.place1 *= side;
    path.differential.direction0 *= side;
    path.differential.direction1 *= side;
    sum += cell_highlight(path, place);
  }
  vec3 before = push.first_cell == 0u ? vec3(0.0) : highlights[item].xyz;
  highlights[item] = vec4(before + sum / float(cells), 0.0);
  atomicAdd(counters[COUNTER_RAYS], rays_traced);
}
