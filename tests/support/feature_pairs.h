// For each feature of the plan two scenes, with and without it, that differ in nothing else.
#pragma once

#include <set>

#include "host/cli/start_backend.h"
#include "host/render/statistics.h"
#include "tests/support/scene_objects.h"
#include "tests/support/skies.h"
#include "tests/support/textured_scene.h"

namespace meniscal::test {

struct FeatureScene {
  Scene scene;
  RenderOptions options;
};
struct FeaturePair {
  std::string feature;  // of the plan
  std::function<FeatureScene(bool)> make;
  std::set<std::string> marks;  // all that the feature adds to what_ran
};
inline void PrintTo(const FeaturePair& pair, std::ostream* out) { *out << '"' << pair.feature << '"'; }

// A floor without gloss under a lamp, and a view of both: nothing of the plan but the lamp.
inline FeatureScene bare_scene() {
  FeatureScene made;
  Material floor = make_matte("floor");
  floor.specular = 0;
  made.scene.materials = {floor};
  made.scene.objects = {make_quad("floor", {-1, 0, -1}, {2, 0, 0}, {0, 0, 2}, 0)};
  PunctualLight lamp;
  lamp.position = {0.4, 1.5, 0.3};
  made.scene.lights = {lamp};
  made.scene.cameras = {camera_above({0, 0.4, 0}, 1.5)};
  made.options = small_options(500, 16, 16);
  made.options.highlight_samples = 0;
  return made;
}
inline void add_light(Scene& scene, double angular_diameter = 0) {
  scene.lights.push_back(sunlight({0.2, 1, 0.1}));
  scene.lights.back().angular_diameter = angular_diameter;
}
inline int add_material(Scene& scene, const Material& material) {
  scene.materials.push_back(material);
  return static_cast<int>(scene.materials.size()) - 1;
}
inline void add_box(Scene& scene, const Material& material, const glm::dvec3& low, const glm::dvec3& high) {
  scene.objects.push_back(
      make_box("box " + std::to_string(scene.objects.size()), add_material(scene, material), low, high));
}
// One that bends light.
inline void add_glass(Scene& scene, const std::function<void(Material&)>& edit = {}) {
  Material glass = make_clear("glass", 1.5);
  if (edit) edit(glass);
  add_box(scene, glass, {-0.3, 0.2, -0.3}, {0.1, 0.4, 0.1});
}
inline void add_mirror(Scene& scene) {
  Material mirror = make_matte("mirror");
  mirror.metallic = 1;
  mirror.roughness = 0;
  add_box(scene, mirror, {0.3, 0.1, 0.3}, {0.5, 0.2, 0.5});
}
inline Material& floor_of(Scene& scene) { return scene.materials.front(); }

// A post in water, seen from above.
inline FeatureScene post_scene(bool menisci) {
  FeatureScene made{load_gltf(std::string(SCENES) + "/post.gltf"), bare_scene().options};
  for (Material& m : made.scene.materials) m.meniscus_ignore = !menisci;
  look_down_on(made.scene, {0, 0.1, 0}, 0.006);
  return made;
}

inline std::set<std::string> join(std::set<std::string> a, const std::set<std::string>& b) {
  a.insert(b.begin(), b.end());
  return a;
}

inline const std::vector<FeaturePair>& feature_pairs() {
  const std::set<std::string> maps = {"pass cells", "pass gather", "constant KERNEL", "constant HAS_DIFFERENTIALS"};
  const std::set<std::string> caustics = {"stage photons",         "stage grid",
                                          "stage gather",          "buffer beams",
                                          "buffer photon ends",    "buffer photon discs",
                                          "buffer grid cells",     "buffer grid counts",
                                          "buffer grid entries",   "buffer gather counters",
                                          "buffer photons by cell"};
  std::set<std::string> global;
  for (const std::string& mark : caustics) global.insert(std::string(mark).insert(mark.find(' ') + 1, "global "));
  const std::set<std::string> seen_lights = {"pass highlights",         "stage highlights",
                                             "buffer highlights",       "buffer highlight pixels",
                                             "buffer highlight camera", "constant HIGHLIGHTS"};
  // Adds to the bare scene.
  const auto bare = [](const std::function<void(FeatureScene&)>& always,
                       const std::function<void(FeatureScene&)>& add) {
    return [=](bool with) {
      FeatureScene made = bare_scene();
      if (always) always(made);
      if (with) add(made);
      return made;
    };
  };
  const auto glass = [](FeatureScene& s) { add_glass(s.scene); };
  static const std::vector<FeaturePair> pairs = {
      {"menisci", post_scene, {"stage menisci", "stage targeted map", "photons targeted"}},
      {"targeted map",
       [](bool with) {
         FeatureScene made = bare_scene();
         add_glass(made.scene, [&](Material& m) { m.target = with; });
         return made;
       },
       {"stage targeted map", "photons targeted"}},
      {"caustic map", bare({}, [](FeatureScene& s) { add_mirror(s.scene); }),
       join(join(maps, caustics),
            {"stage caustic map", "photons caustic", "stage pilot", "buffer targets", "constant HAS_MIRROR"})},
      {"highlights",
       [](bool with) {
         FeatureScene made = post_scene(true);
         made.options.highlight_samples = with ? 4 : 0;
         return made;
       },
       seen_lights},
      {"interreflection", bare({}, [](FeatureScene& s) { s.options.diffuse_bounces = 2; }),
       join(join(maps, global),
            {"photons global", "constant GLOBAL", "constant HAS_EMISSION", "constant HAS_SCATTERING"})},
      {"directional lights",
       bare(glass, [](FeatureScene& s) { add_light(s.scene); }),
       {"constant HAS_DIRECTIONAL", "stage light views"}},
      {"suns",
       [](bool with) {
         FeatureScene made = bare_scene();
         add_light(made.scene, with ? glm::radians(0.53) : 0);
         return made;
       },
       {"constant SUNS"}},
      {"environment",
       bare({}, [](FeatureScene& s) { s.scene.environment = day(); }),
       {"constant ENVIRONMENT_COLUMNS", "constant ENVIRONMENT_ROWS", "constant ENVIRONMENT_FIRST", "buffer environment",
        "stage environment"}},
      {"point and spot lights",
       [](bool with) {
         FeatureScene made = bare_scene();
         if (!with) made.scene.lights.clear();
         add_light(made.scene);
         return made;
       },
       {"constant HAS_LOCAL"}},
      {"area lights",
       bare({},
            [](FeatureScene& s) {
              Material lamp = make_matte("lamp");
              lamp.specular = 0;
              lamp.emission = glm::dvec3(3);
              s.scene.objects.push_back(
                  make_quad("lamp", {0.9, 1.2, -0.3}, {-0.6, 0, 0}, {0, 0, 0.6}, add_material(s.scene, lamp)));
            }),
       {"constant HAS_AREA"}},
      {"refraction", bare([](FeatureScene& s) { add_mirror(s.scene); }, glass), {"constant HAS_DIELECTRIC"}},
      {"nested dielectrics",
       [](bool with) {
         FeatureScene made = bare_scene();
         add_glass(made.scene);
         const double shift = with ? 0.1 : 0.5;
         add_box(made.scene, make_clear("ice", 1.3), {shift - 0.1, 0.3, -0.2}, {shift + 0.2, 0.35, 0});
         return made;
       },
       {"constant HAS_NESTED", "stage media of lights"}},
      {"thin sheets",
       bare(glass,
            [](FeatureScene& s) {
              s.scene.objects.push_back(make_quad("pane", {0.2, 0.3, -0.5}, {0.3, 0, 0}, {0, 0, 0.3},
                                                  add_material(s.scene, make_clear("pane", 1.5))));
            }),
       {"constant HAS_THIN"}},
      {"mirrors", bare(glass, [](FeatureScene& s) { add_mirror(s.scene); }), {"constant HAS_MIRROR"}},
      {"gloss",
       bare(glass, [](FeatureScene& s) { floor_of(s.scene).specular = 1; }),
       {"constant HAS_GLOSS", "constant GLOSSY", "buffer pixel gloss", "buffer photon arrivals"}},
      {"frosted glass",
       bare(glass,
            [](FeatureScene& s) {
              Material frosted = make_clear("frosted", 1.5);
              frosted.roughness = 0.4;
              add_box(s.scene, frosted, {0.2, 0.2, 0.2}, {0.5, 0.3, 0.5});
            }),
       {"constant HAS_ROUGH"}},
      {"textures",
       bare({},
            [](FeatureScene& s) {
              floor_of(s.scene).base_color_texture = make_texture(
                  make_image(4, 4, false, [](std::uint32_t x, std::uint32_t) { return glm::uvec4(60 * x + 9); }), true);
            }),
       {"constant TEXTURES", "buffer textures", "buffer images"}},
      {"absorption",
       [](bool with) {
         FeatureScene made = bare_scene();
         add_glass(made.scene, [&](Material& m) { m.absorption = glm::dvec3(with ? 2 : 0); });
         return made;
       },
       {"constant HAS_ABSORPTION", "stage media of lights"}},
  };
  return pairs;
}

// As the program renders it. `passes`: so many.
struct FeatureRun {
  std::unique_ptr<Setup> setup;
  RunStatistics statistics;
};
inline FeatureRun run_feature(FeatureScene scene, const std::string& device, std::uint32_t passes = 1) {
  FeatureRun run;
  scene.options.device = device;
  run.setup = make_setup(std::move(scene.scene), scene.options);
  run.statistics.stages.add(run.setup->scene.stages);
  const auto backend = start_backend(scene.options, run.setup->world, run.setup->settings, run.statistics.stages);
  for (std::uint32_t pass = 0; pass < passes; ++pass) {
    const Tallies tallies = backend->render_pass(pass, [](const Samples&, const View&) {});
    for (std::size_t map = 0; map < tallies.size(); ++map) run.statistics.tallies[map].add(tallies[map]);
  }
  run.statistics.passes = {0, passes};
  run.statistics.backend = backend->statistics();
  return run;
}

}  // namespace meniscal::test
