// The shaders' traversal against Embree's single rays, on the same triangles and rays: CPU seconds a ray.
#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include <algorithm>

#include "host/cpu_seconds.h"
#include "shaders/shared/random.h"
#include "tests/benchmark/worlds.h"
#include "tests/support/gpu_rays.h"

namespace meniscal::bench {
namespace {

using test::Ray, test::Hit, test::GpuRays, test::no_triangle;

// Rays of photons as they are started in the light's view, in that order.
std::vector<Ray> photon_rays(const World& world, std::uint32_t count) {
  const LightView& view = world.views.at(0).value();
  std::vector<Ray> rays;
  for (std::uint32_t i = 0; i < count; ++i) {
    const glm::uvec2 point = shared::sobol_point({0, 0, shared::STREAM_BEAM, i});
    const glm::dvec3 origin =
        view.corner + double(shared::unit_float(point.x)) * view.u + double(shared::unit_float(point.y)) * view.v;
    rays.push_back({glm::vec3(origin), no_triangle, world.lights[0].direction, 1e30f});
  }
  return rays;
}

// Where rays go on behind what they hit, unbent: to the floor or the rod.
std::vector<Ray> rays_behind(const std::vector<Ray>& rays, const std::vector<Hit>& hits) {
  std::vector<Ray> behind;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (hits[i].triangle == no_triangle) continue;
    behind.push_back({rays[i].origin + hits[i].t * rays[i].direction, hits[i].triangle, rays[i].direction, 1e30f});
  }
  return behind;
}

// Cosine-distributed rays from where `rays` hit, to the side they came from.
std::vector<Ray> bounce_rays(const World& world, const std::vector<Ray>& rays, const std::vector<Hit>& hits) {
  std::vector<Ray> bounced;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (hits[i].triangle == no_triangle) continue;
    const WorldTriangle& t = world.triangles[hits[i].triangle];
    const glm::dvec3 incoming(rays[i].direction), n = glm::dot(incoming, t.geometric) < 0 ? t.geometric : -t.geometric;
    const glm::uvec4 bits = shared::pcg4d({static_cast<std::uint32_t>(i), 7, 0, 0});
    const double height = 2 * double(shared::unit_float(bits.x)) - 1, ring = std::sqrt(1 - height * height),
                 angle = glm::two_pi<double>() * double(shared::unit_float(bits.y));
    // A point of the unit sphere that touches the surface: Lambert's cosine law.
    const glm::dvec3 direction =
        glm::normalize(1.0001 * n + glm::dvec3(ring * std::cos(angle), height, ring * std::sin(angle)));
    const glm::dvec3 origin = glm::dvec3(rays[i].origin) + double(hits[i].t) * incoming + 1e-7 * n;
    bounced.push_back({glm::vec3(origin), hits[i].triangle, glm::vec3(direction), 1e30f});
  }
  return bounced;
}

class EmbreeRays {
 public:
  explicit EmbreeRays(const World& world) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    const std::size_t count = world.triangles.size();
    auto* vertices = static_cast<glm::vec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), 3 * count));
    auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), count));
    for (std::uint32_t i = 0; i < 3 * count; ++i) {
      vertices[i] = glm::vec3(world.triangles[i / 3].corner[i % 3]);
      indices[i] = i;
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~EmbreeRays() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeRays(const EmbreeRays&) = delete;
  EmbreeRays& operator=(const EmbreeRays&) = delete;

  void intersect(const std::vector<Ray>& rays, std::vector<Hit>& hits) const {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Ray& r = rays[i];
      RTCRayHit query{};
      query.ray = {r.origin.x, r.origin.y, r.origin.z, 0, r.direction.x, r.direction.y, r.direction.z, 0,
                   r.reach,    ~0u,        0,          0};
      query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      rtcIntersect1(scene_, &context, &query);
      const bool hit = query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
      hits[i] = {query.ray.tfar, hit ? query.hit.primID : no_triangle, query.hit.u, query.hit.v};
    }
  }

 private:
  RTCDevice device_ = rtcNewDevice(nullptr);
  RTCScene scene_ = rtcNewScene(device_);
};

