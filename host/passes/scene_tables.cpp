#include "host/passes/scene_tables.h"

#include <algorithm>
#include <bit>

#include "host/gpu/choices.h"
#include "shaders/shared/bindings.h"

namespace meniscal::passes {
namespace {

using Texel = glm::uvec4;  // 16 bytes as shaders/fetch.glsl reads them

Texel pack(const glm::dvec3& v, std::uint32_t w) {
  const glm::vec3 f(v);
  return {std::bit_cast<std::uint32_t>(f.x), std::bit_cast<std::uint32_t>(f.y), std::bit_cast<std::uint32_t>(f.z), w};
}

std::vector<Texel> scene_texels(const World& world, const TextureTables& textures) {
  std::vector<Texel> texels(4 * (world.bvh.nodes.size() + world.triangles.size()));
  static_assert(sizeof(shared::BvhNode) == 4 * sizeof(Texel));
  std::memcpy(texels.data(), world.bvh.nodes.data(), world.bvh.nodes.size() * sizeof(shared::BvhNode));
  Texel* record = texels.data() + 4 * world.bvh.nodes.size();
  for (const WorldTriangle& t : world.triangles) {
    record[0] = pack(t.corner[0], t.material);
    record[1] = pack(t.corner[1], t.meniscus ? 1 : 0);
    record[2] = pack(t.corner[2], t.light);
    record[3] = pack(t.geometric, textures.coordinates(t.coordinates));  // the normal computed in double: float corners
                                                                         // of a small triangle would tilt it by degrees
    record += 4;
  }
  return texels;
}

std::vector<Texel> normal_texels(const World& world) {
  std::vector<Texel> texels;
  texels.reserve(3 * world.triangles.size());
  for (const WorldTriangle& t : world.triangles)
    for (const glm::dvec3& n : t.normal) texels.push_back(pack(n, 0));
  return texels;
}

static_assert(sizeof(shared::Surface) == 6 * sizeof(Texel) && sizeof(shared::Light) == 7 * sizeof(Texel));

std::vector<std::uint32_t> whole_texels(std::vector<std::uint32_t> values) {
  values.resize((values.size() + 3) / 4 * 4);
  return values;
}

template <class T>
gpu::Buffer upload(const gpu::Device& device, const char* name, const std::vector<T>& values) {
  gpu::Buffer buffer(device, name, values.size() * sizeof(T));
  buffer.upload(values);
  return buffer;
}

std::vector<std::uint32_t> constants_of(const World& world) {
  const auto any_light = [&](auto type) { return std::any_of(world.lights.begin(), world.lights.end(), type); };
  const auto any_surface = [&](std::uint32_t kind) {
    return std::any_of(world.surfaces.begin(), world.surfaces.end(), [&](const auto& s) { return s.kind == kind; });
  };
  using shared::Light;
  return {
      static_cast<std::uint32_t>(world.bvh.nodes.size()),
      any_light([](const Light& l) { return l.type == shared::LIGHT_POINT || l.type == shared::LIGHT_SPOT; }),
      any_light([](const Light& l) { return l.type == shared::LIGHT_AREA; }),
      any_surface(shared::SPECULAR_MIRROR),
      any_surface(shared::SPECULAR_DIELECTRIC),
      any_surface(shared::SPECULAR_THIN),
      std::any_of(world.surfaces.begin(), world.surfaces.end(),
                  [](const auto& s) { return s.absorption != glm::vec3(0); }),
      std::bit_cast<std::uint32_t>(static_cast<float>(world.radius)),
  };
}

std::vector<std::uint32_t> sky_constants_of(const World& world) {
  const SampledEnvironment& e = world.environment;
  return {world.suns, e.columns, e.rows, e.first, std::bit_cast<std::uint32_t>(static_cast<float>(e.turn))};
}

}  // namespace

SceneTables::SceneTables(const gpu::Device& device, const World& world, std::size_t largest_table, bool allow_texel)
    : textures(device, world),
      scene(upload(device, "scene", scene_texels(world, textures))),
      normals(upload(device, "normals", normal_texels(world))),
      surfaces(upload(device, "surfaces", world.surfaces)),
      lights(upload(device, "lights", world.lights)),
      cdf(upload(device, "cdf", whole_texels(world.cdf))),
      targets(upload(device, "targets", whole_texels(world.targets))),
      environment(upload(device, "environment", world.environment.pixels)),
      counters(upload(device, "counters", std::vector<std::uint32_t>(shared::COUNTERS, 0))),
      scene_constants(constants_of(world)),
      sky_constants(sky_constants_of(world)),
      has_directional(std::any_of(world.lights.begin(), world.lights.end(),
                                  [](const shared::Light& l) { return l.type == shared::LIGHT_DIRECTIONAL; })),
      texel(allow_texel &&
            device.choices().reads_texels(std::max(
                {largest_table, scene.bytes() / sizeof(Texel), lights.bytes() / sizeof(Texel),
                 cdf.bytes() / sizeof(Texel), environment.bytes() / sizeof(Texel), surfaces.bytes() / sizeof(Texel),
                 textures.textures.bytes() / sizeof(Texel), textures.images.bytes() / 4}))) {}

void SceneTables::collect_counters() {
  const auto now = counters.download<std::uint32_t>();
  for (std::size_t i = 0; i < now.size(); ++i) sums[i] += now[i];
  counters.upload(std::vector<std::uint32_t>(shared::COUNTERS, 0));
}

std::vector<std::uint32_t> SceneTables::constants(const PathFeatures& features) const {
  std::vector<std::uint32_t> constants = scene_constants;
  for (const bool feature : {features.differentials, features.emission, features.scattering, features.nested,
                             features.gloss, features.rough})
    constants.push_back(feature);
  constants.push_back(features.highlights);
  constants.insert(constants.end(), sky_constants.begin(), sky_constants.end());
  constants.push_back(textures.kinds);
  constants.push_back(has_directional);
  return constants;
}

std::vector<gpu::Binding> SceneTables::layout() const {
  const gpu::Kind table = texel ? gpu::Kind::texel : gpu::Kind::storage;
  return {{BIND_SCENE, table},
          {BIND_NORMALS, table},
          {BIND_SURFACES, table},
          {BIND_LIGHTS, table},
          {BIND_CDF, table},
          {BIND_TARGETS, table},
          {BIND_COUNTERS, gpu::Kind::storage},
          {BIND_ENVIRONMENT, table},
          {BIND_TEXTURES, table},
          {BIND_IMAGES, table}};
}

std::vector<gpu::Bound> SceneTables::bound() const {
  return {{BIND_SCENE, scene, gpu::Format::rgba32ui},
          {BIND_NORMALS, normals, gpu::Format::rgba32ui},
          {BIND_SURFACES, surfaces, gpu::Format::rgba32ui},
          {BIND_LIGHTS, lights, gpu::Format::rgba32ui},
          {BIND_CDF, cdf, gpu::Format::rgba32ui},
          {BIND_TARGETS, targets, gpu::Format::rgba32ui},
          {BIND_COUNTERS, counters},
          {BIND_ENVIRONMENT, environment, gpu::Format::rgba32ui},
          {BIND_TEXTURES, textures.textures, gpu::Format::rgba32ui},
          {BIND_IMAGES, textures.images, gpu::Format::r32ui}};
}

}  // namespace meniscal::passes
