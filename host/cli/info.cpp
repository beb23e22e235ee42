// meniscal info: what a scene contains, as the renderer understands it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "host/cli/commands.h"
#include "host/cli/render_options.h"
#include "host/render/contacts.h"
#include "host/render/plan.h"
#include "host/scene/scene.h"
#include "host/stopwatch.h"
#include "host/world/media.h"
#include "host/world/menisci.h"
#include "host/world/world.h"
#include "shaders/shared/material.h"

namespace meniscal {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegrees = 180 / 3.14159265358979323846;

std::string name_of(const Material& material) { return material.name.empty() ? "(unnamed)" : material.name; }

std::string light_type(PunctualLight::Type type) {
  switch (type) {
    case PunctualLight::Type::directional:
      return "directional";
    case PunctualLight::Type::point:
      return "point";
    case PunctualLight::Type::spot:
      return "spot";
  }
  return "";
}

Json triple(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

Json objects_of(const Scene& scene) {
  Json list = Json::array();
  for (const Object& o : scene.objects)
    list.push_back({{"name", o.name},
                    {"triangles", o.mesh.triangles.size()},
                    {"material", name_of(scene.materials.at(static_cast<std::size_t>(o.material)))},
                    {"closed", o.closed}});
  return list;
}

std::string optics_of(const shared::Surface& s) {
  const std::string frosted = shared::is_rough_specular(s) ? ", frosted" : "";
  switch (s.kind) {
    case shared::SPECULAR_MIRROR:
      return s.specular < 1 ? "mirror in part, diffuse below" : "mirror";
    case shared::SPECULAR_DIELECTRIC:
      return "refracts" + frosted;
    case shared::SPECULAR_THIN:
      return "thin-walled, does not refract" + frosted;
    default:
      return shared::is_glossy(s) ? "diffuse, glossy" : "diffuse";
  }
}

Json material_of(const Material& m, const shared::Surface& surface, const Scene& scene) {
  Json json{{"name", name_of(m)},
            {"optics", optics_of(surface)},
            {"base_color", triple(m.base_color)},
            {"metallic", m.metallic},
            {"roughness", m.roughness},
            {"transmission", m.transmission},
            {"ior", m.ior}};
  if (m.emission != glm::dvec3(0)) json["emission"] = triple(m.emission);
  if (m.target) json["meniscus_target"] = true;
  if (m.meniscus_ignore) json["meniscus_ignore"] = true;
  if (m.liquid) {
    json["liquid"] = {{"kind", m.liquid->kind},
                      {"surface_tension_N_per_m", m.liquid->surface_tension},
                      {"density_kg_per_m3", m.liquid->density},
                      {"capillary_length_m", capillary_length(*m.liquid, scene.gravity)},
                      {"profile", m.liquid->profile},
                      {"height_rule", m.liquid->height_rule}};
    return json;
  }
  for (const Material& other : scene.materials)
    if (other.liquid && !m.meniscus_ignore) json["contact_angle_deg"][name_of(other)] = contact_angle(m, other);
  return json;
}

Json lights_of(const Scene& scene) {
  Json list = Json::array();
  for (const PunctualLight& l : scene.lights) {
    Json json{{"name", l.name}, {"type", light_type(l.type)}, {"intensity", triple(l.intensity)}};
    if (l.type == PunctualLight::Type::directional) json["angular_diameter_deg"] = l.angular_diameter * kDegrees;
    if (l.type == PunctualLight::Type::spot) json["outer_cone_deg"] = l.outer_cone * kDegrees;
    list.push_back(json);
  }
  for (const Object& o : scene.objects) {
    const Material& m = scene.materials.at(static_cast<std::size_t>(o.material));
    if (m.emission != glm::dvec3(0))
      list.push_back({{"name", o.name}, {"type", "mesh"}, {"radiance", triple(m.emission)}});
  }
  if (scene.environment)
    list.push_back({{"name", "environment"},
                    {"type", "image"},
                    {"pixels", {scene.environment->width, scene.environment->height}},
                    {"rotation_deg", scene.environment->rotation * kDegrees}});
  return list;
}

// Images that materials read, each once.
Json textures_of(const World& world) {
  std::set<const TextureImage*> images;
  for (const Texture& texture : world.textures) images.insert(texture.image.get());
  std::size_t words = 0;
  for (const TextureImage* image : images) words += image->words.size();
  return {
      {"count", world.textures.size()}, {"images", images.size()}, {"megabytes", 4e-6 * static_cast<double>(words)}};
}

Json cameras_of(const Scene& scene) {
  Json list = Json::array();
  for (const Camera& c : scene.cameras)
    list.push_back({{"name", c.name}, {"type", c.orthographic ? "orthographic" : "perspective"}});
  return list;
}

Json plan_of(const Scene& scene, const World& world) {
  Json list = Json::array();
  for (const PlanEntry& e :
       make_plan(world, RenderOptions{}.diffuse_bounces, media_at(world, glm::dvec3(scene.cameras.front().pose[3]))))
    list.push_back({{"feature", e.feature}, {"on", e.on}, {"why", e.why}});
  return list;
}

// What each model of the menisci costs here, and how far its contact lines are from where the liquid rests, metres; for
// the exact one, how far its facets leave the surface.
Json models_of(const Scene& scene, const World& exact) {
  Json list = Json::array();
  for (const MeniscusModel model : {MeniscusModel::none, MeniscusModel::paper}) {
    const Stopwatch watch;
    std::vector<std::string> warnings;
    Stages stages;
    const std::vector<LiquidSurface> liquids = raise_menisci(scene, model, {}, warnings, stages);
    double error = 0;
    for (std::size_t l = 0; l < liquids.size(); ++l) {
      for (std::size_t i = 0; i < liquids[l].surface.contacts.size(); ++i) {
        const meniscus::Contact &is = liquids[l].surface.contacts[i], &rest = exact.liquids[l].contacts[i];
        error = std::max({error, std::abs(is.rise_min - rest.rise_min), std::abs(is.rise_max - rest.rise_max)});
      }
    }
    list.push_back({{"model", name_of(model)}, {"seconds", watch.seconds()}, {"height_error_m", error}});
  }
  double error = 0;
  for (const LiquidReport& l : exact.liquids) error = std::max(error, l.solution.height_error);
  list.push_back(
      {{"model", name_of(MeniscusModel::exact)}, {"seconds", exact.meniscus_seconds}, {"height_error_m", error}});
  return list;
}

// What `--json` prints; the text is written from the same values.
Json describe(const Scene& scene, const World& world) {
  Json materials = Json::array();
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    materials.push_back(material_of(scene.materials[i], world.surfaces.at(i), scene));
    if (std::none_of(scene.objects.begin(), scene.objects.end(),
                     [&](const Object& o) { return static_cast<std::size_t>(o.material) == i; }))
      materials.back()["optics"] = "of no object";
  }
  std::size_t triangles = 0;
  for (const Object& o : scene.objects) triangles += o.mesh.triangles.size();
  std::vector<std::string> warnings = scene.warnings;
  warnings.insert(warnings.end(), world.warnings.begin(), world.warnings.end());
  return {{"file", scene.file},
          {"hash", scene.hash},
          {"gravity_m_per_s2", scene.gravity},
          {"triangles", triangles},
          {"objects", objects_of(scene)},
          {"materials", materials},
          {"lights", lights_of(scene)},
          {"textures", textures_of(world)},
          {"cameras", cameras_of(scene)},
          {"menisci", contacts_json(world)},
          {"meniscus_models", models_of(scene, world)},
          {"plan", plan_of(scene, world)},
          {"warnings", warnings}};
}

std::string describe_material(const Json& m) {
  std::string line = fmt::format("  {:<24} ", m["name"].get<std::string>());
  if (m.contains("liquid")) {
    const Json& l = m["liquid"];
    line += fmt::format("liquid ({}), {:g} N/m, {:g} kg/m3, capillary length {:.4g} mm, profile {}, rule {}; ",
                        l["kind"].get<std::string>(), l["surface_tension_N_per_m"].get<double>(),
                        l["density_kg_per_m3"].get<double>(), 1e3 * l["capillary_length_m"].get<double>(),
                        l["profile"].get<std::string>(), l["height_rule"].get<std::string>());
  }
  line += m["optics"].get<std::string>();
  if (m["transmission"].get<double>() > 0) line += fmt::format(", ior {:g}", m["ior"].get<double>());
  line += fmt::format(", roughness {:g}, metallic {:g}", m["roughness"].get<double>(), m["metallic"].get<double>());
  if (m.contains("emission")) line += "; emits";
  if (m.contains("meniscus_target")) line += "; target of photons";
  if (m.contains("meniscus_ignore")) line += "; no meniscus";
  if (m.contains("contact_angle_deg"))
    for (const auto& [liquid, angle] : m["contact_angle_deg"].items())
      line += fmt::format("; contact angle {:g} deg with {}", angle.get<double>(), liquid);
  return line + "\n";
}

std::string describe_contact(const Json& c) {
  std::string line =
      fmt::format("  {:<24} {} in {}, {:.4g} mm {}, contact angle {:g} deg, rise {:.4g} to {:.4g} mm, {} triangles",
                  c["solid"].get<std::string>(), c["closed"].get<bool>() ? "closed" : "open",
                  c["liquid"].get<std::string>(), 1e3 * c["length_m"].get<double>(),
                  c["closed"].get<bool>() ? "round" : "long", c["contact_angle_deg"].get<double>(),
                  1e3 * c["rise_min_m"].get<double>(), 1e3 * c["rise_max_m"].get<double>(), c["triangles"].get<long>());
  const std::size_t warnings = c["warnings"].size();
  if (warnings > 0)
    line += fmt::format(", {} (below)", warnings == 1 ? "a warning" : fmt::format("{} warnings", warnings));
  return line + "\n";
}

std::string as_text(const Json& scene) {
  std::string text = fmt::format("{}: {} triangles, gravity {:g} m/s2\n", scene["file"].get<std::string>(),
                                 scene["triangles"].get<long>(), scene["gravity_m_per_s2"].get<double>());
  text += "objects\n";
  for (const Json& o : scene["objects"])
    text += fmt::format("  {:<24} {:>9} triangles, {}, {}\n", o["name"].get<std::string>(), o["triangles"].get<long>(),
                        o["closed"].get<bool>() ? "closed" : "open", o["material"].get<std::string>());
  text += "materials\n";
  for (const Json& m : scene["materials"]) text += describe_material(m);
  if (const Json& t = scene["textures"]; t["count"].get<int>() > 0)
    text += fmt::format("textures: {} of {} images, {:.3g} MB\n", t["count"].get<int>(), t["images"].get<int>(),
                        t["megabytes"].get<double>());
  text += "lights\n";
  for (const Json& l : scene["lights"])
    text += fmt::format("  {:<24} {}\n", l["name"].get<std::string>(), l["type"].get<std::string>());
  text += "cameras\n";
  for (const Json& c : scene["cameras"])
    text += fmt::format("  {:<24} {}\n", c["name"].get<std::string>(), c["type"].get<std::string>());
  text += "menisci\n";
  for (const Json& c : scene["menisci"]) text += describe_contact(c);
  text += "models of the menisci\n";
  for (const Json& m : scene["meniscus_models"])
    text += fmt::format("  {:<24} {:.2g} s, heights off by up to {:.3g} um\n", m["model"].get<std::string>(),
                        m["seconds"].get<double>(), 1e6 * m["height_error_m"].get<double>());
  text += "plan\n";
  for (const Json& e : scene["plan"])
    text += fmt::format("  {:<24} {:<3}  {}\n", e["feature"].get<std::string>(), e["on"].get<bool>() ? "on" : "off",
                        e["why"].get<std::string>());
  for (const Json& w : scene["warnings"]) text += fmt::format("warning: {}\n", w.get<std::string>());
  return text;
}

}  // namespace

void add_info(CLI::App& app) {
  struct Options {
    std::string scene;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("info", "Say what a scene contains: objects, materials, liquids, lights, cameras, warnings");
  command->add_option("SCENE", options->scene, "glTF 2.0 scene, .gltf or .glb")->required();
  command->add_flag("--json", options->json, "Print JSON");
  command->footer("Example: meniscal info scene.gltf");
  command->callback([options] {
    const Scene scene = load_gltf(options->scene);
    const Json description = describe(scene, build_world(scene, MeniscusModel::exact));
    std::fputs((options->json ? description.dump(2) + "\n" : as_text(description)).c_str(), stdout);
  });
}

}  // namespace meniscal
