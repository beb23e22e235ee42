// Exported scenes, read again.
#include <numbers>

#include "host/cli/render_settings.h"
#include "host/export/container.h"
#include "host/export/export.h"
#include "host/reference/backend.h"
#include "host/world/world.h"
#include "tests/support/scene_setup.h"
#include "tests/unit/scene_fixture.h"

namespace meniscal::testing {
namespace {

using gltf::OrderedJson;

class Export : public SceneFiles {
 protected:
  gltf::Exported exported(const std::string& path) { return gltf::export_with_menisci(path, MeniscusModel::paper); }
  World world_of(gltf::Document document, const std::string& name = "exported.glb") {
    return build_world(load(gltf::as_glb(std::move(document)), name), MeniscusModel::paper);
  }
  static std::string shipped(const std::string& name) { return SCENES "/" + name + ".gltf"; }
  static OrderedJson json_of(const std::string& path) { return OrderedJson::parse(std::ifstream(path)); }
};

// All triangles of one map: how many, their area, and the sum of their normals and moments, which no swap or shift
// keeps.
struct Sums {
  std::size_t count = 0;
  double area = 0;
  glm::dvec3 normals{0}, moment{0};
};

Sums sums_of(const World& world, const std::string& map, const glm::dvec3& origin) {
  Sums sums;
  if (const Stratum* s = test::find_stratum(world, map))
    for (std::uint32_t i = s->first; i < s->first + s->count; ++i) {
      const WorldTriangle& t = world.triangles[world.targets[i]];
      ++sums.count;
      sums.area += t.area;
      sums.normals += t.area * (t.normal[0] + t.normal[1] + t.normal[2]) / 3.0;
      sums.moment += t.area * ((t.corner[0] + t.corner[1] + t.corner[2]) / 3.0 + origin);
    }
  return sums;
}

void expect_same(const Sums& a, const Sums& b) {
  EXPECT_EQ(a.count, b.count);
  EXPECT_NEAR(a.area, b.area, 1e-6 * b.area);
  EXPECT_NEAR3(a.normals, b.normals, 1e-6 * b.area);
  EXPECT_NEAR3(a.moment, b.moment, 1e-7 * b.area);
}

// The exported scene has the triangles of the scene whose menisci are raised at loading.
void expect_same_surfaces(const Scene& scene, const Scene& again) {
  const World before = build_world(scene, MeniscusModel::paper), after = build_world(again, MeniscusModel::paper);
  for (const char* map : {"targeted", "caustic"}) {
    SCOPED_TRACE(map);
    expect_same(sums_of(after, map, again.origin - scene.origin), sums_of(before, map, glm::dvec3(0)));
  }
  EXPECT_TRUE(after.liquids.empty());
}

TEST_F(Export, KeepsEveryShippedScenesSurfaces) {
  for (const char* name : {"post", "two_posts", "sphere", "shadow_sausage", "behind_glass", "box", "flat_water"}) {
    SCOPED_TRACE(name);
    const Scene again = load(gltf::as_glb(exported(shipped(name)).document), "again.glb");
    expect_same_surfaces(load_gltf(shipped(name)), again);
  }
}

TEST_F(Export, WritesTheSameSceneAsText) {
  const gltf::Document document = exported(shipped("post")).document;
  expect_same_surfaces(load_gltf(shipped("post")), load(gltf::as_text(document)));
}

// The liquid's node is turned, mirrored and stretched, and a parent is 10 km away.
TEST_F(Export, KeepsMenisciOfFarAndTransformedNodes) {
  OrderedJson json = json_of(shipped("post"));
  json["nodes"][1]["scale"] = {-1, 2, 1.5};
  json["nodes"][1]["rotation"] = {0, std::numbers::sqrt2 / 2, 0, std::numbers::sqrt2 / 2};
  const std::string near = write(folder / "near.gltf", json.dump());
  json["nodes"].push_back({{"name", "far"}, {"translation", {10000, 20, -10000}}, {"children", {0, 1, 2, 3, 4}}});
  json["scenes"][0]["nodes"] = {5};
  const std::string far = write(folder / "far.gltf", json.dump());
  Scene far_again = load(gltf::as_glb(exported(far).document), "far.glb");
  expect_same_surfaces(load_gltf(near), load(gltf::as_glb(exported(near).document), "near.glb"));
  far_again.origin -= glm::dvec3(10000, 20, -10000);
  expect_same_surfaces(load_gltf(near), far_again);
}

// Here the distance is in the vertices: floats could not hold the menisci beside it.
TEST_F(Export, PutsAMeshFarFromItsNodeIntoANodeNearIt) {
  gltf::Messages messages("post");
  gltf::Document document = gltf::open_document(gltf::read_source(shipped("post"), messages));
  constexpr int water = 1, positions = 3, vertices = 4;
  const std::size_t offset = document.json["bufferViews"][positions]["byteOffset"];
  for (int i = 0; i < vertices; ++i) {
    float x;
    std::memcpy(&x, &document.bytes[offset + 12 * i], 4);
    x += 4096;
    std::memcpy(&document.bytes[offset + 12 * i], &x, 4);
  }
  document.json["nodes"][water]["translation"] = {-4096, 0, 0};
  const std::string scene = write(folder / "scene.gltf", gltf::as_text(document));
  expect_same_surfaces(load_gltf(scene), load(gltf::as_glb(exported(scene).document), "again.glb"));
}

TEST_F(Export, LeavesOutTheOldLiquidAndKeepsTheRest) {
  OrderedJson json = json_of(shipped("post"));
  json["materials"][2]["extras"]["artist"] = "kept";
  json["materials"][1]["extras"]["note"] = "kept too";
  json["nodes"][4]["extras"] = {{"remark", 7}};
  const OrderedJson after = exported(write(folder / "scene.gltf", json.dump())).document.json;

  EXPECT_EQ(after["nodes"][4]["extras"]["remark"], 7);
  EXPECT_EQ(after["materials"][2], json["materials"][2]);
  EXPECT_EQ(after["cameras"], json["cameras"]);
  EXPECT_EQ(after["extensions"], json["extensions"]);
  EXPECT_EQ(after["meshes"].size(), 3u);
  EXPECT_EQ(after["accessors"].size(), 3u + 3u + 4u);  // the liquid's two primitives share their vertices

  const OrderedJson &level = after["materials"][1], &meniscus = after["materials"][3];
  EXPECT_EQ(level["extras"].dump(), R"({"note":"kept too"})");
  EXPECT_EQ(meniscus["extras"].dump(), R"({"note":"kept too","meniscus_target":1})");
  EXPECT_EQ(meniscus["name"], "water meniscus");
}

TEST_F(Export, SpellsOutWhatALiquidsNameMeans) {
  OrderedJson json = json_of(shipped("post"));
  json["materials"][1] = {{"name", "dram"},
                          {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                          {"extras", {{"meniscus_liquid", "ethanol"}}}};
  json["textures"] = {{{"source", 0}}};
  json["images"] = {{{"uri", "label.png"}}};
  write(folder / "label.png", "\x89PNG\r\n\x1a\nno more is looked at");
  const gltf::Exported all = exported(write(folder / "scene.gltf", json.dump()));
  const gltf::Document& document = all.document;
  EXPECT_EQ(std::count_if(all.warnings.begin(), all.warnings.end(),
                          [](const std::string& w) {
                            return w.find("material \"dram\": left without its textures (baseColorTexture)") !=
                                   std::string::npos;
                          }),
            1);
  const OrderedJson& level = document.json["materials"][1];
  EXPECT_EQ(level["extensions"]["KHR_materials_ior"]["ior"], 1.3611);
  EXPECT_EQ(level["extensions"]["KHR_materials_transmission"]["transmissionFactor"], 1);
  EXPECT_GT(level["extensions"]["KHR_materials_volume"]["thicknessFactor"], 0);
  EXPECT_EQ(level["pbrMetallicRoughness"].dump(), R"({"roughnessFactor":0,"metallicFactor":0.0})");

  const OrderedJson& image = document.json["images"][0];  // in the one file now
  EXPECT_FALSE(image.contains("uri"));
  const OrderedJson& view = document.json["bufferViews"][image["bufferView"].get<std::size_t>()];
  EXPECT_EQ(document.bytes.substr(view["byteOffset"], view["byteLength"]), "\x89PNG\r\n\x1a\nno more is looked at");
  EXPECT_EQ(image["mimeType"], "image/png");
}

// The liquid that a contact angle names is no liquid any more.
TEST_F(Export, IsReadAgainWithoutWarnings) {
  OrderedJson json = json_of(shipped("post"));
  json["materials"][2]["extras"] = {{"meniscus_contact_angle_water", 70}, {"meniscus_contact_angle", 40}};
  const std::string path = write(folder / "scene.gltf", json.dump());
  EXPECT_TRUE(load_gltf(path).warnings.empty());
  const gltf::Document document = exported(path).document;
  EXPECT_EQ(document.json["materials"][2]["extras"].dump(), R"({"meniscus_contact_angle":40})");
  const Scene again = load(gltf::as_glb(document), "again.glb");
  EXPECT_TRUE(again.warnings.empty()) << again.warnings.front();
  expect_same_surfaces(load_gltf(path), again);
}

// In a node that a scale of 0 flattens no meniscus can stand; turned by others, its inverse is finite rounding.
TEST_F(Export, RefusesALiquidInAFlattenedNode) {
  OrderedJson json = json_of(shipped("post"));
  json["nodes"].push_back(
      {{"name", "flat"}, {"rotation", {0.1, 0, 0, std::sqrt(0.99)}}, {"scale", {1, 0, 1}}, {"children", {1}}});
  json["nodes"].push_back({{"name", "turned"}, {"rotation", {0, 0, 0.3, std::sqrt(0.91)}}, {"children", {5}}});
  json["nodes"][1]["rotation"] = {0.2, 0, 0, std::sqrt(0.96)};
  json["scenes"][0]["nodes"] = {0, 6, 2, 3, 4};
  const std::string path = write(folder / "scene.gltf", json.dump());
  try {
    exported(path);
    ADD_FAILURE() << "exported";
  } catch (const Error& error) {
    EXPECT_EQ(error.code, ExitCode::scene);
    for (const char* part : {"object \"water\"", "a scale of 0", "give the node"})
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST_F(Export, LeavesOutASolidScaledToNothing) {
  OrderedJson json = json_of(shipped("post"));
  json["nodes"][4]["scale"] = {0, 0, 0};
  const std::string path = write(folder / "scene.gltf", json.dump());
  EXPECT_EQ(count_warnings(load_gltf(path), {"object \"post\"", "no triangle an area"}), 1u);
  const gltf::Exported result = exported(path);
  ASSERT_EQ(result.liquids.size(), 1u);
  EXPECT_TRUE(result.liquids[0].surface.contacts.empty());
}

TEST_F(Export, MercuryStaysAMirror) {
  OrderedJson json = json_of(shipped("post"));
  json["materials"][1]["extras"]["meniscus_liquid"] = "mercury";
  const std::string scene = write(folder / "scene.gltf", json.dump());
  const World world = world_of(exported(scene).document);
  expect_same_surfaces(load_gltf(scene), load_gltf((folder / "exported.glb").string()));
  for (const WorldTriangle& t : world.triangles)
    EXPECT_TRUE(!t.meniscus || world.surfaces[t.material].kind == shared::SPECULAR_MIRROR);
}

// The same light enters the targeted map.
TEST_F(Export, CarriesTheSameFlux) {
  const auto flux = [](const Scene& scene) {
    const RenderOptions options = test::small_options(20000, 8, 8);
    const World world = build_world(scene, options.meniscus);
    reference::ReferenceBackend backend(world, choose_settings(options, scene, world));
    return test::render_pass(backend, 0).tallies[shared::MAP_TARGETED];
  };
  const Tally before = flux(load_gltf(shipped("post")));
  const Tally after = flux(load(gltf::as_glb(exported(shipped("post")).document), "again.glb"));
  ASSERT_GT(before.flux_in, 0);
  EXPECT_NEAR(after.flux_in, before.flux_in, 2e-3 * before.flux_in);
  EXPECT_NEAR(after.flux_landed[0], before.flux_landed[0], 5e-3 * before.flux_landed[0]);
}

}  // namespace
}  // namespace meniscal::testing
