#include "host/scene/objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/scene/geometry.h"

namespace meniscal::gltf {
namespace {

using glm::dvec3;
using meniscus::TriangleMesh;

// A liquid's flat surface that is shaded as if it were round (Blender's smooth cylinder) would refract as such.
void repair_free_surface(Object& object, Messages& messages) {
  const double angle = glm::degrees(straying_of_level_normals(object.mesh));
  if (!object.has_file_normals || angle <= 5) return;
  recompute_upward_normals(object.mesh);
  messages.warn(
      fmt::format("object \"{}\"", object.name),
      fmt::format("normals of the liquid's level surface stray from it by up to {:.1f} degrees: recomputed from "
                  "the geometry",
                  angle));
}

std::string node_name(const tinygltf::Model& model, const PlacedNode& placed) {
  const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(placed.node)];
  if (!node.name.empty()) return node.name;
  const std::string& mesh_name = model.meshes[static_cast<std::size_t>(node.mesh)].name;
  return mesh_name.empty() ? fmt::format("node {}", placed.node) : mesh_name;
}

}  // namespace

Box bounding_box(const tinygltf::Model& model, const std::vector<PlacedNode>& nodes,
                 const std::vector<MeshParts>& meshes) {
  Box box;
  for (const PlacedNode& placed : nodes) {
    const int mesh = model.nodes[static_cast<std::size_t>(placed.node)].mesh;
    if (mesh < 0) continue;
    for (const TriangleMesh& part : meshes[static_cast<std::size_t>(mesh)].parts)
      for (const glm::uvec3& t : part.triangles)
        for (int k = 0; k < 3; ++k) {
          const dvec3 p(placed.to_world * glm::dvec4(part.positions[t[k]], 1));
          box.low = glm::min(box.low, p);
          box.high = glm::max(box.high, p);
        }
  }
  return box;
}

// The centre of the box, rounded to a coarse power of two: subtracting it is then exact for most numbers, a moved scene
// gets the same local coordinates, and a level at 0 stays a number that float holds exactly.
dvec3 local_origin(const Box& box) {
  const dvec3 size = box.high - box.low, centre = 0.5 * (box.low + box.high);
  const double extent = std::max({size.x, size.y, size.z});
  const double grid = std::exp2(std::floor(std::log2(extent)) - 10);
  return glm::round(centre / grid) * grid;
}

glm::dmat4 relative_to(glm::dmat4 to_world, const dvec3& origin) {
  to_world[3] -= glm::dvec4(origin, 0);
  return to_world;
}

std::vector<Object> place_objects(const tinygltf::Model& model, const std::vector<PlacedNode>& nodes,
                                  const std::vector<MeshParts>& meshes, const dvec3& origin,
                                  std::vector<Material>& materials, Messages& messages) {
  std::vector<Object> objects;
  const std::size_t default_material = materials.size();
  for (const PlacedNode& placed : nodes) {
    const int mesh_index = model.nodes[static_cast<std::size_t>(placed.node)].mesh;
    if (mesh_index < 0) continue;
    const MeshParts& mesh = meshes[static_cast<std::size_t>(mesh_index)];
    const std::string name = node_name(model, placed);
    // Translation minus origin first: rounding then happens at the mesh's own scale, not at its distance from 0.
    const glm::dmat4 to_local = relative_to(placed.to_world, origin);
    for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
      Object object;
      object.name = mesh.parts.size() > 1 ? fmt::format("{}/{}", name, i) : name;
      object.closed = mesh.closed;
      object.material = mesh.materials[i] >= 0 ? mesh.materials[i] : static_cast<int>(default_material);
      object.node = placed.node;
      object.primitive = mesh.primitives[i];
      object.mesh = transformed(mesh.parts[i], to_local);
      object.has_file_normals = !object.mesh.normals.empty();
      drop_flat(object.mesh);  // a scale of 0 flattens
      if (object.mesh.triangles.empty()) {
        if (!mesh.parts[i].triangles.empty())
          messages.warn(fmt::format("object \"{}\"", name), "left out: its node's scale leaves no triangle an area");
        continue;
      }
      if (const std::vector<glm::vec4>& at = mesh.coordinates[i]; !at.empty())
        for (const glm::uvec3& t : object.mesh.triangles) object.coordinates.push_back({at[t.x], at[t.y], at[t.z]});
      complete_normals(object.mesh);  // numbers vertices anew, but not triangles and their corners
      if (static_cast<std::size_t>(object.material) == default_material && materials.size() == default_material)
        materials.emplace_back().name = "default";
      if (materials[static_cast<std::size_t>(object.material)].liquid) repair_free_surface(object, messages);
      objects.push_back(std::move(object));
    }
  }
  return objects;
}

}  // namespace meniscal::gltf
