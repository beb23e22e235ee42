// The scene as it is rendered: flat tables of triangles, surfaces and lights, and where photons start. Double
// precision; the reference path reads it as it is, the GPU gets a float copy.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/bvh/bvh.h"
#include "host/scene/scene.h"
#include "host/world/environment.h"
#include "host/world/menisci.h"
#include "shaders/shared/structs.h"
#include "shaders/shared/textures.h"

namespace meniscal {

struct WorldTriangle {
  std::array<glm::dvec3, 3> corner{};  // metres, local
  std::array<glm::dvec3, 3> normal{};  // shading normals, unit, on the geometric normal's side
  glm::dvec3 geometric{0};             // unit; the outside of a volume, the front of a sheet
  double area = 0;                     // m2
  std::uint32_t material = 0;          // index into surfaces
  std::uint32_t coordinates = 0;       // index + 1 into World::coordinates; 0: none
  bool meniscus = false;               // of a meniscus that matters, or of a material with `meniscus_target`
  bool within = false;                 // of a liquid, inside a transparent solid
  std::uint32_t light = 0;             // of an area light: index + 1; else 0
};

// A rectangle, corner and edges, across a distant light and through its targets; see light_view.h.
struct LightView {
  glm::dvec3 corner, u, v;  // metres
  double area;              // m2
};

// Triangles on which photons of one map start.
struct Stratum {
  std::string name;                    // "targeted", "caustic"
  std::uint32_t map;                   // shared::MAP_*
  std::uint32_t first = 0, count = 0;  // range in World::targets and World::cdf
  double area = 0;                     // m2
};

// What a dielectric fills.
struct Volume {
  std::string name;
  std::uint32_t surface;               // index
  bool liquid;                         // below `mesh`; else inside it
  meniscus::TriangleMesh mesh, level;  // level: a liquid's, without menisci
  glm::dvec3 low, high;                // bounds
};

// What building a liquid's menisci gave, for `info` and the statistics.
struct LiquidReport {
  std::string liquid;
  std::vector<meniscus::Contact> contacts;
  std::size_t triangles = 0;  // of menisci
  meniscus::Solution solution;
};

struct World {
  std::vector<WorldTriangle> triangles;  // in BVH order: leaves refer to consecutive ones
  std::vector<std::string> material_names;
  std::vector<shared::Surface> surfaces;           // by material
  std::vector<shared::MaterialTextures> textured;  // by Surface::textures - 1; of `textures` index + 1
  std::vector<Texture> textures;
  std::vector<CornerCoordinates> coordinates;
  std::vector<shared::Light> lights;  // suns first, then the environment
  std::uint32_t suns = 0;             // directional ones with an angular diameter
  SampledEnvironment environment;
  bool extended_lights = false;                 // some show a point more than one direction
  bool glossy = false;                          // an outer face above a diffuse surface reflects
  std::vector<Stratum> strata;                  // those that have triangles
  std::vector<std::uint32_t> targets;           // triangles, by stratum
  std::vector<std::optional<LightView>> views;  // by light: photons of those that have one start there
  std::vector<std::uint32_t> cdf;               // of targets, twice of lights, of the environment, in units of 2^-32
  std::uint32_t light_first = 0;                // where the lights' part of the CDF begins
  std::uint32_t near_first = 0;                 // the same for lights without a view, the others left out
  std::vector<Volume> volumes;                  // of dielectrics
  std::string nested;  // which of them lie in each other, or what light is in one that absorbs; empty: none
  Bvh bvh;
  double radius = 0;  // of a sphere round the local origin that holds everything
  std::vector<LiquidReport> liquids;
  std::vector<std::string> warnings;
  double meniscus_seconds = 0, bvh_seconds = 0;
  Stages stages;  // of building it that not all worlds have
};

// Raises the menisci (`none`: cuts the liquid where solids pierce it, level), flattens the scene and builds the tables.
// Deterministic. Throws Error(ExitCode::scene).
World build_world(const Scene& scene, MeniscusModel model, const MeniscusTolerance& tolerance = {});

}  // namespace meniscal
