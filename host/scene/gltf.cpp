// load_gltf: source -> plain values.
#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "host/scene/extras.h"
#include "host/scene/materials.h"
#include "host/scene/meshes.h"
#include "host/scene/messages.h"
#include "host/scene/objects.h"
#include "host/scene/placement.h"
#include "host/scene/scene.h"
#include "host/scene/source.h"

namespace meniscal {
namespace gltf {
namespace {

void read_scene_extras(const tinygltf::Model& model, Scene& scene, Messages& messages) {
  if (model.scenes.empty()) return;
  const auto index = static_cast<std::size_t>(std::max(model.defaultScene, 0));
  const tinygltf::Scene& source = model.scenes[index];
  const Extras extras(source.extras, label("scene", source.name, index), messages);
  scene.gravity = extras.number("gravity", {0, 1e4, true}).value_or(scene.gravity);
  warn_of_unread_extras(source.extras, Place::scene, extras.object(), messages);
}

void warn_of_misplaced_extras(const tinygltf::Model& model, const std::vector<PlacedNode>& nodes, Messages& messages) {
  for (const PlacedNode& placed : nodes) {
    const auto index = static_cast<std::size_t>(placed.node);
    const tinygltf::Node& node = model.nodes[index];
    const bool is_light = node.extensions.contains("KHR_lights_punctual");
    warn_of_unread_extras(node.extras, is_light ? Place::light : Place::elsewhere, label("node", node.name, index),
                          messages);
  }
  for (std::size_t i = 0; i < model.meshes.size(); ++i)
    warn_of_unread_extras(model.meshes[i].extras, Place::elsewhere, label("mesh", model.meshes[i].name, i), messages);
}

bool emits(const Scene& scene) {
  for (const Object& object : scene.objects)
    if (scene.materials[static_cast<std::size_t>(object.material)].emission != glm::dvec3(0)) return true;
  return !scene.lights.empty() || scene.environment;
}

Scene assemble(const Source& source, Messages& messages) {
  const tinygltf::Model& model = source.model;
  Scene scene;
  scene.environment = source.environment;
  scene.stages = source.stages;
  const std::vector<PlacedNode> nodes = place_nodes(model, messages);
  scene.materials = read_materials(model, messages, scene.stages);
  const std::vector<MeshParts> meshes = read_meshes(model, nodes, scene.materials, messages);
  const Box box = bounding_box(model, nodes, meshes);
  if (!(box.low.x <= box.high.x))
    messages.fail("scene", "has no triangles", "export at least one mesh (and check which objects are exported)");
  const double extent = glm::length(box.high - box.low);
  if (!(extent <= greatest_extent) || (extent > 0 && extent < least_extent))
    messages.fail("scene", fmt::format("is {:.3g} m across", extent),
                  fmt::format("scale it to between {:.0e} and {:.0e} m", least_extent, greatest_extent));
  scene.origin = local_origin(box);
  scene.objects = place_objects(model, nodes, meshes, scene.origin, scene.materials, messages);
  if (scene.objects.empty()) messages.fail("scene", "has no triangle with an area", "check the nodes' scales");
  scene.cameras = read_cameras(model, nodes, messages);
  if (scene.cameras.empty()) {
    scene.cameras.push_back(default_camera(box.low, box.high));
    messages.warn("scene", "has no camera: one that sees everything from above is used");
  }
  scene.lights = read_lights(model, nodes, messages);
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    Camera& camera = scene.cameras[i];
    camera.pose = relative_to(camera.pose, scene.origin);
    messages.require_near(label("camera", camera.name, i), glm::dvec3(camera.pose[3]));
  }
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    PunctualLight& light = scene.lights[i];
    light.position -= scene.origin;
    if (light.type != PunctualLight::Type::directional)
      messages.require_near(label("light", light.name, i), light.position);
  }
  read_scene_extras(model, scene, messages);
  warn_of_misplaced_extras(model, nodes, messages);
  if (!emits(scene)) messages.warn("scene", "has neither a light nor an emissive object: the image will be black");
  return scene;
}

}  // namespace

Scene make_scene(const Source& source, Messages& messages) {
  Scene scene = assemble(source, messages);
  scene.file = source.file;
  scene.hash = source.hash;
  scene.warnings = messages.warnings();
  return scene;
}

}  // namespace gltf

Scene load_gltf(const std::string& path) {
  gltf::Messages messages(path);
  try {
    return gltf::make_scene(gltf::read_source(path, messages), messages);
  } catch (const std::bad_alloc&) {
    messages.fail("scene", "needs more memory than there is", "simplify it, or use smaller images");
  }
}

}  // namespace meniscal
