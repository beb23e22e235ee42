// Everything that CPU and GPU both see: buffer records, push constants, bindings. Written once; layouts are checked by
// a test.
#ifndef MENISCAL_STRUCTS_H
#define MENISCAL_STRUCTS_H
#include "dialect.h"

SHARED_BEGIN

// What a surface does to light that is not scattered diffusely.
const uint SPECULAR_NONE = 0u, SPECULAR_MIRROR = 1u, SPECULAR_DIELECTRIC = 2u, SPECULAR_THIN = 3u;

struct Surface {
  vec3 albedo;        // of the diffuse part
  float specular;     // probability that a path meets the specular part: 0 diffuse, 1 glass, water or metal; mirrors with
                      // an albedo: see mirror_probability
  vec3 tint;          // factor on what the specular part transmits
  float ior;          // inside (behind the geometric normal) against outside
  vec3 absorption;    // 1/m, inside
  uint kind;          // SPECULAR_*
  vec3 emission;      // radiance
  uint double_sided;  // emits on both sides
  uint rank;          // dielectrics: above 0; where volumes overlap, the higher wins
  uint liquid;        // dielectrics: 1 where it may be an open sheet with the liquid below
  float alpha;        // of GGX: roughness squared; 0: smooth
  uint textures;      // index + 1 of what textures say of it; 0: the same all over
  vec3 f0;            // reflectance of its outer face straight on, where that is no dielectric's (kind)
  float f90;          // and grazing
};

// Dielectrics that something is inside of, as uvec4: those of higher rank first, of one rank the one entered last; then
// zeros. Each is its rank and its surface's index + 1.
const uint MEDIUM_SURFACE_BITS = 20u, MEDIUM_SURFACE_MASK = 0xFFFFFu;
SHARED uint medium_of(uint rank, uint surface) { return (rank << MEDIUM_SURFACE_BITS) | (surface + 1u); }

const uint LIGHT_DIRECTIONAL = 0u, LIGHT_POINT = 1u, LIGHT_SPOT = 2u, LIGHT_AREA = 3u,
           LIGHT_ENVIRONMENT = 4u;

struct Light {
  vec3 position;      // area: first corner
  uint type;          // LIGHT_*
  vec3 direction;     // unit, the way the light travels; area: the emitting side's normal
  float probability;  // of choosing this light
  vec3 intensity;     // directional: radiance times solid angle (a parallel one's irradiance); point and spot: intensity;
                      // area: radiance
  uint double_sided;  // area: emits on both sides
  vec3 edge1;         // area: the corners are position, position + edge1, position + edge2
  float area;         // area: m2
  vec3 edge2;
  uint triangle;  // area: index of the emitting triangle
  // Spot, as in KHR_lights_punctual: falloff clamp((cone_versine - v) cone_scale)^2, v = 1 - cosine from the axis (a
  // versine keeps the digits that a cosine near 1 loses). Directional: cone_versine of its disc; 0: it is parallel.
  float cone_scale, cone_versine;
  float pad0, pad1;
  uvec4 media;  // that it is inside of
};

// A path's end where it is no triangle.
const uint END_DROPPED = 0xFFFFFFF0u;  // met no target, or was scattered diffusely by it at once
const uint END_BLOCKED = 0xFFFFFFF1u;  // light sample not visible, or not emitting this way
const uint END_ESCAPED = 0xFFFFFFF2u;  // left the scene
const uint END_CUT = 0xFFFFFFF3u;      // more specular events than asked for
const uint END_ABSORBED = 0xFFFFFFF4u; // met a diffuse surface that scatters nothing
const uint END_FIRST = 0xFFFFFFF0u;    // ends at and above this are no triangles

// Which map a photon belongs to. One that has not been scattered diffusely: by the first surface it meets, a meniscus
// or another specular one. One that has: to the global map.
const uint MAP_TARGETED = 0u, MAP_CAUSTIC = 1u, MAP_GLOBAL = 2u, MAPS = 3u;

// Where photons start: on targets, in a distant light's view of them, or (ordinary photon mapping) on the lights.
const uint START_ON_TARGETS = 0u, START_IN_VIEW = 1u, START_ON_LIGHTS = 2u;

