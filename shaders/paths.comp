#version 460
#extension GL_GOOGLE_include_directive : require
// Photons, from a target or a light, and camera paths: both go through specular surfaces to the first diffuse one. One kernel, since what
// they share, tracing and optics, is what a driver takes long to compile.
#include "starts.glsl"
#include "camera.glsl"
#include "shared/branches.h"
#include "shared/geometry.h"

layout(push_constant) uniform Push { PathPush push; };
layout(set = 0, binding = BIND_ENDS, std430) writeonly buffer Ends { PhotonEnd ends[]; };
layout(set = 0, binding = BIND_DISCS, std430) writeonly buffer Discs { PhotonDisc discs[]; };
layout(set = 0, binding = BIND_SAMPLES, std430) buffer Samples { PixelSample samples[]; };
layout(set = 0, binding = BIND_ARRIVALS, std430) writeonly buffer Arrivals { uint arrivals[]; };
layout(set = 0, binding = BIND_GLOSS, std430) buffer Gloss { PixelGloss glosses[]; };

float mean(vec3 colour) { return dot(colour, vec3(1.0 / 3.0)); }

float with_map(float flux, uint map) { return uintBitsToFloat(floatBitsToUint(flux) | (map == MAP_CAUSTIC ? 0x80000000u : 0u)); }

// The photon's footprint on the surface it is stored on.
void store(uint slot, Path path, float reach, vec3 position, vec3 side, uint map) {
  float light_reach = 0.0;
  if (HAS_EXTENDED && HAS_DIFFERENTIALS) light_reach = widen(reach, spread(path.by_light));
  vec3 alpha, beta, flux = path.throughput / path.let_through;
  make_disc(path.differential, push.shrink * reach, path.by_light, push.shrink * light_reach, side, push.narrowest, push.widest, alpha, beta);
  discs[slot] = PhotonDisc(position, with_map(flux.x, map), alpha, flux.y, beta, flux.z);
  if (HAS_GLOSS) arrivals[slot] = pack_direction(path.direction);
}

PixelGloss no_gloss() {
  return PixelGloss(vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0), 1.0, vec3(0.0), 0u, vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0),
                    0.0);
}

// Of a light that a camera path meets, the part that is its own; the surface that a bounced path has left asks lights itself, with this
// density.
float seen_part(Scattering bounce, bool straight, float asked_pdf) {
  if (push.bounced == 0u) return 1.0;
  return HAS_GLOSS && straight && bounce.by_lobe ? balance(bounce.pdf, asked_pdf) : 0.0;
}

// Whether the path meets the specular part of a surface; where a mirror's face divides a camera path's light (`divides`), it takes its
// `way`: see branches.h.
bool meets_its_part(inout Path path, SurfacePoint point, Surface surface, float random, bool certain, bool divides, uint way,
                    inout PixelSample s) {
  if (HAS_MIRROR && divides && surface.kind == SPECULAR_MIRROR) {
    float probability = mirror_probability(surface, mirror_reflectance(surface, abs(dot(path.direction, point.shading))));
    if (probability > 0.0 && probability < 1.0) {
      path.throughput *= way_weight(push.branch, s.split, way, probability);
      s.split = next_split(push.branch, s.split, way);
      if (way == WAY_REFLECTED) s.emitted = vec3(0.0);
      random = way_number(way, random);
    }
  }
  return meets_specular(path, point, surface, random, certain);
}

