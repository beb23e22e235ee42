#include "host/scene/placement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <numbers>

#include "host/scene/extras.h"

namespace meniscal::gltf {
namespace {

using glm::dvec3;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Range positive{0, infinity, true}, not_negative{0, infinity};

std::string node_label(const tinygltf::Model& model, int index) {
  return label("node", model.nodes[static_cast<std::size_t>(index)].name, static_cast<std::size_t>(index));
}

glm::dmat4 local_transform(const tinygltf::Model& model, int index, const Messages& messages) {
  const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(index)];
  glm::dmat4 result(1);
  if (!node.matrix.empty()) {
    for (int k = 0; k < 16; ++k)
      result[k / 4][k % 4] = node.matrix[static_cast<std::size_t>(k)];  // column-major, as GLM
    if (glm::dvec4(result[0][3], result[1][3], result[2][3], result[3][3]) != glm::dvec4(0, 0, 0, 1))
      messages.fail(node_label(model, index), "has a matrix whose last row is not 0 0 0 1", "use an affine transform");
    return result;
  }
  if (!node.translation.empty())
    result = glm::translate(result, dvec3(node.translation[0], node.translation[1], node.translation[2]));
  if (!node.rotation.empty()) {
    const glm::dquat rotation(node.rotation[3], node.rotation[0], node.rotation[1],
                              node.rotation[2]);  // w first in GLM
    if (!(std::abs(glm::length(rotation) - 1) < 0.01))
      messages.fail(node_label(model, index), "has a rotation that is no unit quaternion",
                    "give [x, y, z, w] of length 1");
    result *= glm::mat4_cast(glm::normalize(rotation));  // files hold rounded quaternions
  }
  if (!node.scale.empty()) result = glm::scale(result, dvec3(node.scale[0], node.scale[1], node.scale[2]));
  return result;
}

std::vector<int> scene_roots(const tinygltf::Model& model) {
  if (!model.scenes.empty()) return model.scenes[static_cast<std::size_t>(std::max(model.defaultScene, 0))].nodes;
  std::vector<char> is_child(model.nodes.size(), 0);
  for (const tinygltf::Node& node : model.nodes)
    for (const int child : node.children) is_child[static_cast<std::size_t>(child)] = 1;
  std::vector<int> roots;
  for (std::size_t i = 0; i < model.nodes.size(); ++i)
    if (!is_child[i]) roots.push_back(static_cast<int>(i));
  return roots;
}

// Rotation and place of a node; its -Z stays where it points, whatever the scale.
glm::dmat4 rigid(const glm::dmat4& to_world, const std::string& object, const Messages& messages) {
  const dvec3 z = glm::normalize(dvec3(to_world[2]));
  const dvec3 x = glm::normalize(glm::cross(dvec3(to_world[1]), z));
  if (!std::isfinite(glm::dot(x, z))) messages.fail(object, "is scaled to nothing", "give it a scale other than 0");
  return {glm::dvec4(x, 0), glm::dvec4(glm::cross(z, x), 0), glm::dvec4(z, 0), to_world[3]};
}

PunctualLight read_light(const tinygltf::Light& source, const std::string& object, const glm::dmat4& to_world,
                         const tinygltf::Value& node_extras, Messages& messages) {
  using Type = PunctualLight::Type;
  PunctualLight light;
  light.name = source.name;
  if (source.type == "directional")
    light.type = Type::directional;
  else if (source.type == "point")
    light.type = Type::point;
  else if (source.type == "spot")
    light.type = Type::spot;
  else
    messages.fail(object, fmt::format("has the type \"{}\"", source.type), "use directional, point or spot");
  const glm::dmat4 pose = rigid(to_world, object, messages);
  light.position = dvec3(pose[3]);
  light.direction = -dvec3(pose[2]);
  light.intensity = dvec3(messages.in_range(object, "intensity", source.intensity, light_range));
  for (int k = 0; k < 3 && !source.color.empty(); ++k)
    light.intensity[k] *= messages.in_range(object, "color", source.color[static_cast<std::size_t>(k)], color_range);
  if (source.range > 0)
    messages.warn(object, "range is ignored: light falls off with the square of the distance alone");
  if (light.type == Type::spot) {
    constexpr double quarter = std::numbers::pi / 2;
    light.outer_cone =
        messages.in_range(object, "outerConeAngle", source.spot.outerConeAngle, {0, quarter + 1e-6, true});
    light.inner_cone = messages.in_range(object, "innerConeAngle", source.spot.innerConeAngle, {0, light.outer_cone});
  }
  // Blender writes the properties of the lamp with the light, those of its object with the node.
  const bool on_light = source.extras.Has("angular_diameter");
  const Extras extras(on_light ? source.extras : node_extras, object, messages);
  light.angular_diameter = glm::radians(extras.number("angular_diameter", {0, 180}).value_or(0));
  if (light.angular_diameter > 0 && light.type != Type::directional)
    messages.warn(object, "angular_diameter is ignored: only a directional light has one");
  warn_of_unread_extras(source.extras, Place::light, object, messages);
  return light;
}

}  // namespace