// Photons that start alike: in a window of the square of starts, [0, 1)^2. The square is a distant light's view of all
// targets, or (across: the CDF of a stratum's triangles; up: place on the triangle) the targets themselves. Windows lie
// in each other; a start's weight is that of its window less that of the finer one within, so that together they sum to
// 1 everywhere and cross-fade where one takes over from the other.
struct Beam {
  vec3 corner;  // of the light's view, which all that starts there goes through
  uint first;   // photon of the pass
  vec3 u;       // edges of the light's view, m
  uint count;   // photons a pass
  vec3 v;
  uint kind;            // START_*
  uvec2 start, extent;  // of the window, in units of 2^-16
  vec4 own, finer;      // windows: low x, low y, high x, high y
  vec2 own_fade, finer_fade;  // width of their borders, over which the weight rises from 0 to 1
  uint map;                   // MAP_* that it is meant for; in a light's view photons of the other come along
  uint light;                 // of the view
  uint light_first;           // where the CDF of the lights begins that light the targets
  uint target_first, target_count;  // starts on targets: their range in the tables
  float power;                      // area of the window / count, m2; starts on lights: 1 / count
  float reach;                      // half-width of discs that light reaches unbent, m
  // Photons take the starts in an order in which neighbours lie near each other, in blocks of 2^order_bits as long as
  // there are whole ones: columns of a matrix over bits that turns a place along a curve into the Sobol index there.
  uint order_bits;
  uvec4 order[5];
};

// Two streams of one slot per started photon: where it went, and what the gather reads of it, three texels of 16 bytes.
struct PhotonEnd {
  vec3 flux;       // W, or lm in photometric scenes
  uint end;        // triangle it was stored on, or END_*
  float entered;   // flux as it met its target; here and below means over the channels
  float absorbed;  // of that
  float cut;       // of that, by the limits on bounces
  uint map;        // MAP_*; of the global map's, that of the beam
};
// Its footprint where it was stored: q2 = (alpha x)^2 + (beta x)^2 of an offset x from its position is below 1 inside
// an elliptic disc of area pi / |alpha x beta|. alpha x beta points to the side of arrival.
struct PhotonDisc {
  vec3 position;
  float flux_r;  // the sign bit: MAP_CAUSTIC, not MAP_TARGETED
  vec3 alpha;    // along the wide axis, 1/m; 0: not stored
  float flux_g;
  vec3 beta;  // perpendicular to alpha
  float flux_b;
};

// What one pass says of one pixel by one path. The radiance is emitted + weight * (direct + targeted + caustic +
// global).
struct PixelSample {
  // Where the pixel's centre sees the plane of the visible point: of the first non-specular surface on the camera path.
  vec3 position;
  float depth;     // along the camera ray to the first surface of any kind; 0: none
  vec3 normal;     // geometric, at the visible point, towards the viewer
  float meniscus;  // 1 where the camera ray first meets a meniscus
  vec3 albedo;     // at the visible point
  uint triangle;   // of the visible point, or END_*
  vec3 weight;     // radiance per irradiance: throughput * albedo / pi; 0 where no visible point
  float split;     // of the camera path: see next_split in branches.h
  vec3 emitted;  // radiance that reaches the camera from light-emitting surfaces
  uint lit;      // 1: the maps' irradiances are those of the sample before, at the same place
  vec3 direct;  // irradiance from the lights
  uint highlighted;  // 1: the path met a meniscus, and lights that it saw there at once are left to the highlights' pass
  vec3 targeted;         // irradiance from the targeted map
  float targeted_count;  // photons found
  vec3 caustic;          // irradiance from the caustic map
  float caustic_count;
  vec3 global;           // irradiance from the global map
  float global_count;
};

// The same of a visible point whose outer face reflects: radiance that reaches the camera from the lights and the maps
// beyond that of PixelSample, which is Lambert's; and what it hangs on.
struct PixelGloss {
  vec3 normal;  // shading, towards the viewer
  float alpha;  // of GGX; 0: smooth
  vec3 outgoing;
  float f90;
  vec3 f0;
  float scattered;  // of bounced paths: irradiance of the first diffuse surface that they stand for per Lambert's
  vec3 throughput;
  uint reflects;  // 1: the rest counts
  vec3 direct;
  float pad0;
  vec3 targeted;
  float pad1;
  vec3 caustic;
  float pad2;
  vec3 global;
  float pad3;
};

const uint PATHS_PHOTON = 0u, PATHS_CAMERA = 1u;

