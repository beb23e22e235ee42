// The scene's tables and the closest-hit and visibility queries on them.
#include "fetch.glsl"
#include "shared/bindings.h"
#include "shared/bvh_node.h"
#include "shared/structs.h"

FETCH_TABLE(BIND_SCENE, scene)
FETCH_TABLE(BIND_NORMALS, normals)
FETCH_TABLE(BIND_SURFACES, surfaces)
FETCH_TABLE(BIND_LIGHTS, lights)
FETCH_TABLE(BIND_CDF, cdf)
FETCH_TABLE(BIND_TARGETS, targets)
layout(set = 0, binding = BIND_COUNTERS, std430) buffer Counters { uint counters[]; };

// What the plan says of the scene: dead code goes at pipeline creation.
layout(constant_id = 0) const uint TRIANGLE_BASE = 0u;  // records of the table that are nodes
layout(constant_id = 1) const bool HAS_LOCAL = true;    // point or spot lights
layout(constant_id = 2) const bool HAS_AREA = true;
layout(constant_id = 3) const bool HAS_MIRROR = true;
layout(constant_id = 4) const bool HAS_DIELECTRIC = true;
layout(constant_id = 5) const bool HAS_THIN = true;
layout(constant_id = 6) const bool HAS_ABSORPTION = true;
layout(constant_id = 7) const float SCENE_RADIUS = 1.0;
layout(constant_id = 8) const bool HAS_DIFFERENTIALS = true;  // paths carry the derivatives that shape photons' discs
layout(constant_id = 9) const bool HAS_EMISSION = true;  // photons start on the lights
layout(constant_id = 10) const bool HAS_SCATTERING = true;  // paths go on from diffuse surfaces
layout(constant_id = 11) const bool HAS_NESTED = true;  // dielectrics lie in each other
layout(constant_id = 12) const bool HAS_GLOSS = true;   // an outer face above a diffuse surface reflects
layout(constant_id = 13) const bool HAS_ROUGH = true;   // rough specular surfaces
layout(constant_id = 14) const uint HIGHLIGHTS = 2u;    // HIGHLIGHTS_*
layout(constant_id = 15) const uint SUNS = 1u;  // directional lights with an angular diameter: the first of the lights
layout(constant_id = 16) const uint ENVIRONMENT_COLUMNS = 1u;  // of the image of all directions; 0: none. Its light is the next
layout(constant_id = 17) const uint ENVIRONMENT_ROWS = 1u;
layout(constant_id = 18) const uint ENVIRONMENT_FIRST = 0u;  // where the CDF of its rows begins; each row's own follow
layout(constant_id = 19) const float ENVIRONMENT_TURN = 0.0;  // about +Y, of a full circle

layout(constant_id = 21) const bool HAS_DIRECTIONAL = true;

const bool HAS_SUNS = SUNS > 0u;
const bool HAS_ENVIRONMENT = ENVIRONMENT_COLUMNS > 0u;
const bool HAS_EXTENDED = HAS_AREA || HAS_SUNS || HAS_ENVIRONMENT;  // lights that show a point more than one direction

Surface fetch_surface(uint i) {
  uint t = 6u * i;
  uvec4 a = FETCH(surfaces, t), b = FETCH(surfaces, t + 1u), c = FETCH(surfaces, t + 2u), d = FETCH(surfaces, t + 3u);
  uvec4 e = FETCH(surfaces, t + 4u), f = FETCH(surfaces, t + 5u);
  return Surface(uintBitsToFloat(a.xyz), uintBitsToFloat(a.w), uintBitsToFloat(b.xyz), uintBitsToFloat(b.w), uintBitsToFloat(c.xyz), c.w,
                 uintBitsToFloat(d.xyz), d.w, e.x, e.y, uintBitsToFloat(e.z), e.w, uintBitsToFloat(f.xyz), uintBitsToFloat(f.w));
}

Light fetch_light(uint i) {
  uvec4 a = FETCH(lights, 7u * i), b = FETCH(lights, 7u * i + 1u), c = FETCH(lights, 7u * i + 2u);
  uvec4 d = FETCH(lights, 7u * i + 3u), e = FETCH(lights, 7u * i + 4u), f = FETCH(lights, 7u * i + 5u);
  return Light(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), uintBitsToFloat(b.w), uintBitsToFloat(c.xyz), c.w,
               uintBitsToFloat(d.xyz), uintBitsToFloat(d.w), uintBitsToFloat(e.xyz), e.w, uintBitsToFloat(f.x), uintBitsToFloat(f.y),
               0.0, 0.0, HAS_NESTED ? FETCH(lights, 7u * i + 6u) : uvec4(0u));
}

// The i-th of numbers packed by four.
uint unpack(uvec4 four, uint i) {
  uvec2 two = (i & 2u) == 0u ? four.xy : four.zw;
  return (i & 1u) == 0u ? two.x : two.y;
}
uint fetch_cdf(uint i) { return unpack(FETCH(cdf, i >> 2u), i); }
uint fetch_target(uint i) { return unpack(FETCH(targets, i >> 2u), i); }

const uint NO_TRIANGLE = 0xFFFFFFFFu;

