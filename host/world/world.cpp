#include "host/world/world.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/error.h"
#include "host/stopwatch.h"
#include "host/world/cdf.h"
#include "host/world/light_view.h"
#include "host/world/lights.h"
#include "host/world/media.h"
#include "host/world/menisci.h"
#include "host/world/surfaces.h"
#include "host/world/textures.h"
#include "host/world/triangles.h"
#include "shaders/shared/material.h"
#include "shaders/shared/random.h"

namespace meniscal {
namespace {

// Six times the signed volume: negative where a closed mesh faces inward.
double signed_volume(const meniscus::TriangleMesh& mesh) {
  double sum = 0;
  for (const glm::uvec3& t : mesh.triangles)
    sum += glm::dot(mesh.positions[t.x], glm::cross(mesh.positions[t.y], mesh.positions[t.z]));
  return sum;
}

// Puts triangles into the order of the BVH's leaves.
void build_hierarchy(World& world) {
  const Stopwatch watch;
  std::vector<Triangle> corners;
  corners.reserve(world.triangles.size());
  for (const WorldTriangle& t : world.triangles) corners.push_back({t.corner[0], t.corner[1], t.corner[2]});
  world.bvh = build_bvh(corners);
  std::vector<WorldTriangle> ordered;
  ordered.reserve(corners.size());
  for (std::uint32_t i : world.bvh.order) ordered.push_back(world.triangles[i]);
  world.triangles = std::move(ordered);
  world.bvh_seconds = watch.seconds();
}

void build_strata(World& world) {
  Stratum targeted{.name = "targeted", .map = shared::MAP_TARGETED};
  Stratum caustic{.name = "caustic", .map = shared::MAP_CAUSTIC};
  // Light from outside does not meet first what is inside solids.
  const bool lit_within = std::any_of(world.lights.begin(), world.lights.end(),
                                      [](const shared::Light& light) { return light.media.x != 0; });
  for (Stratum* s : {&targeted, &caustic}) {
    const Stopwatch watch;
    s->first = static_cast<std::uint32_t>(world.targets.size());
    for (std::uint32_t i = 0; i < world.triangles.size(); ++i) {
      const WorldTriangle& t = world.triangles[i];
      if (world.surfaces[t.material].specular == 0 || t.meniscus != (s == &targeted)) continue;
      if (t.within && !lit_within) continue;
      world.targets.push_back(i);
      s->area += t.area;
    }
    s->count = static_cast<std::uint32_t>(world.targets.size()) - s->first;
    append_cdf(world.cdf, s->count, [&](std::size_t i) { return world.triangles[world.targets[s->first + i]].area; });
    if (s->count == 0) continue;
    world.strata.push_back(*s);
    world.stages.add(s->name + " map", watch.seconds());
  }
  world.light_first = static_cast<std::uint32_t>(world.cdf.size());
  for (const shared::Light& light : world.lights) {
    const bool may = light.type == shared::LIGHT_DIRECTIONAL && !world.targets.empty();
    world.views.push_back(may ? world.stages.run("light views", [&] { return find_light_view(world, light); })
                              : std::nullopt);
  }
  const auto power = [&](std::size_t i) { return double(world.lights[i].probability); };
  append_cdf(world.cdf, world.lights.size(), power);
  world.near_first = static_cast<std::uint32_t>(world.cdf.size());
  append_cdf(world.cdf, world.lights.size(), [&](std::size_t i) { return world.views[i] ? 0 : power(i); });
}

void build_lights(World& world, const Scene& scene) {
  world.lights = make_lights(scene, world, world.stages);
  for (std::uint32_t i = 0; i < world.lights.size(); ++i) {
    const shared::Light& light = world.lights[i];
    if (is_sun(light)) ++world.suns;
    if (light.type == shared::LIGHT_AREA) world.triangles[light.triangle].light = i + 1;
    world.extended_lights |=
        light.type == shared::LIGHT_AREA || light.type == shared::LIGHT_ENVIRONMENT || is_sun(light);
  }
}

// Whether an outer face above a diffuse surface reflects; where textures tell how much of a metal it is, it may.
bool reflects_beyond_lambert(const World& world) {
  return std::any_of(world.surfaces.begin(), world.surfaces.end(), [&](const shared::Surface& s) {
    return shared::is_glossy(s) || (s.textures != 0 && world.textured[s.textures - 1].metallic > 0);
  });
}

// Surfaces by material; a material of closed and of open meshes gets a second one, since only the closed ones refract.
// Gives each material's surface on closed meshes.
std::vector<std::uint32_t> build_surfaces(World& world, const Scene& scene) {
  const std::size_t materials = scene.materials.size();
  std::vector<bool> on_open(materials, false), on_closed(materials, false);
  std::vector<int> priorities;  // by surface
  for (const Object& o : scene.objects) (o.closed ? on_closed : on_open)[o.material] = true;
  const auto add = [&](const Material& m, bool closed, bool used) {
    // What no object is made of costs nothing: it is there for its place in the table.
    world.surfaces.push_back(used ? make_surface(m, closed) : shared::Surface{});
    if (used) world.surfaces.back().textures = add_textures(world, m);
    world.material_names.push_back(m.name);
    priorities.push_back(dielectric_priority(m));
    return static_cast<std::uint32_t>(world.surfaces.size() - 1);
  };
  std::vector<std::uint32_t> closed_surface;
  for (std::size_t i = 0; i < materials; ++i) {
    const Material& m = scene.materials[i];
    closed_surface.push_back(add(m, on_closed[i] && !on_open[i], on_closed[i] || on_open[i]));
    if (largest_roughness(m) < specular_roughness) continue;
    if (m.liquid)
      world.warnings.push_back(
          fmt::format("{}: material \"{}\": liquids are smooth here; its roughness {:.3g} is taken as 0", scene.file,
                      m.name, m.roughness));
  }
  for (std::size_t i = 0; i < materials; ++i)
    if (on_closed[i] && on_open[i] && world.surfaces[i].kind == shared::SPECULAR_THIN)
      closed_surface[i] = add(scene.materials[i], true, true);
  rank_dielectrics(world.surfaces, priorities);
  return closed_surface;
}

}  // namespace

World build_world(const Scene& scene, MeniscusModel model, const MeniscusTolerance& tolerance) {
  World world;
  const Stopwatch watch;
  const std::vector<std::uint32_t> closed_surface = build_surfaces(world, scene);
  const std::vector<LiquidSurface> liquids = raise_menisci(scene, model, tolerance, world.warnings, world.stages);
  auto next = liquids.begin();
  for (const Object& object : scene.objects) {
    const Material& m = scene.materials[object.material];
    const auto material = static_cast<std::uint32_t>(object.material);
    if (m.liquid) {
      const meniscus::Surface& surface = (next++)->surface;
      append(world.triangles, surface.mesh, {.material = material}, &surface.meniscus);
      add_volume(world, object, material, &surface.mesh);
      world.liquids.push_back(
          {object.name, surface.contacts,
           std::accumulate(surface.contacts.begin(), surface.contacts.end(), std::size_t{0},
                           [](std::size_t sum, const meniscus::Contact& c) { return sum + c.triangles; }),
           surface.solution});
      continue;
    }
    if (object.closed && m.transmission > 0 && signed_volume(object.mesh) < 0)
      world.warnings.push_back(
          fmt::format("{}: object \"{}\": its faces point inward, so it is a cavity in its own material; turn its "
                      "normals outward for a solid",
                      scene.file, object.name));
    const std::uint32_t surface = object.closed ? closed_surface[material] : material;
    const bool textured = has_textures(m) && !object.coordinates.empty();
    append(world.triangles, object.mesh,
           {.material = surface,
            .coordinates = textured ? static_cast<std::uint32_t>(world.coordinates.size()) + 1 : 0,
            .meniscus = m.target});
    if (textured)
      world.coordinates.insert(world.coordinates.end(), object.coordinates.begin(), object.coordinates.end());
    add_volume(world, object, surface, nullptr);
  }
  // What is inside solids, light meets only where these let it in.
  for (const LiquidSurface& liquid : liquids)
    append(world.triangles, keep_seen(world, liquid.surface.within),
           {.material = static_cast<std::uint32_t>(scene.objects[liquid.object].material), .within = true});
  world.meniscus_seconds = watch.seconds();
  if (world.triangles.empty())
    throw Error(ExitCode::scene, scene.file + ": no triangle with an area; nothing to render");

  if (const std::size_t dropped = drop_coincident(world.triangles, world.surfaces); dropped > 0)
    world.warnings.push_back(
        fmt::format("{}: faces that lie on others of the same material are left out ({}); merge "
                    "vertices by distance, or remove the double of an object",
                    scene.file, dropped));
  world.radius = radius_of(world.triangles);
  build_hierarchy(world);
  build_lights(world, scene);
  world.glossy = reflects_beyond_lambert(world);
  const bool extentless = std::any_of(world.lights.begin(), world.lights.end(), [](const shared::Light& l) {
    return l.type == shared::LIGHT_POINT || l.type == shared::LIGHT_SPOT ||
           (l.type == shared::LIGHT_DIRECTIONAL && !is_sun(l));
  });
  if (extentless && std::any_of(world.surfaces.begin(), world.surfaces.end(), shared::is_rough_specular))
    world.warnings.push_back(scene.file +
                             ": frosted glass shows no lights without extent, though it lets their light "
                             "through; give suns an angular_diameter, make lamps of emissive meshes");
  find_media(world);
  build_strata(world);
  if (scene.environment)
    world.environment =
        world.stages.run("environment", [&] { return make_environment(*scene.environment, world.cdf); });
  return world;
}

}  // namespace meniscal
