#include "host/export/liquids.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "host/export/liquid_material.h"
#include "host/scene/geometry.h"
#include "host/scene/objects.h"
#include "host/scene/placement.h"

namespace meniscal::gltf {
namespace {

using glm::dvec3;
using meniscus::TriangleMesh;

Box box_of(const TriangleMesh& mesh) {
  Box box;
  for (const dvec3& p : mesh.positions) box.low = glm::min(box.low, p), box.high = glm::max(box.high, p);
  return box;
}

// Where the mesh's own coordinates had better begin: 0 unless that is farther away than the mesh is large.
dvec3 own_origin(const TriangleMesh& mesh) {
  const Box box = box_of(mesh);
  const dvec3 centre = 0.5 * (box.low + box.high);
  return glm::length(centre) > glm::length(box.high - box.low) ? local_origin(box) : dvec3(0);
}

// The materials of one liquid, made at first need.
class Materials {
 public:
  Materials(Document& document, const Scene& scene, Messages& messages)
      : document_(document), scene_(scene), messages_(messages) {}

  std::size_t level(int material, double thickness) {
    if (!meniscus_of_.contains(material)) {
      const Material& meaning = scene_.materials[static_cast<std::size_t>(material)];
      OrderedJson& own = document_.json["materials"][static_cast<std::size_t>(material)];
      own = spell_out_liquid(own, meaning, thickness, document_, messages_);
      forget_contact_angles(document_, meaning.name);
      meniscus_of_[material] = 0;
    }
    return static_cast<std::size_t>(material);
  }

  std::size_t meniscus(int material, double thickness) {
    OrderedJson& all = document_.json["materials"];
    OrderedJson own = all[level(material, thickness)];
    std::size_t& index = meniscus_of_[material];
    if (index == 0) {
      own["name"] = scene_.materials[static_cast<std::size_t>(material)].name + " meniscus";
      own["extras"]["meniscus_target"] = 1;
      index = all.size();
      all.push_back(std::move(own));
    }
    return index;
  }

 private:
  Document& document_;
  const Scene& scene_;
  Messages& messages_;
  std::map<int, std::size_t> meniscus_of_;  // 0: not made yet
};

std::size_t add_mesh(Document& document, const std::string& name, const TriangleMesh& mesh,
                     const std::vector<std::uint8_t>& meniscus, int material, double thickness, Materials& materials) {
  const OrderedJson attributes = {{"POSITION", add_positions(document, mesh.positions)},
                                  {"NORMAL", add_normals(document, mesh.normals)}};
  OrderedJson primitives = OrderedJson::array();
  for (const bool raised : {false, true}) {
    std::vector<glm::uvec3> triangles;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      if ((meniscus[t] != 0) == raised) triangles.push_back(mesh.triangles[t]);
    if (triangles.empty()) continue;
    const std::size_t own = raised ? materials.meniscus(material, thickness) : materials.level(material, thickness);
    primitives.push_back(
        {{"attributes", attributes}, {"indices", add_indices(document, triangles)}, {"material", own}});
  }
  document.json["meshes"].push_back({{"name", name}, {"primitives", primitives}});
  return document.json["meshes"].size() - 1;
}

// Takes primitives out of what a node shows; other nodes may show the same mesh and keep it. Returns whether any is
// left.
bool remove_primitives(Document& document, OrderedJson& node, std::vector<int> primitives) {
  OrderedJson mesh = document.json["meshes"][node["mesh"].get<std::size_t>()];
  std::sort(primitives.rbegin(), primitives.rend());
  for (const int p : primitives) mesh["primitives"].erase(static_cast<std::size_t>(p));
  if (mesh["primitives"].empty()) {
    for (const char* key : {"mesh", "skin", "weights"}) node.erase(key);
    return false;
  }
  document.json["meshes"].push_back(std::move(mesh));
  node["mesh"] = document.json["meshes"].size() - 1;
  return true;
}

glm::dmat4 place_of(const std::vector<PlacedNode>& nodes, int node) {
  return std::find_if(nodes.begin(), nodes.end(), [&](const PlacedNode& n) { return n.node == node; })->to_world;
}

// Is its inverse none, or made of rounding? By the volume that a cube keeps, against its edges'.
bool flattens(const glm::dmat4& m) {
  constexpr double kRounding = 1e-12;
  const dvec3 x(m[0]), y(m[1]), z(m[2]);
  return !(std::abs(glm::dot(x, glm::cross(y, z))) > kRounding * glm::length(x) * glm::length(y) * glm::length(z));
}

}  // namespace

void replace_liquids(Document& document, const Source& source, const Scene& scene,
                     const std::vector<LiquidSurface>& liquids, Messages& messages) {
  const std::vector<PlacedNode> placed = place_nodes(source.model, messages);
  std::map<int, std::vector<int>> removed;  // primitives, by node
  for (const LiquidSurface& liquid : liquids)
    removed[scene.objects[liquid.object].node].push_back(scene.objects[liquid.object].primitive);
  OrderedJson& nodes = document.json["nodes"];
  std::map<int, bool> free;  // nodes that show nothing any more
  for (const auto& [node, primitives] : removed)
    free[node] = !remove_primitives(document, nodes[static_cast<std::size_t>(node)], primitives);

  Materials materials(document, scene, messages);
  for (const LiquidSurface& liquid : liquids) {
    const Object& object = scene.objects[liquid.object];
    if (liquid.surface.mesh.triangles.empty()) continue;  // it lay within solids
    const glm::dmat4 to_scene = relative_to(place_of(placed, object.node), scene.origin);
    if (flattens(to_scene))
      messages.fail("object \"" + object.name + "\"", "a scale of 0 flattens its node, which cannot hold menisci then",
                    "give the node and those above it scales other than 0, or apply them to the mesh");
    TriangleMesh mesh = transformed(liquid.surface.mesh, glm::inverse(to_scene));
    const dvec3 origin = own_origin(mesh);
    for (dvec3& p : mesh.positions) p -= origin;
    const Box box = box_of(mesh);
    const double thickness = std::max(box.high.y - box.low.y, 1e-3);
    const std::size_t index =
        add_mesh(document, object.name, mesh, liquid.surface.meniscus, object.material, thickness, materials);
    std::size_t node = static_cast<std::size_t>(object.node);
    if (origin != dvec3(0) || !free[object.node]) {
      nodes.push_back({{"name", object.name + " surface"}, {"translation", {origin.x, origin.y, origin.z}}});
      nodes[node]["children"].push_back(nodes.size() - 1);
      node = nodes.size() - 1;
    } else {
      free[object.node] = false;
    }
    nodes[node]["mesh"] = index;
  }
}

}  // namespace meniscal::gltf
