#include "host/world/world.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <glm/gtc/constants.hpp>
#include <map>

#include "host/error.h"
#include "host/world/lights.h"
#include "host/world/surfaces.h"
#include "shaders/shared/random.h"

namespace meniscal {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double contact_angle(const Material& solid, const Material& liquid) {
  const auto named = solid.contact_angle_with.find(liquid.name);
  const double degrees = named != solid.contact_angle_with.end() ? named->second
                         : solid.contact_angle.value_or(liquid.liquid->default_contact_angle);
  return glm::radians(degrees);
}

meniscus::Liquid make_liquid(const Scene& scene, const Object& object, MeniscusModel model) {
  const LiquidProperties& p = *scene.materials[object.material].liquid;
  meniscus::Liquid liquid{.name = object.name,
                          .mesh = object.mesh,
                          .capillary_length = std::sqrt(p.surface_tension / (p.density * scene.gravity)),
                          .height_scale = model == MeniscusModel::none ? 0 : p.height_scale,
                          .sweep_scale = p.sweep_scale};
  if (p.height_rule == "equation2") liquid.height_rule = meniscus::HeightRule::equation2;
  return liquid;
}

std::vector<meniscus::Solid> solids_for(const Scene& scene, const Material& liquid) {
  std::vector<meniscus::Solid> solids;
  for (const Object& o : scene.objects) {
    const Material& m = scene.materials[o.material];
    if (!m.liquid && !m.target && !m.meniscus_ignore) solids.push_back({o.name, o.mesh, contact_angle(m, liquid)});
  }
  return solids;
}

void append(std::vector<WorldTriangle>& triangles, const meniscus::TriangleMesh& mesh, std::uint32_t material,
            const std::vector<std::uint8_t>* meniscus, bool target) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    WorldTriangle t{};
    for (int k = 0; k < 3; ++k) {
      t.corner[k] = mesh.positions[mesh.triangles[i][k]];
      t.normal[k] = mesh.normals[mesh.triangles[i][k]];
    }
    const glm::dvec3 cross = glm::cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0]);
    const double length = glm::length(cross);
    if (!(length > 0)) continue;
    t.geometric = cross / length;
    t.area = length / 2;
    for (glm::dvec3& n : t.normal)
      if (glm::dot(n, t.geometric) < 0) n = -n;
    t.material = material;
    t.meniscus = target || (meniscus && (*meniscus)[i]);
    triangles.push_back(t);
  }
}

// The liquid's surface with its menisci.
void append_liquid(World& world, const Scene& scene, const Object& object, MeniscusModel model) {
  const meniscus::Surface surface =
      meniscus::build(make_liquid(scene, object, model), solids_for(scene, scene.materials[object.material]));
  append(world.triangles, surface.mesh, object.material, &surface.meniscus, false);
  world.liquids.push_back({object.name, surface.contacts,
                           static_cast<std::size_t>(std::count(surface.meniscus.begin(), surface.meniscus.end(), 1))});
  for (const std::string& w : surface.warnings) world.warnings.push_back(fmt::format("{}: {}", scene.file, w));
}

// Puts triangles into the order of the BVH's leaves.
void build_hierarchy(World& world) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<Triangle> corners;
  corners.reserve(world.triangles.size());
  for (const WorldTriangle& t : world.triangles) corners.push_back({t.corner[0], t.corner[1], t.corner[2]});
  world.bvh = build_bvh(corners);
  std::vector<WorldTriangle> ordered;
  ordered.reserve(corners.size());
  for (std::uint32_t i : world.bvh.order) ordered.push_back(world.triangles[i]);
  world.triangles = std::move(ordered);
  world.bvh_seconds = seconds_since(start);
}

// Appends cumulative probabilities in units of 2^-32; the last one is 2^32 - 1, so that every number finds an entry.
template <class Weight>
void append_cdf(std::vector<std::uint32_t>& cdf, std::size_t count, double total, Weight weight) {
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    sum += weight(i);
    cdf.push_back(i + 1 == count ? 0xFFFFFFFFu : static_cast<std::uint32_t>(std::min(sum / total, 1.0) * 4294967295.0));
  }
}

void build_strata(World& world) {
  Stratum targeted{.name = "targeted", .stream = shared::STREAM_TARGETED};
  Stratum caustic{.name = "caustic", .stream = shared::STREAM_CAUSTIC};
  for (Stratum* s : {&targeted, &caustic}) {
    s->first = static_cast<std::uint32_t>(world.targets.size());
    for (std::uint32_t i = 0; i < world.triangles.size(); ++i) {
      const WorldTriangle& t = world.triangles[i];
      if (world.surfaces[t.material].specular == 0 || t.meniscus != (s == &targeted)) continue;
      world.targets.push_back(i);
      s->area += t.area;
    }
    s->count = static_cast<std::uint32_t>(world.targets.size()) - s->first;
    append_cdf(world.cdf, s->count, s->area,
               [&](std::size_t i) { return world.triangles[world.targets[s->first + i]].area; });
    if (s->count > 0) world.strata.push_back(*s);
  }
  world.light_first = static_cast<std::uint32_t>(world.cdf.size());
  append_cdf(world.cdf, world.lights.size(), 1.0, [&](std::size_t i) { return double(world.lights[i].probability); });
}

}  // namespace

World build_world(const Scene& scene, MeniscusModel model) {
  World world;
  const auto start = std::chrono::steady_clock::now();
  for (const Object& object : scene.objects) {
    const Material& m = scene.materials[object.material];
    if (m.liquid) append_liquid(world, scene, object, model);
    else append(world.triangles, object.mesh, static_cast<std::uint32_t>(object.material), nullptr, m.target);
  }
  if (model == MeniscusModel::exact && !world.liquids.empty())
    world.warnings.push_back(scene.file + ": the exact meniscus is not available yet; the paper's profile is used (--meniscus paper)");
  world.meniscus_seconds = seconds_since(start);
  if (world.triangles.empty()) throw Error(ExitCode::scene, scene.file + ": no triangle with an area; nothing to render");

  std::map<int, bool> closed;
  for (const Object& o : scene.objects) closed.try_emplace(o.material, true).first->second &= o.closed;
  for (int i = 0; i < static_cast<int>(scene.materials.size()); ++i) {
    world.surfaces.push_back(make_surface(scene.materials[i], closed.contains(i) && closed[i]));
    world.material_names.push_back(scene.materials[i].name);
  }
  for (const WorldTriangle& t : world.triangles)
    for (const glm::dvec3& c : t.corner) world.radius = std::max(world.radius, glm::length(c));
  build_hierarchy(world);
  world.lights = make_lights(scene, world.triangles, world.surfaces, world.radius);
  build_strata(world);
  return world;
}

}  // namespace meniscal