struct Hit {
  float t;
  uint triangle;     // NO_TRIANGLE: none
  float u, v;        // barycentric weights of the second and third corner
};

const float MISS = 3.0e38;

// Slab test of a box: the entry distance, or MISS. Distances are compared as integers, which order floats alike from 0 up and keep those
// below 0 below: one instruction, where that of floats asks about NaN.
float enter_box(vec3 centre, vec3 half_size, vec3 origin, vec3 inverse, float t_max) {
  vec3 middle = (centre - origin) * inverse, reach = half_size * abs(inverse);
  ivec3 enter = floatBitsToInt(middle - reach), leave = floatBitsToInt(middle + reach);
  float near = intBitsToFloat(max(max(enter.x, enter.y), max(enter.z, 0)));
  float far = intBitsToFloat(min(min(leave.x, leave.y), min(leave.z, floatBitsToInt(t_max))));
  return near <= far * 1.000002 ? near : MISS;  // what rounding takes from boxes far away; see BvhNode for those near by
}

// A ray's own axes: seen along it, triangles that share an edge see the same two points, so none slips between them (the idea of Woop
// et al., "Watertight Ray/Triangle Intersection", JCGT 2013, with any two axes across the ray).
struct RayFrame {
  vec3 origin, across, up, along;
};

RayFrame make_frame(vec3 origin, vec3 direction) {
  vec3 across = abs(direction.x) > 0.6 ? vec3(-direction.y, direction.x, 0.0) : vec3(0.0, -direction.z, direction.y);
  return RayFrame(origin, across, cross(direction, across), direction);
}

vec3 see(RayFrame frame, vec3 corner) {
  vec3 p = corner - frame.origin;
  return vec3(dot(p, frame.across), dot(p, frame.up), dot(p, frame.along));
}

// Twice the signed area of (0, a, b); exactly the negative of the area of (0, b, a).
float edge_area(vec3 a, vec3 b) {
  precise float left = a.x * b.y, right = a.y * b.x;
  precise float area = left - right;
  return area;
}

// Keeps the hit with the triangle of these corners where it is nearer than `hit` and `asked` for.
void meet_triangle(RayFrame frame, vec3 p, vec3 q, vec3 r, uint triangle, bool asked, inout Hit hit) {
  vec3 a = see(frame, p), b = see(frame, q), c = see(frame, r);
  float wa = edge_area(b, c), wb = edge_area(c, a), wc = edge_area(a, b);
  float scale = 1.0 / (wa + wb + wc);  // infinite where seen edge-on: t is then no number or infinite, and no hit
  wa *= scale;
  wb *= scale;
  wc *= scale;
  float t = wa * a.z + wb * b.z + wc * c.z;
  if (asked && wa >= 0.0 && wb >= 0.0 && wc >= 0.0 && t > 0.0 && t < hit.t) hit = Hit(t, triangle, wb, wc);
}

uint rays_traced = 0u;  // by this invocation; added to the counter at its end

// Closest hit of origin + t direction (a unit vector) with 0 < t < t_max, leaving out triangle `skip` (the one the ray starts on).
// With any_hit the first one found. One loop over nodes and triangles alike: each turn fetches one 64-byte record and does both tests,
// since software drivers run both sides of a branch anyway. The stack is four entries in registers, whose shifting costs less than
// memory at a computed index; it forgets the oldest. What it forgot is found again from the root by the trail, with a bit for each
// level of the tree that says whether the last child there to visit was entered (Laine, "Restart Trail for Stackless BVH Traversal",
// HPG 2010).
Hit intersect(vec3 origin, vec3 direction, float t_max, uint skip, bool any_hit) {
  rays_traced += 1u;
  Hit hit = Hit(t_max, NO_TRIANGLE, 0.0, 0.0);
  RayFrame frame = make_frame(origin, direction);
  vec3 safe = mix(direction, vec3(1e-12), lessThan(abs(direction), vec3(1e-12)));
  vec3 inverse = 1.0 / safe;
  uvec4 top = uvec4(BVH_EMPTY);
  uint reference = 0u, trail = 0u, level = BVH_ROOT_LEVEL, step = 0u;
  for (; step < TRAVERSAL_LIMIT && reference != BVH_EMPTY; ++step) {
    bool leaf = (reference & BVH_LEAF) != 0u;
    uint triangle = reference & BVH_FIRST_MASK;
    uint record = 4u * (leaf ? TRIANGLE_BASE + triangle : reference);
    uvec4 bits0 = FETCH(scene, record), bits1 = FETCH(scene, record + 1u);
    uvec4 bits2 = FETCH(scene, record + 2u), bits3 = FETCH(scene, record + 3u);
    vec3 v0 = uintBitsToFloat(bits0.xyz), v1 = uintBitsToFloat(bits1.xyz), v2 = uintBitsToFloat(bits2.xyz);
    meet_triangle(frame, v0, v1, v2, triangle, leaf && triangle != skip, hit);
    float near0 = enter_box(v0, v1, origin, inverse, hit.t);
    float near1 = enter_box(v2, uintBitsToFloat(bits3.xyz), origin, inverse, hit.t);
    bool hit0 = !leaf && near0 < MISS, hit1 = !leaf && near1 < MISS;
    bool more = leaf && ((reference >> BVH_COUNT_SHIFT) & BVH_COUNT_MASK) != 0u;
    bool both = hit0 && hit1, one = hit0 != hit1;
    bool nearer_done = (trail & level) != 0u;
    // A lone box where the farther child was looked for is the nearer one's: the farther lies behind the hit by now.
    bool pop = !(both || more || one && level != (trail & (0u - trail)));
    bool push = both && !nearer_done;
    bool second = (near1 < near0) != (both && nearer_done);
    uint parent = level << 1u;
    trail = pop ? (trail & (0u - parent)) + parent : one ? trail | level : trail;
    bool restart = pop && top.x == BVH_EMPTY;
    uint popped = restart ? (trail == 0u ? BVH_EMPTY : 0u) : top.x;
    level = restart ? BVH_ROOT_LEVEL : pop ? (trail & (0u - trail)) >> 1u : leaf ? level : level >> 1u;
    // The next triangle of a leaf: one fewer left, one further on.
    uint next = leaf ? reference - (1u << BVH_COUNT_SHIFT) + 1u : second ? bits1.w : bits0.w;
    uint other = second ? bits0.w : bits1.w;
    reference = pop ? popped : next;
    top = push ? uvec4(other, top.xyz) : pop ? uvec4(top.yzw, BVH_EMPTY) : top;
    if (any_hit && hit.triangle != NO_TRIANGLE) reference = BVH_EMPTY;
  }
  if (step == TRAVERSAL_LIMIT) atomicAdd(counters[COUNTER_TRAVERSAL_LIMIT], 1u);
  return hit;
}

