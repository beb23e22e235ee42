#include "host/scene/materials.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/scene/extras.h"
#include "host/scene/liquids.h"
#include "host/scene/textures.h"

namespace meniscal::gltf {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Range unit{0, 1}, positive{0, infinity, true}, not_negative{0, infinity};

// The factors of one extension; an absent extension reads as its defaults. Types were checked before (schema.h).
class Factors {
 public:
  Factors(const tinygltf::Material& material, const std::string& extension, std::string object,
          const Messages& messages)
      : object_(std::move(object)), messages_(messages) {
    const auto found = material.extensions.find(extension);
    if (found != material.extensions.end()) values_ = &found->second;
  }
  bool present() const { return values_ != nullptr; }
  double number(const std::string& key, double absent, Range range) const {
    if (!present() || !values_->Has(key)) return absent;
    return messages_.in_range(object_, key, values_->Get(key).GetNumberAsDouble(), range);
  }
  glm::dvec3 color(const std::string& key) const {  // white where absent
    glm::dvec3 result(1);
    if (!present() || !values_->Has(key)) return result;
    for (int i = 0; i < 3; ++i)
      result[i] = messages_.in_range(object_, key, values_->Get(key).Get(i).GetNumberAsDouble(), not_negative);
    return result;
  }

 private:
  const tinygltf::Value* values_ = nullptr;
  std::string object_;
  const Messages& messages_;
};

glm::dvec3 vector(const std::vector<double>& values, const std::string& object, std::string_view key, Range range,
                  const Messages& messages) {
  glm::dvec3 result;
  for (int i = 0; i < 3; ++i) result[i] = messages.in_range(object, key, values[static_cast<std::size_t>(i)], range);
  return result;
}

// Beer-Lambert coefficients from KHR_materials_volume: attenuationColor is what remains after attenuationDistance.
glm::dvec3 absorption(const Factors& volume) {
  const double distance = volume.number("attenuationDistance", infinity, positive);
  // A colour of 0 would need an infinite coefficient; 1e-6 is black in any image.
  const glm::dvec3 color = glm::clamp(volume.color("attenuationColor"), 1e-6, 1.0);
  return -glm::log(color) / distance;
}

// Fills in what a liquid's material leaves unsaid; glTF's own defaults (rough metal) make no liquid.
void complete_liquid(const tinygltf::Material& source, Material& material) {
  const NamedLiquid* known = named_liquid(material.liquid->kind);
  if (known != nullptr && !source.extensions.contains("KHR_materials_ior")) material.ior = known->ior;
  if (material.liquid->opaque)
    material.transmission = 0;
  else if (!source.extensions.contains("KHR_materials_transmission"))
    material.transmission = 1;
  if (!source.values.contains("roughnessFactor")) material.roughness = 0;
  if (!source.values.contains("metallicFactor")) material.metallic = material.liquid->opaque ? 1 : 0;
}

Material read_material(const tinygltf::Model& model, std::size_t index, Images& images, Messages& messages) {
  const tinygltf::Material& source = model.materials[index];
  const std::string object = label("material", source.name, index);
  const Factors transmission(source, "KHR_materials_transmission", object, messages);
  const Factors ior(source, "KHR_materials_ior", object, messages);
  const Factors specular(source, "KHR_materials_specular", object, messages);
  const Factors volume(source, "KHR_materials_volume", object, messages);
  const Factors emissive(source, "KHR_materials_emissive_strength", object, messages);
  const auto& pbr = source.pbrMetallicRoughness;

  Material material;
  material.name = source.name.empty() ? object : source.name;
  material.base_color = vector(pbr.baseColorFactor, object, "baseColorFactor", unit, messages);
  material.metallic = messages.in_range(object, "metallicFactor", pbr.metallicFactor, unit);
  material.roughness = messages.in_range(object, "roughnessFactor", pbr.roughnessFactor, unit);
  material.transmission = transmission.number("transmissionFactor", 0, unit);
  material.ior = ior.number("ior", material.ior, {1, 1e6});
  material.specular = specular.number("specularFactor", 1, unit);
  material.specular_color = specular.color("specularColorFactor");
  material.has_thickness = volume.number("thicknessFactor", 0, not_negative) > 0;
  material.absorption = absorption(volume);
  material.emission = vector(source.emissiveFactor, object, "emissiveFactor", color_range, messages) *
                      emissive.number("emissiveStrength", 1, light_range);
  material.double_sided = source.doubleSided;
  if (source.alphaMode != "OPAQUE") messages.warn(object, fmt::format("alphaMode {} is ignored", source.alphaMode));

  const Extras extras(source.extras, object, messages);
  constexpr Range angle{0, 180};
  material.liquid = read_liquid(extras);
  material.contact_angle = extras.number("meniscus_contact_angle", angle);
  material.contact_angle_with = extras.numbers_by_name("meniscus_contact_angle_", angle);
  material.meniscus_ignore = extras.flag("meniscus_ignore");
  material.target = extras.flag("meniscus_target");
  material.dielectric_priority = extras.integer("dielectric_priority");
  warn_of_unread_extras(source.extras, Place::material, object, messages);
  if (material.liquid) {
    complete_liquid(source, material);
  }
  read_textures(model, source, object, images, material, messages);
  return material;
}

// A contact angle with a liquid that the scene does not have is nearly always a misspelt name.
void check_liquid_names(const std::vector<Material>& materials, Messages& messages) {
  std::vector<std::string> liquids;
  for (const Material& material : materials)
    if (material.liquid) liquids.push_back(material.name);
  for (const Material& material : materials)
    for (const auto& [name, angle] : material.contact_angle_with)
      if (std::find(liquids.begin(), liquids.end(), name) == liquids.end())
        messages.warn(label("material", material.name, 0),
                      fmt::format("meniscus_contact_angle_{} names no liquid material of this scene, which has: {}",
                                  name, liquids.empty() ? "none" : fmt::format("{}", fmt::join(liquids, ", "))));
}

}  // namespace

std::vector<Material> read_materials(const tinygltf::Model& model, Messages& messages, Stages& stages) {
  std::vector<Material> materials;
  Images images(model, messages);
  for (std::size_t i = 0; i < model.materials.size(); ++i)
    materials.push_back(read_material(model, i, images, messages));
  stages.add(images.stages());
  check_liquid_names(materials, messages);
  return materials;
}

}  // namespace meniscal::gltf
