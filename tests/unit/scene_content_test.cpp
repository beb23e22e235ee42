// Materials, liquids, extras, cameras and lights (host/scene/materials.h, liquids.h, extras.h, placement.h).
#include <numbers>

#include "host/world/surfaces.h"
#include "tests/unit/scene_fixture.h"

namespace meniscal::testing {
namespace {

using glm::dvec3;
using std::numbers::pi;

class SceneContent : public SceneFiles {
 protected:
  // A triangle whose material has these members.
  Material material(const Json& members) {
    Document document = triangle();
    document.json["materials"][0].merge_patch(members);
    return load(document).materials.at(0);
  }
  Scene with_extras(const Json& extras) { return load(document_with_extras(extras)); }
  static Document document_with_extras(const Json& extras) {
    Document document = triangle();
    document.json["materials"][0]["extras"] = extras;
    return document;
  }
};

TEST_F(SceneContent, MaterialFactorsAndExtensions) {
  const Material m =
      material({{"pbrMetallicRoughness",
                 {{"baseColorFactor", {0.1, 0.2, 0.3, 1}}, {"metallicFactor", 0.25}, {"roughnessFactor", 0.5}}},
                {"emissiveFactor", {1, 0.5, 0}},
                {"doubleSided", true},
                {"extensions",
                 {{"KHR_materials_transmission", {{"transmissionFactor", 0.75}}},
                  {"KHR_materials_ior", {{"ior", 1.4}}},
                  {"KHR_materials_specular", {{"specularFactor", 0.0}, {"specularColorFactor", {1, 0.5, 2}}}},
                  {"KHR_materials_emissive_strength", {{"emissiveStrength", 20}}},
                  {"KHR_materials_volume",
                   {{"thicknessFactor", 0.01}, {"attenuationDistance", 0.5}, {"attenuationColor", {1, 0.5, 0.25}}}}}}});
  EXPECT_EQ(m.name, "stuff");
  EXPECT_EQ(m.base_color, dvec3(0.1, 0.2, 0.3));
  EXPECT_EQ(m.metallic, 0.25);
  EXPECT_EQ(m.roughness, 0.5);
  EXPECT_EQ(m.transmission, 0.75);
  EXPECT_EQ(m.ior, 1.4);
  EXPECT_EQ(m.specular, 0);
  EXPECT_EQ(m.specular_color, dvec3(1, 0.5, 2));
  EXPECT_EQ(m.emission, dvec3(20, 10, 0));
  EXPECT_TRUE(m.double_sided);
  EXPECT_TRUE(m.has_thickness);
  // Half of the green is left after 0.5 m: exp(-a 0.5) = 0.5.
  EXPECT_NEAR3(m.absorption, dvec3(0, 2 * std::log(2), 4 * std::log(2)), 1e-12);
}

// KHR_materials_specular: f0 is that of the ior, coloured, at the most 1, and scaled; f90 is scaled alone.
TEST(Surface, ReflectsStraightOnInTheSpecularColor) {
  Material m;
  m.metallic = 0;
  m.ior = 3;  // 0.25
  m.specular = 0.5;
  m.specular_color = dvec3(0.2, 1, 8);
  const shared::Surface s = make_surface(m, false);
  EXPECT_NEAR(double(s.f0.x), 0.025, 1e-7);
  EXPECT_NEAR(double(s.f0.y), 0.125, 1e-7);
  EXPECT_NEAR(double(s.f0.z), 0.5, 1e-7);
  EXPECT_EQ(s.f90, 0.5f);
}

TEST_F(SceneContent, MaterialDefaultsAreThoseOfGltf) {
  const Material m = material(Json::object());
  EXPECT_EQ(m.base_color, dvec3(1));
  EXPECT_EQ(m.metallic, 1);
  EXPECT_EQ(m.roughness, 1);
  EXPECT_EQ(m.ior, 1.5);
  EXPECT_EQ(m.specular, 1);
  EXPECT_EQ(m.absorption, dvec3(0));
  EXPECT_EQ(m.emission, dvec3(0));
  EXPECT_FALSE(m.liquid || m.has_thickness || m.double_sided || m.target || m.meniscus_ignore);

  Document document = triangle();
  document.json["meshes"][0]["primitives"][0].erase("material");
  const Scene scene = load(document);
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.objects[0].material, 1);
  EXPECT_EQ(scene.materials[1].name, "default");
}

TEST_F(SceneContent, FactorsOutOfRangeAreNamed) {
  const auto extension = [](const std::string& name, const std::string& key, double value) {
    Document document = triangle();
    document.json["materials"][0]["extensions"][name][key] = value;
    return document;
  };
  expect_error(extension("KHR_materials_ior", "ior", 0.5), {"material \"stuff\"", "ior is 0.5", "from 1"});
  expect_error(extension("KHR_materials_transmission", "transmissionFactor", 1.5), {"transmissionFactor", "0 to 1"});
  expect_error(extension("KHR_materials_volume", "attenuationDistance", 0), {"attenuationDistance", "above 0"});
  Document document = triangle();
  document.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {1, 2, 1, 1};
  expect_error(document, {"material \"stuff\"", "baseColorFactor is 2"});
}

TEST_F(SceneContent, NamedLiquids) {
  const Material water = with_extras({{"meniscus_liquid", "water"}}).materials[0];
  ASSERT_TRUE(water.liquid);
  EXPECT_EQ(water.liquid->kind, "water");
  EXPECT_EQ(water.liquid->surface_tension, 0.0728);
  EXPECT_EQ(water.liquid->density, 998.2);
  EXPECT_EQ(water.liquid->default_contact_angle, 30);
  EXPECT_EQ(water.liquid->profile, "sine");
  EXPECT_EQ(water.liquid->height_rule, "wetting");
  EXPECT_FALSE(water.liquid->opaque || water.liquid->flatten);
  EXPECT_EQ(water.ior, 1.333);
  EXPECT_EQ(water.transmission, 1);
  EXPECT_EQ(water.metallic, 0);
  EXPECT_EQ(water.roughness, 0);

  const Material mercury = with_extras({{"meniscus_liquid", "mercury"}}).materials[0];
  EXPECT_TRUE(mercury.liquid->opaque);
  EXPECT_EQ(mercury.liquid->default_contact_angle, 140);
  EXPECT_EQ(mercury.liquid->surface_tension, 0.4855);
  EXPECT_EQ(mercury.liquid->density, 13546);
  EXPECT_EQ(mercury.transmission, 0);
  for (const std::string name : {"seawater", "ethanol", "glycerol", "olive oil"}) {
    const Material m = with_extras({{"meniscus_liquid", name}}).materials[0];
    EXPECT_GT(m.ior, 1.333) << name;
    EXPECT_NEAR(m.liquid->surface_tension, 0.048, 0.027) << name;
  }
}

TEST_F(SceneContent, TheSceneOverridesTheLiquidsTable) {
  Document document = document_with_extras({{"meniscus_liquid", "water"},
                                            {"meniscus_surface_tension", 0.05},
                                            {"meniscus_density", 1000},
                                            {"meniscus_height_scale", 2},
                                            {"meniscus_sweep_scale", 0.5},
                                            {"meniscus_profile", "bessel"},
                                            {"meniscus_height_rule", "equation2"},
                                            {"meniscus_flatten", 1},
                                            {"meniscus_tolerance", 2e-6}});
  document.json["materials"][0]["extensions"]["KHR_materials_ior"]["ior"] = 1.5;
  document.json["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = 0.3;
  const Material m = load(document).materials[0];
  EXPECT_EQ(m.liquid->surface_tension, 0.05);
  EXPECT_EQ(m.liquid->density, 1000);
  EXPECT_EQ(m.liquid->height_scale, 2);
  EXPECT_EQ(m.liquid->sweep_scale, 0.5);
  EXPECT_EQ(m.liquid->profile, "bessel");
  EXPECT_EQ(m.liquid->height_rule, "equation2");
  EXPECT_TRUE(m.liquid->flatten);
  EXPECT_EQ(m.liquid->tolerance, 2e-6);
  EXPECT_EQ(m.ior, 1.5);
  EXPECT_EQ(m.roughness, 0.3);
}

TEST_F(SceneContent, TensionAndDensityMakeACustomLiquid) {
  const Material m = with_extras({{"meniscus_surface_tension", 0.05}, {"meniscus_density", 900}}).materials[0];
  ASSERT_TRUE(m.liquid);
  EXPECT_EQ(m.liquid->kind, "custom");
  EXPECT_EQ(m.ior, 1.5);
  expect_error(document_with_extras({{"meniscus_liquid", "custom"}, {"meniscus_density", 900}}),
               {"material \"stuff\"", "no meniscus_surface_tension"});
  expect_error(document_with_extras({{"meniscus_surface_tension", 0.07}}), {"no meniscus_density"});
}

TEST_F(SceneContent, ExtrasOfSolids) {
  Document document = document_with_extras({{"meniscus_contact_angle", 60},
                                            {"meniscus_contact_angle_Lake", 12.5},
                                            {"meniscus_contact_angle_Lak", 1},
                                            {"meniscus_ignore", true},
                                            {"meniscus_target", 1},
                                            {"dielectric_priority", 7}});
  document.json["materials"].push_back({{"name", "Lake"}, {"extras", {{"meniscus_liquid", "water"}}}});
  const Scene scene = load(document);
  const Material& m = scene.materials[0];
  EXPECT_EQ(m.contact_angle, 60);
  EXPECT_EQ(m.contact_angle_with.at("Lake"), 12.5);
  EXPECT_TRUE(m.meniscus_ignore);
  EXPECT_TRUE(m.target);
  EXPECT_EQ(m.dielectric_priority, 7);
  EXPECT_EQ(count_warnings(scene, {"meniscus_contact_angle_Lak", "Lake"}), 1u);
  EXPECT_EQ(count_warnings(scene, {"meniscus_contact_angle_Lake names"}), 0u);
}

TEST_F(SceneContent, WrongExtrasAreErrorsThatNameMaterialKeyAndRange) {
  const auto wrong = [&](const Json& extras, const std::string& part) {
    expect_error(document_with_extras(extras), {"material \"stuff\"", extras.begin().key(), part});
  };
  wrong({{"meniscus_contact_angle", 181}}, "from 0 to 180");
  wrong({{"meniscus_contact_angle", -1}}, "from 0 to 180");
  wrong({{"meniscus_contact_angle", "30"}}, "the text \"30\"");
  wrong({{"meniscus_contact_angle_water", 200}}, "from 0 to 180");
  wrong({{"meniscus_surface_tension", -0.07}}, "-0.07");
  wrong({{"meniscus_density", 0}}, "above 0");
  wrong({{"meniscus_ignore", 2}}, "1 or 0");
  wrong({{"dielectric_priority", 1.5}}, "integer");
  wrong({{"meniscus_liquid", "watr"}}, "olive oil");
  wrong({{"meniscus_liquid", 1}}, "water");
  expect_error(document_with_extras({{"meniscus_liquid", "water"}, {"meniscus_profile", "square"}}), {"circular"});
}

TEST_F(SceneContent, MisspeltAndMisplacedKeysAreMentioned) {
  Document document = document_with_extras({{"meniscus_contactangle", 30}, {"anything", 1}});
  document.json["nodes"][0]["extras"]["meniscus_liquid"] = "water";
  const Scene scene = load(document);
  EXPECT_EQ(count_warnings(scene, {"meniscus_contactangle", "did you mean meniscus_contact_angle?"}), 1u);
  EXPECT_EQ(count_warnings(scene, {"node \"thing\"", "meniscus_liquid", "read from materials"}), 1u);
  EXPECT_EQ(count_warnings(scene, {"anything"}), 0u);
}

TEST_F(SceneContent, SceneExtras) {
  Document document = triangle();
  document.json["scenes"][0]["extras"]["gravity"] = 1.62;
  EXPECT_EQ(load(document).gravity, 1.62);
  document.json["scenes"][0]["extras"]["gravity"] = 0;
  expect_error(document, {"gravity", "above 0"});
  EXPECT_EQ(load(triangle()).gravity, 9.80665);
}

TEST_F(SceneContent, BothCameraTypes) {
  Document document = triangle();
  document.json["cameras"] = {
      {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"aspectRatio", 1.5}, {"znear", 0.01}}}},
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 2}, {"ymag", 3}, {"znear", 0.1}, {"zfar", 9}}}}};
  const double h = std::sqrt(0.5);
  document.json["nodes"].push_back(
      {{"name", "near"}, {"camera", 0}, {"translation", {1, 2, 3}}, {"rotation", {-h, 0, 0, h}}, {"scale", {2, 5, 3}}});
  document.json["nodes"].push_back({{"name", "far"}, {"camera", 1}});
  document.json["scenes"][0]["nodes"] = {0, 1, 2};
  const Scene scene = load(document);
  ASSERT_EQ(scene.cameras.size(), 2u);
  const Camera& near = scene.cameras[0];
  EXPECT_EQ(near.name, "near");
  EXPECT_FALSE(near.orthographic);
  EXPECT_EQ(near.yfov, 0.5);
  EXPECT_EQ(near.aspect, 1.5);
  EXPECT_EQ(near.znear, 0.01);
  EXPECT_NEAR3(dvec3(near.pose[3]) + scene.origin, dvec3(1, 2, 3), 1e-12);
  EXPECT_NEAR3(-dvec3(near.pose[2]), dvec3(0, -1, 0), 1e-12);  // looks down; scale does not matter
  EXPECT_NEAR3(dvec3(near.pose[1]), dvec3(0, 0, -1), 1e-12);
  EXPECT_NEAR3(dvec3(near.pose[0]), dvec3(1, 0, 0), 1e-12);
  EXPECT_TRUE(scene.cameras[1].orthographic);
  EXPECT_EQ(scene.cameras[1].xmag, 2);
  EXPECT_EQ(scene.cameras[1].ymag, 3);
  EXPECT_EQ(count_warnings(scene, {"no camera"}), 0u);

  document.json["cameras"][0]["perspective"]["yfov"] = 0;
  expect_error(document, {"yfov is 0"});
}

