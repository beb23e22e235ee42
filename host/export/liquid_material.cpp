#include "host/export/liquid_material.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "host/scene/extras.h"

namespace meniscal::gltf {
namespace {

// Erases the keys that `unwanted` picks, and adds them to `erased`.
template <class Unwanted>
void erase_keys(OrderedJson& json, Unwanted unwanted, std::vector<std::string>& erased) {
  const std::size_t first = erased.size();
  for (const auto& [key, value] : json.items())
    if (unwanted(key)) erased.push_back(key);
  for (std::size_t i = first; i < erased.size(); ++i) json.erase(erased[i]);
}

std::vector<std::string> erase_textures(OrderedJson& material) {
  const auto is_texture = [](const std::string& key) { return key.ends_with("Texture"); };
  std::vector<std::string> erased;
  erase_keys(material, is_texture, erased);
  if (material.contains("pbrMetallicRoughness")) erase_keys(material["pbrMetallicRoughness"], is_texture, erased);
  if (material.contains("extensions"))
    for (auto& [name, factors] : material["extensions"].items()) erase_keys(factors, is_texture, erased);
  return erased;
}

template <class Unwanted>
void erase_extras(OrderedJson& material, Unwanted unwanted) {
  if (!material.contains("extras") || !material["extras"].is_object()) return;
  std::vector<std::string> erased;
  erase_keys(material["extras"], unwanted, erased);
  if (material["extras"].empty()) material.erase("extras");
}

OrderedJson& extension(Document& document, OrderedJson& material, const std::string& name) {
  OrderedJson& used = document.json["extensionsUsed"];
  if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
  return material["extensions"][name];
}

}  // namespace

OrderedJson spell_out_liquid(OrderedJson material, const Material& meaning, double thickness, Document& document,
                             Messages& messages) {
  if (const std::vector<std::string> textures = erase_textures(material); !textures.empty())
    messages.warn(label("material", meaning.name, 0),
                  fmt::format("left without its textures ({}): the liquid's new surface has no texture coordinates",
                              fmt::join(textures, ", ")));
  erase_extras(material, [](const std::string& key) { return key.starts_with("meniscus_"); });

  OrderedJson& pbr = material["pbrMetallicRoughness"];
  pbr["roughnessFactor"] = 0;  // liquids are smooth
  pbr["metallicFactor"] = meaning.liquid->opaque ? 1 : meaning.metallic;
  if (meaning.liquid->opaque) {
    if (material.contains("extensions")) material["extensions"].erase("KHR_materials_transmission");
    return material;
  }
  extension(document, material, "KHR_materials_transmission")["transmissionFactor"] = meaning.transmission;
  extension(document, material, "KHR_materials_ior")["ior"] = meaning.ior;
  OrderedJson& volume = extension(document, material, "KHR_materials_volume");
  if (!meaning.has_thickness) volume["thicknessFactor"] = thickness;  // without one the surface would not refract
  return material;
}

void forget_contact_angles(Document& document, const std::string& liquid) {
  const std::string angle = "meniscus_contact_angle_" + liquid;
  for (OrderedJson& material : document.json["materials"])
    erase_extras(material, [&](const std::string& key) { return key == angle; });
}

}  // namespace meniscal::gltf