std::vector<PlacedNode> place_nodes(const tinygltf::Model& model, const Messages& messages) {
  std::vector<PlacedNode> placed, open;
  const std::vector<int> roots = scene_roots(model);
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) open.push_back({*root, glm::dmat4(1)});
  while (!open.empty()) {  // no recursion: hierarchies may be as deep as the file has nodes
    PlacedNode next = open.back();
    open.pop_back();
    next.to_world = next.to_world * local_transform(model, next.node, messages);
    const std::vector<int>& children = model.nodes[static_cast<std::size_t>(next.node)].children;
    for (auto child = children.rbegin(); child != children.rend(); ++child) open.push_back({*child, next.to_world});
    placed.push_back(next);
  }
  return placed;
}

std::vector<Camera> read_cameras(const tinygltf::Model& model, const std::vector<PlacedNode>& nodes,
                                 const Messages& messages) {
  std::vector<Camera> cameras;
  for (const PlacedNode& placed : nodes) {
    const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(placed.node)];
    if (node.camera < 0) continue;
    const tinygltf::Camera& source = model.cameras[static_cast<std::size_t>(node.camera)];
    const std::string object = label("camera", source.name, static_cast<std::size_t>(node.camera));
    Camera camera;
    camera.name = node.name.empty() ? source.name : node.name;
    camera.pose = rigid(placed.to_world, object, messages);
    camera.orthographic = source.type == "orthographic";
    if (camera.orthographic) {
      camera.xmag = messages.in_range(object, "xmag", source.orthographic.xmag, positive);
      camera.ymag = messages.in_range(object, "ymag", source.orthographic.ymag, positive);
      camera.znear = messages.in_range(object, "znear", source.orthographic.znear, not_negative);
    } else {
      camera.yfov = messages.in_range(object, "yfov", source.perspective.yfov, {0, 3.14, true});
      camera.aspect = messages.in_range(object, "aspectRatio", source.perspective.aspectRatio, not_negative);
      camera.znear = messages.in_range(object, "znear", source.perspective.znear, not_negative);
    }
    cameras.push_back(camera);
  }
  return cameras;
}

std::vector<PunctualLight> read_lights(const tinygltf::Model& model, const std::vector<PlacedNode>& nodes,
                                       Messages& messages) {
  std::vector<PunctualLight> lights;
  for (const PlacedNode& placed : nodes) {
    const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(placed.node)];
    const auto extension = node.extensions.find("KHR_lights_punctual");
    if (extension == node.extensions.end() || !extension->second.Has("light")) continue;
    const int index = extension->second.Get("light").GetNumberAsInt();
    if (index < 0 || static_cast<std::size_t>(index) >= model.lights.size())
      messages.fail(node_label(model, placed.node),
                    fmt::format("refers to light {}, the file has {}", index, model.lights.size()),
                    "export the scene again");
    const tinygltf::Light& source = model.lights[static_cast<std::size_t>(index)];
    const std::string object = label("light", source.name, static_cast<std::size_t>(index));
    lights.push_back(read_light(source, object, placed.to_world, node.extras, messages));
    if (lights.back().name.empty()) lights.back().name = node.name;
  }
  return lights;
}

Camera default_camera(const dvec3& low, const dvec3& high) {
  Camera camera;
  camera.name = "default";
  const dvec3 centre = 0.5 * (low + high);
  const double radius = std::max(0.5 * glm::length(high - low), 1e-6);
  const dvec3 eye = centre + glm::normalize(dvec3(0, 1, 1)) * (radius / std::sin(0.5 * camera.yfov));
  camera.pose = glm::inverse(glm::lookAt(eye, centre, dvec3(0, 1, 0)));
  return camera;
}

}  // namespace meniscal::gltf