// Along a curve that fills the plane, so that neighbours in the list are neighbours in space.
void sort_by_place(std::vector<Ray>& rays) {
  glm::vec3 low(1e30f), high(-1e30f);
  for (const Ray& r : rays) low = glm::min(low, r.origin), high = glm::max(high, r.origin);
  const auto code = [&](const Ray& r) {
    const glm::uvec3 cell(1023.f * (r.origin - low) / glm::max(high - low, glm::vec3(1e-30f)));
    std::uint32_t bits = 0;
    for (int b = 9; b >= 0; --b)
      for (int axis = 0; axis < 3; ++axis) bits = 2 * bits + (cell[axis] >> b & 1);
    return bits;
  };
  std::ranges::stable_sort(rays, {}, code);
}

enum class Kind { photons, sorted_photons, bounces };

// Both in turns, so that what else the machine does slows both; the least of each counts.
void compare(benchmark::State& state, const Scene& scene, Kind kind) {
  const auto setup = make_setup(scene, 1u << 16);
  const World& world = setup->world;
  const EmbreeRays embree(world);
  std::vector<Ray> rays = photon_rays(world, 1u << 18);
  std::vector<Hit> expected(rays.size());
  const auto follow = [&](std::vector<Ray> next) {
    rays = std::move(next);
    expected.resize(rays.size());
    embree.intersect(rays, expected);
  };
  if (kind == Kind::sorted_photons) sort_by_place(rays);
  follow(rays);
  if (kind == Kind::bounces) {
    follow(rays_behind(rays, expected));
    follow(bounce_rays(world, rays, expected));
  }
  const gpu::Device device = gpu::Device::open("auto");
  GpuRays gpu(device, world, rays);
  gpu.intersect();  // compiles
  const std::vector<Hit> hits = gpu.hits();
  std::size_t differ = 0;  // hits beside an edge, or on its other side
  for (std::size_t i = 0; i < rays.size(); ++i) differ += hits[i].triangle != expected[i].triangle;
  double gpu_least = 1e9, embree_least = 1e9;
  for (auto _ : state) {
    const double seconds = cpu_seconds_of([&] { gpu.intersect(); });
    state.SetIterationTime(seconds);
    gpu_least = std::min(gpu_least, seconds);
    embree_least = std::min(embree_least, cpu_seconds_of([&] { embree.intersect(rays, expected); }));
  }
  state.counters["ns_per_ray"] = 1e9 * gpu_least / double(rays.size());
  state.counters["embree_ns_per_ray"] = 1e9 * embree_least / double(rays.size());
  state.counters["speed_of_embree"] = embree_least / gpu_least;
  state.counters["differ_ppm"] = 1e6 * double(differ) / double(rays.size());
}

void photon_rays_in_water(benchmark::State& state) {
  compare(state, dented_water(static_cast<std::size_t>(state.range(0))), Kind::photons);
}
void sorted_photon_rays_in_water(benchmark::State& state) {
  compare(state, dented_water(static_cast<std::size_t>(state.range(0))), Kind::sorted_photons);
}
// From the floor and from a rod.
void bounce_rays_in_water(benchmark::State& state) {
  compare(state, rod_in_water(static_cast<std::size_t>(state.range(0)), 64, 40), Kind::bounces);
}
// Long thin triangles, and the same rod cut fine.
void photon_rays_on_rod(benchmark::State& state) {
  compare(state, rod_in_water(50000, 64, static_cast<std::uint32_t>(state.range(0))), Kind::photons);
}

void settings(benchmark::internal::Benchmark* b) { b->Iterations(5)->UseManualTime()->Unit(benchmark::kMillisecond); }
void triangles(benchmark::internal::Benchmark* b) { b->ArgName("triangles")->Arg(50000)->Arg(500000)->Apply(settings); }

BENCHMARK(photon_rays_in_water)->Apply(triangles);
BENCHMARK(sorted_photon_rays_in_water)->Apply(triangles);
BENCHMARK(bounce_rays_in_water)->Apply(triangles);
BENCHMARK(photon_rays_on_rod)->ArgName("rows")->Arg(1)->Arg(40)->Apply(settings);

}  // namespace
}  // namespace meniscal::bench
