#include "host/scene/validate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "host/scene/accessor.h"

namespace meniscal::gltf {
namespace {

using std::uint64_t;

constexpr std::array<std::string_view, 8> supported_extensions = {
    "KHR_lights_punctual",        "KHR_materials_emissive_strength",
    "KHR_materials_ior",          "KHR_materials_specular",
    "KHR_materials_transmission", "KHR_materials_volume",
    "KHR_mesh_quantization",      "KHR_texture_transform"};

// An accessor may have no buffer view and be all zeros: then the file's size does not bound its count, this does.
constexpr uint64_t max_zero_elements = uint64_t{1} << 24;

void check_extensions(const tinygltf::Model& model, Messages& messages) {
  for (const std::string& name : model.extensionsRequired)
    if (!is_supported(name))
      messages.fail("extensionsRequired", fmt::format("{} is not supported", name), "export without it");
  std::vector<std::string> unknown;
  for (const std::string& name : model.extensionsUsed)
    if (!is_supported(name)) unknown.push_back(name);
  if (!unknown.empty())
    messages.warn("extensionsUsed", fmt::format("not supported and ignored: {}", fmt::join(unknown, ", ")));
}

void check_version(const tinygltf::Asset& asset, const Messages& messages) {
  if (!asset.version.starts_with("2.") || (!asset.minVersion.empty() && asset.minVersion != "2.0"))
    messages.fail("asset", fmt::format("is glTF {} (minVersion \"{}\")", asset.version, asset.minVersion),
                  "export as glTF 2.0");
}

// `index` in [0, size), or -1 where that means "none" and is allowed.
void check_index(const std::string& object, std::string_view what, int index, std::size_t size, bool optional,
                 const Messages& messages) {
  if (optional && index == -1) return;
  if (index < 0 || static_cast<std::size_t>(index) >= size)
    messages.fail(object, fmt::format("refers to {} {}, the file has {}", what, index, size), "export the scene again");
}

void check_buffer_views(const tinygltf::Model& model, bool binary, const Messages& messages) {
  for (std::size_t i = 1; i < model.buffers.size(); ++i)
    if (binary && model.buffers[i].uri.empty())
      messages.fail(label("buffer", model.buffers[i].name, i), "has no uri",
                    "only the first buffer may be the GLB's own");
  for (std::size_t i = 0; i < model.bufferViews.size(); ++i) {
    const tinygltf::BufferView& view = model.bufferViews[i];
    const std::string object = label("bufferView", view.name, i);
    check_index(object, "buffer", view.buffer, model.buffers.size(), false, messages);
    const uint64_t size = model.buffers[static_cast<std::size_t>(view.buffer)].data.size();
    if (view.byteOffset > size || view.byteLength > size - view.byteOffset)
      messages.fail(object,
                    fmt::format("spans bytes {} to {} of a buffer of {}", view.byteOffset,
                                view.byteOffset + view.byteLength, size),
                    "export the scene again");
  }
}

// `count` elements of `element` bytes from `offset`, `stride` apart (0: packed), lie in the buffer view.
void check_span(const tinygltf::Model& model, const std::string& object, int view_index, uint64_t offset,
                uint64_t count, uint64_t element, bool strided, const Messages& messages) {
  check_index(object, "bufferView", view_index, model.bufferViews.size(), false, messages);
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(view_index)];
  const uint64_t stride = strided && view.byteStride != 0 ? view.byteStride : element;
  if (stride < element)
    messages.fail(object, fmt::format("has elements of {} bytes, {} apart", element, stride), "export the scene again");
  // All of these are below 2^31 (schema), so the product is exact.
  const uint64_t needed = offset + stride * (count - 1) + element;
  if (needed > view.byteLength)
    messages.fail(object,
                  fmt::format("needs {} bytes of bufferView {}, which has {}", needed, view_index, view.byteLength),
                  "export the scene again");
}

void check_sparse(const tinygltf::Model& model, const std::string& object, const tinygltf::Accessor& accessor,
                  const Messages& messages) {
  const auto& sparse = accessor.sparse;
  const int type = sparse.indices.componentType;
  if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
      type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
    messages.fail(object, fmt::format("has sparse indices of component type {}", type), "use 5121, 5123 or 5125");
  if (sparse.count < 1 || static_cast<uint64_t>(sparse.count) > accessor.count)
    messages.fail(object, fmt::format("replaces {} of {} elements", sparse.count, accessor.count),
                  "give sparse.count from 1 to count");
  const auto count = static_cast<uint64_t>(sparse.count);
  check_span(model, object, sparse.indices.bufferView, static_cast<uint64_t>(sparse.indices.byteOffset), count,
             component_bytes(type), false, messages);
  check_span(model, object, sparse.values.bufferView, static_cast<uint64_t>(sparse.values.byteOffset), count,
             element_bytes(accessor), false, messages);
}

void check_accessors(const tinygltf::Model& model, const Messages& messages) {
  for (std::size_t i = 0; i < model.accessors.size(); ++i) {
    const tinygltf::Accessor& accessor = model.accessors[i];
    const std::string object = label("accessor", accessor.name, i);
    if (component_bytes(accessor.componentType) == 0)
      messages.fail(object, fmt::format("has component type {}", accessor.componentType),
                    "use 5120 to 5123, 5125 or 5126");
    if (accessor.count == 0) messages.fail(object, "is empty", "give a count of at least 1");
    if (accessor.bufferView >= 0)
      check_span(model, object, accessor.bufferView, accessor.byteOffset, accessor.count, element_bytes(accessor), true,
                 messages);
    else if (accessor.count > max_zero_elements)
      messages.fail(object, fmt::format("has {} elements and no buffer view", accessor.count),
                    fmt::format("give a buffer view, or at most {} elements", max_zero_elements));
    if (accessor.sparse.isSparse) check_sparse(model, object, accessor, messages);
  }
}

void check_textures(const tinygltf::Model& model, const Messages& messages) {
  for (std::size_t i = 0; i < model.images.size(); ++i)
    check_index(label("image", model.images[i].name, i), "bufferView", model.images[i].bufferView,
                model.bufferViews.size(), true, messages);
  for (std::size_t i = 0; i < model.textures.size(); ++i) {
    const std::string object = label("texture", model.textures[i].name, i);
    check_index(object, "image", model.textures[i].source, model.images.size(), true, messages);
    check_index(object, "sampler", model.textures[i].sampler, model.samplers.size(), true, messages);
  }
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    const tinygltf::Material& m = model.materials[i];
    for (const int texture :
         {m.pbrMetallicRoughness.baseColorTexture.index, m.pbrMetallicRoughness.metallicRoughnessTexture.index,
          m.normalTexture.index, m.emissiveTexture.index})
      check_index(label("material", m.name, i), "texture", texture, model.textures.size(), true, messages);
  }
}

