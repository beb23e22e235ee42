// CPU seconds and triangles of building menisci, by size of the scene.
#include <benchmark/benchmark.h>

#include "tests/support/meniscus/scenes.h"
#include "tests/unit/meniscus_shapes.h"

namespace {

void build(benchmark::State& state, const shapes::Scene& scene) {
  std::size_t triangles = 0, contacts = 0;
  for (auto _ : state) {
    const meniscus::Surface surface = meniscus::build(scene.liquid, scene.solids);
    triangles = surface.mesh.triangles.size();
    contacts = surface.contacts.size();
  }
  state.counters["triangles"] = static_cast<double>(triangles);
  state.counters["contacts"] = static_cast<double>(contacts);
}

void generated(benchmark::State& state, const char* name) {
  for (const shapes::Case& c : shapes::cases())
    if (c.name == name) return build(state, c.make());
  state.SkipWithError("no such scene");
}
BENCHMARK_CAPTURE(generated, Post, "Post")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(generated, Needles, "Needles")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(generated, ThousandNeedles, "ThousandNeedles")->Unit(benchmark::kMillisecond)->Iterations(1);

// A liquid of a million triangles and ten spheres of together 100,000.
void large(benchmark::State& state) {
  shapes::Scene scene{shapes::water(shapes::sheet(60 * shapes::kMm, 708)), {}};
  for (int i = 0; i < 10; ++i) {
    const glm::dvec3 centre(((i % 5) - 2) * 20 * shapes::kMm, 0, (i / 5 - 0.5) * 30 * shapes::kMm);
    scene.solids.push_back(shapes::solid(shapes::translated(shapes::sphere(5 * shapes::kMm, 100, 50), centre), 30,
                                         "sphere " + std::to_string(i)));
  }
  build(state, scene);
}
BENCHMARK(large)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
