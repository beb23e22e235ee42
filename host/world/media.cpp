#include "host/world/media.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <optional>

#include "host/error.h"

namespace meniscal {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// How often a closed mesh goes round a point: the solid angles of its triangles, by Van Oosterom and Strackee 1983.
double winding_number(const meniscus::TriangleMesh& mesh, const glm::dvec3& point) {
  double sum = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a = mesh.positions[t.x] - point, b = mesh.positions[t.y] - point, c = mesh.positions[t.z] - point;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    sum += 2 * std::atan2(glm::dot(a, glm::cross(b, c)),
                          la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
  }
  return sum / (4 * glm::pi<double>());
}

// Whether the first triangle straight above faces up; nothing where there is none.
std::optional<bool> below_front(const meniscus::TriangleMesh& mesh, const glm::dvec3& point) {
  double nearest = infinity;
  std::optional<bool> result;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a = mesh.positions[t.x] - point, b = mesh.positions[t.y] - point, c = mesh.positions[t.z] - point;
    // Twice the areas of the triangles with the point, seen from above; all of one sign where it lies between them.
    const double wa = b.z * c.x - b.x * c.z, wb = c.z * a.x - c.x * a.z, wc = a.z * b.x - a.x * b.z, w = wa + wb + wc;
    if (w == 0 || wa * w < 0 || wb * w < 0 || wc * w < 0) continue;
    const double height = (wa * a.y + wb * b.y + wc * c.y) / w;
    if (height > 0 && height < nearest) nearest = height, result = w > 0;
  }
  return result;
}

// How often a point is inside.
int count_inside(const Volume& volume, const glm::dvec3& point) {
  if (glm::any(glm::lessThan(point, volume.low)) || glm::any(glm::greaterThan(point, volume.high))) return 0;
  if (!volume.liquid) return std::max(0, static_cast<int>(std::lround(winding_number(volume.mesh, point))));
  // Below a solid that ends in the liquid nothing of its surface is left.
  const std::optional<bool> inside = below_front(volume.mesh, point);
  return (inside ? *inside : below_front(volume.level, point).value_or(false)) ? 1 : 0;
}

bool absorbs(const World& world, const glm::uvec4& media) {
  return media.x != 0 && world.surfaces[(media.x & shared::MEDIUM_SURFACE_MASK) - 1].absorption != glm::vec3(0);
}

// A point on the side to which the light shines.
glm::dvec3 place_of(const shared::Light& light, double radius) {
  const glm::dvec3 position(light.position);
  if (light.type != shared::LIGHT_AREA) return position;
  return position + (glm::dvec3(light.edge1) + glm::dvec3(light.edge2)) / 3.0 +
         1e-6 * radius * glm::dvec3(light.direction);
}

}  // namespace

int dielectric_priority(const Material& material) {
  return material.dielectric_priority.value_or(material.liquid || material.target ? 0 : 10);
}

void rank_dielectrics(std::span<shared::Surface> surfaces, std::span<const int> priorities) {
  std::vector<std::size_t> order;  // of one priority, the material that stands later in the scene wins
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    if (surfaces[i].kind == shared::SPECULAR_DIELECTRIC) order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return priorities[a] < priorities[b]; });
  constexpr std::size_t most = (1u << (32 - shared::MEDIUM_SURFACE_BITS)) - 1;
  for (std::size_t place = 0; place < order.size(); ++place)
    surfaces[order[place]].rank = static_cast<std::uint32_t>(std::min(1 + place, most));
}

void add_volume(World& world, const Object& object, std::uint32_t surface, const meniscus::TriangleMesh* raised) {
  if (world.surfaces[surface].kind != shared::SPECULAR_DIELECTRIC) return;
  Volume volume{object.name,
                surface,
                world.surfaces[surface].liquid != 0,
                raised ? *raised : object.mesh,
                object.mesh,
                glm::dvec3(infinity),
                glm::dvec3(-infinity)};
  for (const meniscus::TriangleMesh* mesh : {&volume.mesh, &volume.level})
    for (const glm::dvec3& p : mesh->positions)
      volume.low = glm::min(volume.low, p), volume.high = glm::max(volume.high, p);
  if (volume.liquid && !object.closed) volume.low.y = -infinity;
  world.volumes.push_back(std::move(volume));
}

meniscus::TriangleMesh keep_seen(const World& world, meniscus::TriangleMesh within) {
  std::erase_if(within.triangles, [&](const glm::uvec3& t) {
    const glm::dvec3 centre = (within.positions[t.x] + within.positions[t.y] + within.positions[t.z]) / 3.0;
    return std::none_of(world.volumes.begin(), world.volumes.end(),
                        [&](const Volume& v) { return !v.liquid && count_inside(v, centre) > 0; });
  });
  return within;
}

void find_media(World& world) {
  const std::vector<Volume>& volumes = world.volumes;
  bool absorption = false;
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    absorption = absorption || world.surfaces[volumes[i].surface].absorption != glm::vec3(0);
    for (std::size_t j = 0; j < i && world.nested.empty(); ++j)
      if (glm::all(glm::lessThan(volumes[i].low, volumes[j].high)) &&
          glm::all(glm::lessThan(volumes[j].low, volumes[i].high)))
        world.nested = fmt::format("\"{}\" and \"{}\" may overlap", volumes[j].name, volumes[i].name);
  }
  if (world.nested.empty() && !absorption) return;  // nothing hangs on where lights are
  const Stopwatch watch;
  for (shared::Light& light : world.lights) {
    if (light.type == shared::LIGHT_DIRECTIONAL || light.type == shared::LIGHT_ENVIRONMENT) continue;
    light.media = media_at(world, place_of(light, world.radius));
    if (world.nested.empty() && absorbs(world, light.media)) world.nested = "a light is in what absorbs";
  }
  world.stages.add("media of lights", watch.seconds());
}

glm::uvec4 media_at(const World& world, const glm::dvec3& point) {
  std::vector<std::uint32_t> media;
  for (const Volume& volume : world.volumes) {
    const std::uint32_t medium = shared::medium_of(world.surfaces[volume.surface].rank, volume.surface);
    const int count = count_inside(volume, point);
    if (volume.liquid && std::find(media.begin(), media.end(), medium) != media.end()) continue;
    media.insert(media.end(), static_cast<std::size_t>(count), medium);
  }
  std::stable_sort(media.begin(), media.end(), [](std::uint32_t a, std::uint32_t b) {
    return a >> shared::MEDIUM_SURFACE_BITS > b >> shared::MEDIUM_SURFACE_BITS;
  });
  if (media.size() > 4)
    throw Error(ExitCode::scene, fmt::format("({:.4g}, {:.4g}, {:.4g}) m, where a camera or a light is, lies in {} "
                                             "transparent volumes at once; 4 are the most",
                                             point.x, point.y, point.z, media.size()));
  media.resize(4, 0);
  return {media[0], media[1], media[2], media[3]};
}

std::string why_nested(const World& world, const glm::uvec4& camera_media) {
  if (!world.nested.empty()) return world.nested;
  return absorbs(world, camera_media) ? "the camera is in what absorbs" : "";
}

}  // namespace meniscal