struct PathPush {
  uint kind, seed, pass;            // kind: PATHS_*
  uint first, count, buffer_first;  // photons, or pixels of the crop: of invocation 0; all; the first in the buffers
  uint specular_bounces;
  uint light_count, light_first;  // of the scene; where their CDF begins
  uint sample_index, branch;      // of camera paths: which of a pixel's in the pass; BRANCH_*
  uint keeps;                     // samples that end on the triangle of the one before keep its maps' irradiances
  uint bounced;                   // of camera paths: they go on from the first diffuse surface to the next
  uint gloss_only, bounces_gloss;  // by an outer face's lobe alone; such paths there are
  // Of photons.
  uint beams, stream;       // stream: of random numbers, of the first beam
  uint scatterings;         // of the global map: diffuse ones at the most; 0: of the other maps, that end at the first
  uint keeps_caustics;      // photons of the global map: those that the other maps have, too
  uint keeps_specular;      // photons that start on lights: those that meet a specular surface first count, too
  float shrink;             // of the beams' reaches in this pass
  float narrowest, widest;  // bounds of a disc's half-widths, m; equal: all discs are round
};

// Highlights, lights that pixels see in menisci: which of the lights have them. Others are left to camera paths.
const uint HIGHLIGHTS_NONE = 0u, HIGHLIGHTS_NO_AREAS = 1u, HIGHLIGHTS_ALL = 2u;

struct HighlightPush {
  uint seed, pass;
  uint count;  // of this dispatch's pixels
  uint first;  // of its invocation 0 in the list
  uint cells;       // of a pixel, along each side
  uint first_cell;  // of this dispatch's, HIGHLIGHT_ROUND at the most
  uint light_count, specular_bounces;
};

struct CameraView {
  vec4 right, up;  // world-space axes scaled to the image plane: direction or offset = x right + y up (x, y in [-1, 1])
  vec3 forward;
  uint pad0;
  vec3 origin;
  uint orthographic;
  uint width, height, crop_x, crop_y;  // of the whole image
  uint crop_width;
  float jitter;      // part of a pixel's side that rays spread over, round its centre
  float most_shift;  // from where a ray ends to where the pixel's centre sees, m; beyond, differentials tell nothing
  uint pad1;
  uvec4 media;  // that the eye is inside of
};

struct ProbePush {
  uint mask;   // elements of the table - 1 (a power of two)
  uint count;  // invocations
};

struct GatherPush {
  float narrowest;  // of the discs' half-widths, m
  uint levels;
  uint cell_mask;        // cells of one level of the hash grid - 1 (a power of two)
  uint pixels, width;    // in the buffer; of a row
  uint first_candidate;  // candidates (photons entered in the pixel's cells) tested by earlier rounds
  uint first, count;     // of this dispatch's invocations
  float lobe_part;       // of outer faces' lobes, by which the map is reflected: 0 to 1
};

// Steps of the hash grid's making; shaders/cells.comp says what each does.
const uint CELLS_NUMBER = 0u, CELLS_ENTER = 1u, CELLS_COUNT = 2u, CELLS_MOVE = 3u, CELLS_SCAN = 4u, CELLS_ADD = 5u,
           CELLS_COLLECT = 6u;

struct CellsPush {
  uint step;        // CELLS_*
  uint count;       // elements
  uint from, to;    // where they are read and written, in the entries or (scans) in the counts; the first photon
  uint shift;       // of the digit, in bits
  uint chunks;      // of SORT_CHUNK elements
  float narrowest;  // of the discs' half-widths, m
  uint levels;
  uint cell_mask;  // cells of one level - 1 (a power of two)
};

// Sorting: by digits of SORT_BITS, each invocation taking SORT_CHUNK consecutive elements. Two digits hold all keys.
const uint SORT_BITS = 10u, SORT_BINS = 1024u, SORT_CHUNK = 2048u, SCAN_BLOCK = 128u;
// Set in what a cell lists a second time: a photon that is in two cells of the same key.
const uint LISTED_TWICE = 0x80000000u;
// By the power of their slope; see disc_kernel.
const uint KERNEL_UNIFORM = 0u, KERNEL_EPANECHNIKOV = 1u, KERNEL_BIWEIGHT = 2u;
// Levels of the hash grid, at the most.
const uint GRID_LEVELS = 8u;

// Candidates a pixel tests in one dispatch: lavapipe stops a shader's loops at about 65,535 iterations.
const uint GATHER_ROUND = 32768u;
// Cells of a pixel that look for highlights in one dispatch: the same limit holds for the sum of all loops' iterations.
const uint HIGHLIGHT_ROUND = 8u;
// Steps of one ray through the BVH; more count as an error, never pass silently.
const uint TRAVERSAL_LIMIT = 4096u;

// Counters of what must never happen or must be known.
const uint COUNTER_TRAVERSAL_LIMIT = 0u, COUNTER_MOST_CANDIDATES = 1u, COUNTER_RAYS = 2u,
           COUNTER_MEDIA_DROPPED = 3u, COUNTERS = 4u;

SHARED_END
#endif
