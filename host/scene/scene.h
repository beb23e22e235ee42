// The scene as plain values in double precision: what a glTF file says, and nothing of how it will be rendered.
// Everything geometric is in metres, Y up, relative to `Scene::origin`, so that it may become float without loss.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/scene/environment.h"
#include "host/scene/texture.h"
#include "host/stages.h"
#include "meniscus/mesh.h"

namespace meniscal {

// Properties of a liquid (material extras `meniscus_*`), resolved against the named liquid's table.
struct LiquidProperties {
  std::string kind;                   // "water", ..., "custom"
  double surface_tension;             // N/m
  double density;                     // kg/m3
  bool opaque = false;                // mercury: a mirror, nothing passes
  double default_contact_angle = 30;  // degrees; of solids that state none
  double height_scale = 1, sweep_scale = 1;
  std::string profile = "sine";
  std::string height_rule = "wetting";
  bool flatten = false;
  std::optional<double> tolerance;  // of the menisci's heights, metres; none: meniscus::kHeightTolerance
};

struct Material {
  std::string name;
  glm::dvec3 base_color{1};
  double metallic = 1, roughness = 1;  // glTF's defaults
  double transmission = 0;
  double ior = 1.5;
  double specular = 1;           // KHR_materials_specular: specularFactor
  glm::dvec3 specular_color{1};  // and specularColorFactor, of what is met straight on
  bool has_thickness = false;    // KHR_materials_volume with thicknessFactor > 0
  glm::dvec3 absorption{0};      // 1/m per channel, from attenuation colour and distance
  glm::dvec3 emission{0};        // radiance, emissiveFactor * emissiveStrength
  bool double_sided = false;
  // Factors on base colour; roughness (green) and metallic (blue); emission. Liquids have none.
  std::optional<Texture> base_color_texture, metallic_roughness_texture, normal_texture, emissive_texture;
  double most_metallic = 1, most_roughness = 1;  // of the texture's texels; without one 1
  double normal_scale = 1;                       // of the normal texture's red and green
  std::optional<LiquidProperties> liquid;
  std::optional<double> contact_angle;               // degrees, with every liquid
  std::map<std::string, double> contact_angle_with;  // degrees, by the name of the liquid's material
  bool meniscus_ignore = false;
  bool target = false;  // meniscus_target
  std::optional<int> dielectric_priority;
};

inline bool has_textures(const Material& m) {
  return m.base_color_texture || m.metallic_roughness_texture || m.normal_texture || m.emissive_texture;
}

// Of a triangle's corners: sets 0 (x, y) and 1 (z, w).
using CornerCoordinates = std::array<glm::vec4, 3>;

// One primitive of one mesh node, in world space.
struct Object {
  std::string name;             // node name, else mesh name; "name/primitive" where a mesh has several
  meniscus::TriangleMesh mesh;  // normals always present: the file's, or facet normals (vertices split)
  bool has_file_normals = false;
  std::vector<CornerCoordinates> coordinates{};  // by triangle; empty where the material has no textures
  // Every edge of the whole glTF mesh (all its primitives, positions merged) is shared by two triangles.
  bool closed = false;
  int material = 0;             // index into Scene::materials
  int node = 0, primitive = 0;  // the file's: of its nodes, and of the primitives of that node's mesh
};

struct Camera {
  std::string name;
  glm::dmat4 pose{1};  // camera to world; looks along its -Z, +Y up
  bool orthographic = false;
  double yfov = 0.8, aspect = 0;  // radians; aspect 0: not given, the image decides
  double xmag = 1, ymag = 1;      // half width and height of an orthographic view, metres
  double znear = 0;
};

struct PunctualLight {
  enum class Type { directional, point, spot };
  std::string name;
  Type type = Type::point;
  glm::dvec3 position{0}, direction{0, 0, -1};  // direction: unit, the way the light travels
  glm::dvec3 intensity{1};  // directional: normal irradiance (lx); else intensity (cd); colour included
  double inner_cone = 0, outer_cone = 0.78539816339744831;  // spot half-angles, radians
  double angular_diameter = 0;                              // directional: radians, full
};

struct Scene {
  std::string file;                 // as given, for messages
  std::string hash;                 // of the file's bytes and of its buffers', hexadecimal
  glm::dvec3 origin{0};             // world position of the local origin
  double gravity = 9.80665;         // m/s2, along -Y
  std::vector<Material> materials;  // the last one is glTF's default material when an object has none
  std::vector<Object> objects;
  std::vector<Camera> cameras;  // at least one: a default camera that sees everything is made when the file has none
  std::vector<PunctualLight> lights;
  std::optional<Environment> environment;
  std::vector<std::string> warnings;  // each said once, naming the object and what was done
  Stages stages;                      // of loading it that not all scenes have
};

// Reads a glTF 2.0 scene (.gltf or .glb). Throws Error(ExitCode::scene) that names file, object, reason and remedy.
Scene load_gltf(const std::string& path);

}  // namespace meniscal