void main() {
  uint invocation = invocation_index();
  if (invocation >= push.count) return;
  uint item = push.first + invocation, slot = item - push.buffer_first;
  bool camera = push.kind == PATHS_CAMERA;

  RandomKey random;
  Path path;
  SurfacePoint point;
  uint end = END_CUT;
  bool asking = false;          // the light, with a shadow ray, before all else
  uint light_first = push.light_first;
  Beam beam;                    // of a photon
  float power;
  uint map = MAP_TARGETED;
  PixelSample s;                // of a camera path
  PixelGloss gloss;             // the same where an outer face reflects
  vec2 inside;                  // place in its pixel
  if (camera) {
    uvec4 crop = FETCH(view, 4u), rest = FETCH(view, 5u);
    uint x = crop.z + item % rest.x, y = crop.w + item / rest.x;
    random = RandomKey(push.seed, push.pass, STREAM_CAMERA, y * crop.x + x);
    inside = 0.5 + uintBitsToFloat(rest.y) * (pixel_place(random, push.sample_index) - 0.5);
    random.stream += push.sample_index;
    path = camera_path(vec2(x, y) + inside);
    s = PixelSample(vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0), END_CUT, vec3(0.0), 0.0, vec3(0.0), 0u, vec3(0.0), 0u, vec3(0.0), 0.0,
                    vec3(0.0), 0.0, vec3(0.0), 0.0);
    gloss = no_gloss();
  } else {
    uint b = 0u;
    while (b + 1u < push.beams && item >= FETCH(beams, BEAM_TEXELS * (b + 1u)).w) b += 1u;
    beam = fetch_beam(b);
    random = RandomKey(push.seed, push.pass, push.stream + b, start_index(b, item - beam.first, beam.count, beam.order_bits));
    discs[slot].alpha = vec3(0.0);
    uvec2 start = start_bits(random, beam.start, beam.extent);
    vec2 place = vec2(unit_float(start.x), unit_float(start.y));
    power = beam.power * (window_weight(place, beam.own, beam.own_fade) - window_weight(place, beam.finer, beam.finer_fade));
    map = beam.map;
    light_first = beam.light_first;
    if (HAS_EMISSION && beam.kind == START_ON_LIGHTS) {
      Emission e = emit(place, beam.light_first, push.light_count, random);
      path = start_path(e.origin, e.direction, e.triangle, e.flux * power);
      if (HAS_NESTED) be_in(path, e.media);
    } else if (HAS_DIRECTIONAL && beam.kind == START_IN_VIEW) {
      path = start_in_view(beam, place, power, random);
    } else {
      point = start_point(beam, start);
      asking = true;
    }
    point.position = asking ? point.position : path.origin;
    if (!asking && !(path.throughput.x + path.throughput.y + path.throughput.z > 0.0)) end = END_DROPPED;
  }
  float entered = mean(path.throughput);
  float by_roulette = 0.0, kept = 0.0, cut = 0.0;  // flux that roulettes added; that a surface it is stored on absorbs; that limits cut
  bool on_targets = asking;

  uint met = 0u;        // specular surfaces since the start, or since the last diffuse one
  uint scattered = 0u;  // diffuse surfaces so far
  bool passed = false;  // a surface that was no optical event
  uint dimension = DIM_FIRST_BOUNCE;
  Scattering bounce = Scattering(false, false, 0.0, 1.0);  // of a bounced camera path, at the first diffuse surface
  bool straight = false;                                   // it has met nothing since
  // Highlights are another pass': of a camera path that went through all it met, the lights that it sees at once in a meniscus.
  bool sees_highlights = HIGHLIGHTS != HIGHLIGHTS_NONE && camera && push.bounced == 0u, in_meniscus = false;
  Face face;                                               // of the visible point
  LightSample light;
  vec3 unshadowed;
  uint asked = 0u;  // lights
  while (end == END_CUT && met <= push.specular_bounces) {
    if (asking) {
      if (camera) {
        if (asked == min(push.light_count, LIGHTS_ASKED)) break;
        vec3 side = s.normal, normal = dot(side, point.geometric) < 0.0 ? -point.shading : point.shading;
        light = choose_light(point.position, normal, light_first, push.light_count, random, asked++);
        float cosine = dot(light.direction, normal);
        unshadowed = light.irradiance * cosine;
        // Nothing will stand between: the light is in the medium that the camera path has come through.
        if (HAS_ABSORPTION && light.distance < FAR) unshadowed *= exp(-path.absorption * light.distance);
        if (cosine <= 0.0 || dot(light.direction, side) <= 0.0 || all(equal(light.irradiance, vec3(0.0)))) continue;
        if (HAS_AREA && light.triangle == point.triangle) continue;
        path.origin = leave(point.position, side);
        path.direction = light.direction;
        path.triangle = point.triangle;
      } else {
        light = sample_lights(point.position, light_first, push.light_count, random);
        // The light's cosine is a factor on the flux: the paper's roulette has the same mean, but would undo the starts' stratification.
        float cosine = dot(light.direction, point.geometric);
        path = start_path(leave(point.position, cosine > 0.0 ? point.geometric : -point.geometric), light.direction, point.triangle,
                          light.irradiance * (abs(cosine) * power));
        if (HAS_DIFFERENTIALS) path.differential = start_differential(point.geometric, -light.direction, light.distance);
        if (HAS_DIFFERENTIALS && HAS_EXTENDED) path.by_light = light_differential(light.normal, light.extent, -light.direction);
        entered = mean(path.throughput);
        if (!(entered > 0.0) || HAS_AREA && light.triangle == point.triangle) {
          end = END_BLOCKED;
          break;
        }
      }
    }
    Hit hit = intersect(path.origin, path.direction, asking ? shadow_reach(light, point.position, path.origin) : FAR, path.triangle, asking);
    bool missed = hit.triangle == NO_TRIANGLE;
    if (asking && camera) {
      if (missed) {
        s.direct += unshadowed;
        if (HAS_GLOSS && gloss.reflects != 0u) {
          // Bounced paths meet the light, too.
          bool shared_out = push.bounces_gloss != 0u && push.bounced == 0u;
          float other = shared_out ? lobe_probability(face, s.albedo, push.gloss_only != 0u) * lobe_pdf(face, light.direction) : 0.0;
          float own = asked_pdf(light, point.position), part = own > 0.0 ? balance(own, other) : 1.0;
          gloss.direct += gloss.throughput * unshadowed * beyond_lambert(face, s.albedo, light.direction, part);
        }
      }
      continue;
    }
    if (asking) {
      asking = false;
      path.direction = -light.direction;
      if (!missed) end = END_BLOCKED;
      if (HAS_NESTED) be_in(path, light.media);
      if (HAS_ABSORPTION && (HAS_NESTED || dot(light.direction, point.geometric) < 0.0) && light.distance < FAR) {
        if (!HAS_NESTED) path.absorption = fetch_surface(point.material).absorption;
        absorb(path, light.distance);
        entered = mean(path.throughput);
      }
    } else if (missed) {
      end = met + scattered == 0u && !passed && !camera ? END_DROPPED : END_ESCAPED;
      if (camera && (HAS_SUNS || HAS_ENVIRONMENT)) {
        SkySample beyond = sky(path.direction, in_meniscus);
        s.emitted += path.throughput * path.radiance_scale * beyond.radiance * seen_part(bounce, straight, beyond.pdf);
      }
    } else {
      absorb(path, hit.t);
      if (HAS_NESTED && met + scattered == 0u && !passed) entered = mean(path.throughput);
      point = surface_point(hit.triangle, hit.u, hit.v);
      if (HAS_DIFFERENTIALS) transfer(path.differential, path.direction, hit.t, point.geometric);
      if (HAS_DIFFERENTIALS && HAS_EXTENDED) transfer(path.by_light, path.direction, hit.t, point.geometric);
    }
    if (end != END_CUT) break;

    Surface surface = shade(point);
    bool front = dot(point.geometric, path.direction) < 0.0;
    vec3 side = front ? point.geometric : -point.geometric;
    bool first = met + scattered == 0u && !passed;
    if (camera) {
      if (first) {
        s.depth = hit.t;
        s.meniscus = float(point.meniscus);
      }
      bool theirs = HIGHLIGHTS == HIGHLIGHTS_ALL && in_meniscus && light_of(point.triangle) != 0u;
      if ((front || surface.double_sided != 0u) && !theirs) {
        float asked = HAS_GLOSS && straight ? area_light_pdf(point.triangle, path.origin, hit.t, abs(dot(point.geometric, path.direction))) : 0.0;
        s.emitted += path.throughput * path.radiance_scale * surface.emission * seen_part(bounce, straight, asked);
      }
      straight = in_meniscus = false;
    } else if (first && !on_targets && map != MAP_GLOBAL) {
      // What the light sees first may be no target.
      if (surface.specular == 0.0) {
        end = END_DROPPED;
        break;
      }
      map = point.meniscus != 0u ? MAP_TARGETED : MAP_CAUSTIC;
    }
    Crossing crossing;
    if (HAS_NESTED) {
      crossing = cross_surface(path.media, point.material, surface, front);
      bool beams_have_it = !camera && first && map == MAP_GLOBAL && push.keeps_specular == 0u;
      if (passes_straight(crossing, surface) && !beams_have_it) {
        pass_straight(path, point, crossing.beyond);
        passed = true;
        continue;
      }
    }
    float choice = random_unit(random, dimension + 1u);
    vec2 facet = vec2(0.0);
    if (HAS_ROUGH) facet = vec2(random_unit(random, DIM_FIRST_FACET + dimension), random_unit(random, DIM_FIRST_FACET + dimension + 1u));
    uint way = camera && scattered == 0u ? branch_way(push.branch, s.split, choice) : WAY_BY_ROULETTE;
    // What is not reflected at a photon's first surface, direct light has.
    bool certain = !camera && first && map != MAP_GLOBAL && push.keeps_specular == 0u;
    bool specular = meets_its_part(path, point, surface, random_unit(random, dimension), certain, camera && scattered == 0u, way, s);
    dimension += BOUNCE_DIMENSIONS;
    if (specular) {
      if (HAS_SCATTERING && first && map == MAP_GLOBAL && push.keeps_specular == 0u) {
        end = END_DROPPED;  // beams towards the targets have its light
        break;
      }
      choice = way_number(way, choice);
      if (met < push.specular_bounces) {
        if (HIGHLIGHTS != HIGHLIGHTS_NONE) {
          sees_highlights = sees_highlights && shows_highlights(surface);
          in_meniscus = sees_highlights && point.meniscus != 0u;
          if (in_meniscus) s.highlighted = 1u;
        }
        float reflectance = scatter_specular(path, point, surface, crossing, choice, facet);
        if (HIGHLIGHTS != HIGHLIGHTS_NONE)
          sees_highlights = sees_highlights && (dot(path.direction, side) < 0.0 || reflectance >= 1.0);
        if (camera && scattered == 0u && reflectance > 0.0 && reflectance < 1.0) {
          path.throughput *= way_weight(push.branch, s.split, way, reflectance);
          if (way == WAY_REFLECTED) s.emitted = vec3(0.0);
          s.split = next_split(push.branch, s.split, way);
        }
      }
      met += 1u;
      continue;
    }
    if (HAS_SCATTERING && (camera ? push.bounced != 0u && scattered == 0u
                                  : (push.scatterings > 0u || push.keeps_caustics != 0u) && (!first || map == MAP_GLOBAL))) {
      uint numbers = DIM_FIRST_SCATTERING + SCATTERING_DIMENSIONS * scattered;
      // Of the global map's photons: light that is direct, or that the other maps have.
      bool theirs = !camera && scattered == 0u && (met == 0u || push.keeps_caustics == 0u);
      float stops = camera || theirs                ? 0.0
                    : scattered == push.scatterings ? 1.0
                                                    : storing_probability(surface.albedo + surface.f0);
      if (theirs && push.scatterings == 0u) {
        end = END_DROPPED;
        break;
      }
      vec3 normal = camera && dot(point.shading, side) > 0.0 ? point.shading : side;
      Path next = path;
      bounce = scatter(next, point, surface, side, normal, camera && push.gloss_only != 0u, random_unit(random, numbers + 3u),
                       vec2(random_unit(random, numbers + 1u), random_unit(random, numbers + 2u)));
      vec3 again = bounce.goes_on ? next.throughput : vec3(0.0);
      if (random_unit(random, numbers) >= stops) {
        if (stops > 0.0) by_roulette += mean(again) / (1.0 - stops) - mean(path.throughput);
        path = next;
        path.throughput = again / (1.0 - stops);
        if (!bounce.goes_on) {
          end = END_ABSORBED;
          break;
        }
        gloss.scattered = bounce.by_lobe ? 0.0 : 1.0 / bounce.passed;
        straight = true;
        scattered += 1u;
        met = 0u;
        continue;
      }
      float before = mean(path.throughput);
      path.throughput /= stops;
      by_roulette += mean(path.throughput) - before;
      kept = mean(path.throughput) - mean(again) / stops;
      if (scattered == push.scatterings) cut = mean(again) / stops;
    }
    if (camera) {
      // Discs are filters as wide as a pixel: they are gathered at its centre, however its rays are spread to smooth edges.
      vec3 shift = scattered > 0u ? vec3(0.0) : (0.5 - inside.x) * path.differential.place0 + (0.5 - inside.y) * path.differential.place1;
      float most = uintBitsToFloat(FETCH(view, 5u).z);
      s.position = point.position + (HAS_DIFFERENTIALS && dot(shift, shift) < most * most ? shift : vec3(0.0));
      s.normal = side;
      s.albedo = surface.albedo;
      s.triangle = point.triangle;
      vec3 arriving = path.throughput * (path.radiance_scale / path.let_through);
      s.weight = arriving * surface.albedo * 0.318309886183791;
      if (HAS_GLOSS && is_glossy(surface)) {
        face = make_face(surface, point, side, -path.direction);
        gloss.reflects = 1u;
        gloss.normal = face.normal, gloss.outgoing = face.outgoing;
        gloss.alpha = face.alpha, gloss.f0 = face.f0, gloss.f90 = face.f90;
        gloss.throughput = arriving;
      }
      asking = true;
    } else {
      // A photon that its target scatters diffusely at once has met no specular surface.
      end = first ? END_DROPPED : point.triangle;
      if (!first) store(slot, path, beam.reach, point.position, side, map);
    }
  }

  if (camera) {
    if (end == END_ESCAPED) s.triangle = END_ESCAPED;
    if (branch_ends_empty(push.branch, s.split)) {
      s.triangle = END_DROPPED;
      s.weight = s.emitted = vec3(0.0);
      gloss = no_gloss();
    }
    // All of a pixel's samples are gathered at its centre, so on one triangle at one place.
    s.lit = push.keeps != 0u && samples[slot].triangle == s.triangle ? 1u : 0u;
    if (s.lit != 0u) {
      s.targeted = samples[slot].targeted, s.targeted_count = samples[slot].targeted_count;
      s.caustic = samples[slot].caustic, s.caustic_count = samples[slot].caustic_count;
      s.global = samples[slot].global, s.global_count = samples[slot].global_count;
      if (HAS_GLOSS)
        gloss.targeted = glosses[slot].targeted, gloss.caustic = glosses[slot].caustic, gloss.global = glosses[slot].global;
    }
    samples[slot] = s;
    if (HAS_GLOSS) glosses[slot] = gloss;
  } else {
    float left = mean(path.throughput);
    if (end == END_CUT) cut = left;
    if (end == END_ABSORBED) kept = left;
    ends[slot] = PhotonEnd(path.throughput, end, entered, entered + by_roulette - left + kept, cut, map);
  }
  atomicAdd(counters[COUNTER_RAYS], rays_traced);
}
