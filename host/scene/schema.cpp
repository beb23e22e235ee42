#include "host/scene/schema.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "host/scene/extras.h"
#include "host/scene/guard.h"
#include "host/scene/validate.h"

namespace meniscal::gltf {
namespace {

using Json = nlohmann::json;

enum class Kind { integer, integers, number, numbers, boolean, string };

struct Property {
  std::string_view key;
  Kind kind;
  std::size_t length = 0;  // of an array; 0: any
};

// A key means the same wherever it stands in glTF, but for the few in `has_two_meanings`.
constexpr Property properties[] = {
    {"attenuationColor", Kind::numbers, 3},
    {"attenuationDistance", Kind::number},
    {"aspectRatio", Kind::number},
    {"baseColorFactor", Kind::numbers, 4},
    {"buffer", Kind::integer},
    {"bufferView", Kind::integer},
    {"byteLength", Kind::integer},
    {"byteOffset", Kind::integer},
    {"byteStride", Kind::integer},
    {"camera", Kind::integer},
    {"children", Kind::integers},
    {"color", Kind::numbers, 3},
    {"componentType", Kind::integer},
    {"count", Kind::integer},
    {"doubleSided", Kind::boolean},
    {"emissiveFactor", Kind::numbers, 3},
    {"emissiveStrength", Kind::number},
    {"index", Kind::integer},
    {"indices", Kind::integer},
    {"innerConeAngle", Kind::number},
    {"intensity", Kind::number},
    {"ior", Kind::number},
    {"light", Kind::integer},
    {"magFilter", Kind::integer},
    {"material", Kind::integer},
    {"matrix", Kind::numbers, 16},
    {"mesh", Kind::integer},
    {"metallicFactor", Kind::number},
    {"mode", Kind::integer},
    {"name", Kind::string},
    {"nodes", Kind::integers},
    {"normalized", Kind::boolean},
    {"offset", Kind::numbers, 2},
    {"outerConeAngle", Kind::number},
    {"range", Kind::number},
    {"rotation", Kind::numbers, 4},
    {"roughnessFactor", Kind::number},
    {"sampler", Kind::integer},
    {"scale", Kind::numbers},
    {"scene", Kind::integer},
    {"skin", Kind::integer},
    {"source", Kind::integer},
    {"specularColorFactor", Kind::numbers, 3},
    {"specularFactor", Kind::number},
    {"texCoord", Kind::integer},
    {"thicknessFactor", Kind::number},
    {"translation", Kind::numbers, 3},
    {"transmissionFactor", Kind::number},
    {"uri", Kind::string},
    {"wrapS", Kind::integer},
    {"wrapT", Kind::integer},
    {"xmag", Kind::number},
    {"yfov", Kind::number},
    {"ymag", Kind::number},
    {"zfar", Kind::number},
    {"znear", Kind::number},
};

// `indices` of a sparse accessor is an object, the root's `nodes` is an array of objects; a normal texture's and a
// texture transform's `scale` are a number and two numbers, a node's is three.
bool has_two_meanings(std::string_view key, const Json& value) {
  if (key == "indices") return value.is_object();
  if (key == "nodes") return value.is_array() && !value.empty() && value.front().is_object();
  if (key == "scale") return value.is_number();
  if (key == "rotation") return value.is_number();
  return false;
}

bool is_index(const Json& value) { return value.is_number_unsigned() && value.get<std::uint64_t>() <= max_bytes; }

bool all_of(const Json& array, bool (*test)(const Json&)) {
  return array.is_array() && std::all_of(array.begin(), array.end(), test);
}

bool fits(const Json& value, const Property& property) {
  switch (property.kind) {
    case Kind::integer:
      return is_index(value);
    case Kind::integers:
      return all_of(value, is_index);
    case Kind::number:
      return value.is_number();
    case Kind::numbers:
      return all_of(value, [](const Json& v) { return v.is_number(); }) &&
             (property.length == 0 || value.size() == property.length);
    case Kind::boolean:
      return value.is_boolean();
    case Kind::string:
      return value.is_string();
  }
  return false;
}

std::string expected(const Property& property) {
  switch (property.kind) {
    case Kind::integer:
      return fmt::format("an integer from 0 to {}", max_bytes);
    case Kind::integers:
      return fmt::format("an array of integers from 0 to {}", max_bytes);
    case Kind::number:
      return "a number";
    case Kind::numbers:
      return property.length ? fmt::format("an array of {} numbers", property.length) : "numbers";
    case Kind::boolean:
      return "true or false";
    case Kind::string:
      return "a text";
  }
  return {};
}

void check_own_integers(const Json& extras, const std::string& path, const Messages& messages) {
  if (!extras.is_object()) return;
  for (const auto& [key, value] : extras.items())
    if (is_own_extra(key) && value.is_number_integer() &&
        std::abs(value.get<double>()) > static_cast<double>(max_bytes))
      messages.fail(path, fmt::format("{} is {}", key, value.dump()), "give a smaller number");
}

// Recursion is safe: check_depth has bounded it.
void check(const Json& value, const std::string& path, const Messages& messages) {
  if (value.is_array())
    for (std::size_t i = 0; i < value.size(); ++i) check(value[i], fmt::format("{}[{}]", path, i), messages);
  if (!value.is_object()) return;
  for (const auto& item : value.items()) {
    const std::string& key = item.key();
    const Json& member = item.value();
    const std::string here = path.empty() ? key : path + "." + key;
    if (key == "extras") {  // anyone's own; ours are checked where they are read, but for what tinygltf would cut off
      check_own_integers(member, here, messages);
      continue;
    }
    if (path.ends_with("extensions") && !is_supported(key)) continue;
    if (key == "attributes" && member.is_object())
      for (const auto& [attribute, accessor] : member.items())
        if (!is_index(accessor))
          messages.fail(here, fmt::format("{} is {}", attribute, accessor.dump()), "give the index of an accessor");
    const auto* property = std::find_if(std::begin(properties), std::end(properties),
                                        [&](const Property& candidate) { return candidate.key == key; });
    if (property != std::end(properties) && !has_two_meanings(key, member) && !fits(member, *property)) {
      const std::string shown = member.is_structured() ? std::string(member.type_name()) : member.dump();
      messages.fail(here, fmt::format("is {}", shown), fmt::format("give {}", expected(*property)));
    }
    check(member, here, messages);
  }
}

// tinygltf takes an array of another type for an absent one, and a data URI of unknown type for a file's name.
void check_top_level(const Json& root, const Messages& messages) {
  if (!root.is_object()) messages.fail("JSON", "is not an object", "give a glTF 2.0 file");
  constexpr std::array arrays = {"accessors", "animations", "buffers",  "bufferViews",    "cameras",
                                 "images",    "materials",  "meshes",   "nodes",          "samplers",
                                 "scenes",    "skins",      "textures", "extensionsUsed", "extensionsRequired"};
  for (const std::string key : arrays) {
    if (!root.contains(key)) continue;
    const bool of_strings = key.starts_with("extensions");
    if (!root[key].is_array()) messages.fail(key, "is not an array", "export the scene again");
    for (const Json& item : root[key])
      if (of_strings ? !item.is_string() : !item.is_object())
        messages.fail(key, fmt::format("has an item that is no {}", of_strings ? "text" : "object"),
                      "export the scene again");
  }
}

void check_buffer_uris(const Json& root, const Messages& messages) {
  if (!root.contains("buffers")) return;
  for (const Json& buffer : root["buffers"]) {
    const std::string uri = buffer.value("uri", "");
    if (uri.starts_with("data:") && !tinygltf::IsDataURI(uri))
      messages.fail("buffer", fmt::format("has the data URI \"{}\" of an unknown media type", uri.substr(0, 60)),
                    "use data:application/octet-stream;base64,");
  }
}

}  // namespace

void check_schema(std::string_view json, const Messages& messages) {
  Json root;
  try {
    root = Json::parse(json);
  } catch (const Json::exception& error) {
    messages.fail("JSON", error.what(), "give a glTF 2.0 file (.gltf or .glb)");
  }
  check_top_level(root, messages);
  check(root, "", messages);
  check_buffer_uris(root, messages);
}

}  // namespace meniscal::gltf
