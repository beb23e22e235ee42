#include "host/scene/accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace meniscal::gltf {
namespace {

template <typename T>
T load(const unsigned char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);  // accessors need not be aligned in memory
  return value;
}

template <typename T>
double component(const unsigned char* bytes, bool normalized) {
  const T value = load<T>(bytes);
  if constexpr (std::is_integral_v<T>)
    if (normalized) return std::max(double(value) / double(std::numeric_limits<T>::max()), -1.0);
  return double(value);
}

double component(const unsigned char* bytes, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return component<std::int8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return component<std::uint8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return component<std::int16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return component<std::uint16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return component<std::uint32_t>(bytes, normalized);
    default:
      return component<float>(bytes, normalized);
  }
}

const unsigned char* view_data(const tinygltf::Model& model, int index) {
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(index)];
  return model.buffers[static_cast<std::size_t>(view.buffer)].data.data() + view.byteOffset;
}

// Of an accessor without a buffer view: a few bytes of file may ask for any number of zeros. (Those that nothing here
// reads, such as morph targets', are not made.)
constexpr std::size_t max_zero_elements = std::size_t{1} << 20;

// All components of all elements, in order.
std::vector<double> read(const tinygltf::Model& model, const tinygltf::Accessor& accessor, const std::string& object,
                         const Messages& messages) {
  const std::size_t width = element_bytes(accessor) / component_bytes(accessor.componentType);
  const std::size_t step = component_bytes(accessor.componentType);
  if (accessor.bufferView < 0 && accessor.count > max_zero_elements)
    messages.fail(object, fmt::format("has {} elements and no buffer view", accessor.count),
                  fmt::format("give a buffer view, or at most {} elements", max_zero_elements));
  std::vector<double> values(accessor.count * width, 0.0);
  const auto read_element = [&](std::size_t element, const unsigned char* bytes) {
    for (std::size_t k = 0; k < width; ++k)
      values[element * width + k] = component(bytes + k * step, accessor.componentType, accessor.normalized);
  };
  if (accessor.bufferView >= 0) {
    const std::size_t view_stride = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
    const std::size_t stride = view_stride ? view_stride : element_bytes(accessor);
    const unsigned char* bytes = view_data(model, accessor.bufferView) + accessor.byteOffset;
    for (std::size_t i = 0; i < accessor.count; ++i) read_element(i, bytes + i * stride);
  }
  if (!accessor.sparse.isSparse) return values;

  const auto& [count, is_sparse, indices, replacements] = accessor.sparse;
  const unsigned char* index_bytes = view_data(model, indices.bufferView) + indices.byteOffset;
  const unsigned char* value_bytes = view_data(model, replacements.bufferView) + replacements.byteOffset;
  double previous = -1;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const double index =
        component(index_bytes + i * component_bytes(indices.componentType), indices.componentType, false);
    if (index <= previous || index >= static_cast<double>(accessor.count))
      messages.fail(object,
                    fmt::format("has the sparse index {} after {}, of {} elements", index, previous, accessor.count),
                    "give increasing indices below count");
    read_element(static_cast<std::size_t>(index), value_bytes + i * element_bytes(accessor));
    previous = index;
  }
  return values;
}

}  // namespace

std::uint64_t component_bytes(int component_type) {
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

std::uint64_t element_bytes(const tinygltf::Accessor& accessor) {
  const int components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
  return component_bytes(accessor.componentType) * static_cast<std::uint64_t>(components);
}

std::vector<glm::dvec3> read_vec3(const tinygltf::Model& model, int index, Attribute attribute, bool quantized,
                                  const Messages& messages) {
  const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  const std::string object = label("accessor", accessor.name, static_cast<std::size_t>(index));
  const int type = accessor.componentType;
  const bool is_signed = type == TINYGLTF_COMPONENT_TYPE_BYTE || type == TINYGLTF_COMPONENT_TYPE_SHORT;
  const bool is_integer = type != TINYGLTF_COMPONENT_TYPE_FLOAT && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  const bool allowed = type == TINYGLTF_COMPONENT_TYPE_FLOAT ||
                       (quantized && (attribute == Attribute::normal ? is_signed && accessor.normalized : is_integer));
  if (accessor.type != TINYGLTF_TYPE_VEC3 || !allowed)
    messages.fail(object,
                  fmt::format("has component type {}, which a {} cannot have", type,
                              attribute == Attribute::normal ? "normal" : "position"),
                  "give VEC3 of floats (5126), or integers with KHR_mesh_quantization in extensionsRequired");

  const std::vector<double> values = read(model, accessor, object, messages);
  std::vector<glm::dvec3> result(accessor.count);
  for (std::size_t i = 0; i < accessor.count; ++i) {
    result[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
    // A normal that is not a number is an absent one; without positions there is no shape.
    if (!std::isfinite(result[i].x + result[i].y + result[i].z)) {
      if (attribute == Attribute::position)
        messages.fail(object, fmt::format("has a position that is not finite, element {}", i), "repair the mesh");
      result[i] = glm::dvec3(0);
    }
  }
  return result;
}

std::vector<glm::dvec2> read_coordinates(const tinygltf::Model& model, int index, bool quantized,
                                         const Messages& messages) {
  const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  const std::string object = label("accessor", accessor.name, static_cast<std::size_t>(index));
  const int type = accessor.componentType;
  const bool is_unsigned =
      type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
  const bool allowed = type == TINYGLTF_COMPONENT_TYPE_FLOAT || (is_unsigned && accessor.normalized) ||
                       (quantized && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
  if (accessor.type != TINYGLTF_TYPE_VEC2 || !allowed)
    messages.fail(object, fmt::format("has component type {}, which texture coordinates cannot have", type),
                  "give VEC2 of floats (5126) or normalized 5121 or 5123; other integers with KHR_mesh_quantization in "
                  "extensionsRequired");
  const std::vector<double> values = read(model, accessor, object, messages);
  std::vector<glm::dvec2> result(accessor.count);
  for (std::size_t i = 0; i < accessor.count; ++i)
    if (std::isfinite(values[2 * i] + values[2 * i + 1])) result[i] = {values[2 * i], values[2 * i + 1]};
  return result;
}

std::vector<std::uint32_t> read_indices(const tinygltf::Model& model, int index, std::size_t vertices,
                                        const Messages& messages) {
  const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  const std::string object = label("accessor", accessor.name, static_cast<std::size_t>(index));
  const int type = accessor.componentType;
  if (accessor.type != TINYGLTF_TYPE_SCALAR ||
      (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
       type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) ||
      accessor.normalized)
    messages.fail(object, fmt::format("has component type {}, which vertex indices cannot have", type),
                  "give unsigned scalars (5121, 5123, 5125)");
  const std::vector<double> values = read(model, accessor, object, messages);
  std::vector<std::uint32_t> result(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] >= static_cast<double>(vertices))
      messages.fail(object, fmt::format("has vertex index {}, the mesh has {} vertices", values[i], vertices),
                    "repair the mesh");
    result[i] = static_cast<std::uint32_t>(values[i]);
  }
  return result;
}

}  // namespace meniscal::gltf
