#include "host/export/liquid_material.h"

#include <algorithm>

#include "host/scene/extras.h"

namespace meniscal::gltf {
namespace {

void erase_textures(OrderedJson& json) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items())
    if (key.ends_with("Texture")) keys.push_back(key);
  for (const std::string& key : keys) json.erase(key);
}

void erase_liquid(OrderedJson& material) {
  if (!material.contains("extras") || !material["extras"].is_object()) return;
  OrderedJson& extras = material["extras"];
  std::vector<std::string> keys;
  for (const auto& [key, value] : extras.items())
    if (key.starts_with("meniscus_")) keys.push_back(key);
  for (const std::string& key : keys) extras.erase(key);
  if (extras.empty()) material.erase("extras");
}

OrderedJson& extension(Document& document, OrderedJson& material, const std::string& name) {
  OrderedJson& used = document.json["extensionsUsed"];
  if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
  return material["extensions"][name];
}

}  // namespace

OrderedJson spell_out_liquid(OrderedJson material, const Material& meaning, double thickness, Document& document) {
  erase_textures(material);
  OrderedJson& pbr = material["pbrMetallicRoughness"];
  if (pbr.is_object()) erase_textures(pbr);
  if (material.contains("extensions"))
    for (auto& [name, factors] : material["extensions"].items()) erase_textures(factors);
  erase_liquid(material);

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

}  // namespace meniscal::gltf
