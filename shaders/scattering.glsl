// What both kinds of path do at diffuse surfaces: go on, by Lambert's law or by the lobe of a rough outer face.
#include "lights.glsl"

Face make_face(Surface surface, SurfacePoint point, vec3 side, vec3 outgoing) {
  vec3 shading = dot(point.geometric, side) < 0.0 ? -point.shading : point.shading;
  return Face(dot(shading, outgoing) > 0.0 ? shading : side, outgoing, surface.alpha, surface.f0, surface.f90);
}

float lobe_probability(Face face, vec3 albedo, bool gloss_only) {
  float probability = lobe_probability(face, albedo);
  return gloss_only ? ceil(probability) : probability;
}

// How a path goes on from a diffuse surface.
struct Scattering {
  bool goes_on, by_lobe;
  float pdf;     // by the lobe: of the direction, 1/sr
  float passed;  // by Lambert's law: part of the light that the outer face lets through
};

// Sends the path on: `gloss_only`: by the lobe alone; `choice`, `place`: uniform in [0, 1) and in the unit square. `normal`: of Lambert's
// law.
Scattering scatter(inout Path path, SurfacePoint point, Surface surface, vec3 side, vec3 normal, bool gloss_only, float choice, vec2 place) {
  Scattering how = Scattering(false, false, 0.0, 1.0);
  Face face;
  float probability = 0.0;
  bool glossy = HAS_GLOSS && is_glossy(surface);
  if (glossy) {
    face = make_face(surface, point, side, -path.direction);
    probability = lobe_probability(face, surface.albedo, gloss_only);
    how.by_lobe = choice < probability;
  }
  if (gloss_only && !how.by_lobe) return how;
  vec3 direction = around(normal, sqrt(place.x), sqrt(1.0 - place.x), place.y);
  if (how.by_lobe) {
    vec3 weight;
    direction = sample_lobe(face, place, weight);
    how.pdf = probability * lobe_pdf(face, direction);
    path.throughput *= weight / probability;
  } else {
    if (glossy) how.passed = passed(face, direction);
    path.throughput *= surface.albedo * (how.passed / ((1.0 - probability) * path.let_through));
  }
  path.let_through = 1.0;
  path.direction = direction;
  path.origin = leave(point.position, side);
  path.triangle = point.triangle;
  Differential none = Differential(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
  path.differential = path.by_light = none;
  how.goes_on = dot(direction, side) > 0.0 && any(greaterThan(path.throughput, vec3(0.0)));
  return how;
}

// The part that a path has, by the density of its direction, of what it sees of a light that others have by `other`: the balance heuristic
// (Veach 1997).
float balance(float own, float other) { return own > 0.0 ? own / (own + other) : 0.0; }