// A place on a triangle, with what shading and differentials ask of it.
struct SurfacePoint {
  uint triangle, material, meniscus;
  uint coordinates;          // of textures: where its three begin; 0: none
  vec2 weights;              // barycentric, of the second and third corner
  vec3 position, geometric, shading;
  vec3 ab, ac;               // edges
  vec3 normal_ab, normal_ac; // differences of the corners' shading normals along them
  float normal_length;       // of the interpolated normal before it was normalised
};

SurfacePoint surface_point(uint triangle, float u, float v) {
  uint record = 4u * (TRIANGLE_BASE + triangle);
  uvec4 a = FETCH(scene, record), b = FETCH(scene, record + 1u), d = FETCH(scene, record + 3u);
  vec3 corner = uintBitsToFloat(a.xyz);
  SurfacePoint s;
  s.triangle = triangle;
  s.material = a.w;
  s.meniscus = b.w;
  s.ab = uintBitsToFloat(b.xyz) - corner;
  s.ac = uintBitsToFloat(FETCH(scene, record + 2u).xyz) - corner;
  s.coordinates = d.w;
  s.weights = vec2(u, v);
  s.geometric = uintBitsToFloat(d.xyz);
  s.position = corner + u * s.ab + v * s.ac;
  vec3 normal = uintBitsToFloat(FETCH(normals, 3u * triangle).xyz);
  s.normal_ab = uintBitsToFloat(FETCH(normals, 3u * triangle + 1u).xyz) - normal;
  s.normal_ac = uintBitsToFloat(FETCH(normals, 3u * triangle + 2u).xyz) - normal;
  normal += u * s.normal_ab + v * s.normal_ac;
  s.normal_length = length(normal);
  s.shading = normal / s.normal_length;
  return s;
}

// Derivative of the shading normal along a direction in the triangle's plane, per metre.
vec3 normal_derivative(SurfacePoint s, vec3 place) {
  float twice_area = dot(s.geometric, cross(s.ab, s.ac));
  float u = dot(cross(s.ac, s.geometric), place) / twice_area, v = dot(cross(s.geometric, s.ab), place) / twice_area;
  vec3 sum = u * s.normal_ab + v * s.normal_ac;
  return (sum - s.shading * dot(s.shading, sum)) / s.normal_length;
}

// A start for rays that leave `point` on the side of `normal`: off the surface by some rounding errors of its coordinates.
vec3 leave(vec3 point, vec3 normal) {
  vec3 size = abs(point);
  return point + normal * (2e-7 * max(size.x, max(size.y, size.z)) + 2e-8 * SCENE_RADIUS);
}

// The entry of cdf[first .. first + count) whose interval holds `bits`, where in the interval it falls, in [0, 1), and 1 / the
// interval's width, its probability. Entries without a width are never picked.
uint pick(uint first, uint count, uint bits, out float rest, out float weight) {
  uint low = 0u, high = count - 1u;
  bits = min(bits, 0xFFFFFFFEu);
  for (uint i = 0u; i < 32u && low < high; ++i) {
    uint middle = (low + high) >> 1u;
    if (bits < fetch_cdf(first + middle)) high = middle;
    else low = middle + 1u;
  }
  uint start = low == 0u ? 0u : fetch_cdf(first + low - 1u);
  uint width = fetch_cdf(first + low) - start;
  rest = min(float(bits - start) / float(width), 0.99999994);
  weight = 4294967296.0 / float(width);
  return low;
}