TEST_F(SceneContent, ADefaultCameraSeesEverything) {
  Document document = triangle();
  document.json["nodes"][0]["translation"] = {50, 0, 0};
  const Scene scene = load(document);
  EXPECT_EQ(count_warnings(scene, {"no camera"}), 1u);
  ASSERT_EQ(scene.cameras.size(), 1u);
  const glm::dmat4 to_camera = glm::inverse(scene.cameras[0].pose);
  EXPECT_NEAR(-scene.cameras[0].pose[2].y, -std::sqrt(0.5), 1e-12);
  for (const dvec3& p : scene.objects[0].mesh.positions) {
    const dvec3 q(to_camera * glm::dvec4(p, 1));
    EXPECT_LT(q.z, 0);
    EXPECT_LE(std::hypot(q.x, q.y), -q.z * std::tan(0.5 * scene.cameras[0].yfov) + 1e-12);
  }
}

TEST_F(SceneContent, PunctualLights) {
  Document document = triangle();
  document.json["extensionsRequired"] = {"KHR_lights_punctual"};
  document.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "directional"},
       {"name", "sun"},
       {"intensity", 2},
       {"color", {1, 0.5, 0.25}},
       {"extras", {{"angular_diameter", 0.53}}}},
      {{"type", "point"}, {"intensity", 3}, {"range", 4}},
      {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.2}}}}};
  const double h = std::sqrt(0.5);
  for (int i = 0; i < 3; ++i) {
    document.json["nodes"].push_back({{"translation", {1, 2, i}},
                                      {"rotation", {-h, 0, 0, h}},
                                      {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    document.json["scenes"][0]["nodes"].push_back(i + 1);
  }
  const Scene scene = load(document);
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[0].type, PunctualLight::Type::directional);
  EXPECT_EQ(scene.lights[0].name, "sun");
  EXPECT_EQ(scene.lights[0].intensity, dvec3(2, 1, 0.5));
  EXPECT_NEAR3(scene.lights[0].direction, dvec3(0, -1, 0), 1e-12);
  EXPECT_NEAR(scene.lights[0].angular_diameter, 0.53 * pi / 180, 1e-12);
  EXPECT_EQ(scene.lights[1].type, PunctualLight::Type::point);
  EXPECT_NEAR3(scene.lights[1].position + scene.origin, dvec3(1, 2, 1), 1e-12);
  EXPECT_EQ(count_warnings(scene, {"light 1", "range is ignored"}), 1u);
  EXPECT_EQ(scene.lights[2].type, PunctualLight::Type::spot);
  EXPECT_EQ(scene.lights[2].inner_cone, 0.1);
  EXPECT_EQ(scene.lights[2].outer_cone, 0.2);
  EXPECT_EQ(count_warnings(scene, {"neither a light"}), 0u);

  document.json["extensions"]["KHR_lights_punctual"]["lights"][2]["spot"]["innerConeAngle"] = 0.3;
  expect_error(document, {"light 2", "innerConeAngle"});
}

TEST_F(SceneContent, DarknessIsMentioned) {
  EXPECT_EQ(count_warnings(load(triangle()), {"neither a light"}), 1u);
  Document document = triangle();
  document.json["materials"][0]["emissiveFactor"] = {0, 1, 0};
  EXPECT_EQ(count_warnings(load(document), {"neither a light"}), 0u);
}

}  // namespace
}  // namespace meniscal::testing