void check_meshes(const tinygltf::Model& model, Messages& messages) {
  for (std::size_t i = 0; i < model.meshes.size(); ++i)
    for (const tinygltf::Primitive& primitive : model.meshes[i].primitives) {
      const std::string object = label("mesh", model.meshes[i].name, i);
      check_index(object, "material", primitive.material, model.materials.size(), true, messages);
      check_index(object, "accessor", primitive.indices, model.accessors.size(), true, messages);
      if (primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
        messages.fail(object, fmt::format("has a primitive of mode {}", primitive.mode), "use triangles, mode 4");
      std::size_t count = 0;
      for (const auto& [name, index] : primitive.attributes) {
        check_index(object, "accessor", index, model.accessors.size(), false, messages);
        const std::size_t here = model.accessors[static_cast<std::size_t>(index)].count;
        if (count != 0 && here != count)
          messages.fail(object, fmt::format("has attributes of {} and of {} vertices ({})", count, here, name),
                        "give every attribute the same count");
        count = here;
      }
      if (!primitive.targets.empty()) messages.warn(object, "morph targets are not supported and ignored");
    }
}

void check_nodes(const tinygltf::Model& model, Messages& messages) {
  const std::size_t size = model.nodes.size();
  std::vector<int> parent(size, -1);
  for (std::size_t i = 0; i < size; ++i) {
    const tinygltf::Node& node = model.nodes[i];
    const std::string object = label("node", node.name, i);
    check_index(object, "mesh", node.mesh, model.meshes.size(), true, messages);
    check_index(object, "camera", node.camera, model.cameras.size(), true, messages);
    if (node.scale.size() != 0 && node.scale.size() != 3)
      messages.fail(object, "has a scale that is not three numbers", "give [x, y, z]");
    if (node.skin != -1) messages.warn(object, "skins are not supported: the mesh stays in its bind pose");
    for (const int child : node.children) {
      check_index(object, "child node", child, size, false, messages);
      int& others = parent[static_cast<std::size_t>(child)];
      if (others != -1)
        messages.fail(label("node", model.nodes[static_cast<std::size_t>(child)].name, static_cast<std::size_t>(child)),
                      fmt::format("is a child of node {} and of node {}", others, i), "give every node one parent");
      others = static_cast<int>(i);
    }
  }
  // With one parent each, a walk upwards that is longer than the file has nodes goes in a circle; walks stop at nodes
  // already known to end at a root.
  std::vector<char> ends(size, 0);
  for (std::size_t i = 0; i < size; ++i) {
    std::vector<std::size_t> walk;
    for (int at = static_cast<int>(i); at != -1 && !ends[static_cast<std::size_t>(at)];
         at = parent[static_cast<std::size_t>(at)]) {
      if (walk.size() == size)
        messages.fail(label("node", model.nodes[i].name, i), "is its own ancestor", "break the cycle");
      walk.push_back(static_cast<std::size_t>(at));
    }
    for (const std::size_t seen : walk) ends[seen] = 1;
  }
  for (std::size_t i = 0; i < model.scenes.size(); ++i) {
    std::vector<char> listed(size, 0);
    for (const int root : model.scenes[i].nodes) {
      const std::string object = label("scene", model.scenes[i].name, i);
      check_index(object, "node", root, size, false, messages);
      if (parent[static_cast<std::size_t>(root)] != -1)
        messages.fail(
            object,
            fmt::format("lists node {}, which is a child of node {}", root, parent[static_cast<std::size_t>(root)]),
            "list root nodes only");
      if (listed[static_cast<std::size_t>(root)]++ != 0)
        messages.fail(object, fmt::format("lists node {} twice", root), "list every root once");
    }
  }
  if (model.defaultScene != -1) check_index("scene", "scene", model.defaultScene, model.scenes.size(), false, messages);
  if (!model.animations.empty()) messages.warn("animations", "not supported: the scene is rendered as the nodes stand");
}

}  // namespace

bool is_supported(std::string_view extension) {
  return std::find(supported_extensions.begin(), supported_extensions.end(), extension) != supported_extensions.end();
}

void validate(const tinygltf::Model& model, bool binary, Messages& messages) {
  check_version(model.asset, messages);
  check_extensions(model, messages);
  check_buffer_views(model, binary, messages);
  check_accessors(model, messages);
  check_textures(model, messages);
  check_meshes(model, messages);
  check_nodes(model, messages);
}

}  // namespace meniscal::gltf
