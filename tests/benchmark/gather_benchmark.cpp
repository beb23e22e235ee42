// Grid and gather on the GPU passes against plain C++: CPU seconds for the same photons, pixels and irradiance.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "host/cpu_seconds.h"
#include "tests/benchmark/worlds.h"
#include "tests/support/gpu_map.h"
#include "tests/support/scalar_gather.h"

namespace meniscal::bench {
namespace {

void gather(benchmark::State& state) {
  const auto setup = make_setup(dented_water(50000), static_cast<std::uint32_t>(state.range(0)));
  const gpu::Device device = gpu::Device::open("auto");
  test::GpuMap map(device, setup->world, setup->settings);
  map.prepare();
  const auto discs = map.photons.discs.download<shared::PhotonDisc>();
  map.build_grid(0);  // compiles
  map.gather_from_grid();
  const auto samples = map.samples();

  double grid_least = 1e9, gather_least = 1e9, scalar_grid_least = 1e9, scalar_gather_least = 1e9, worst = 0, found = 0;
  for (auto _ : state) {
    map.prepare();
    double grid = 0, gather = 0;
    for (std::uint32_t first = 0; first < map.count;) {
      grid += cpu_seconds_of([&] { first += map.build_grid(first); });
      gather += cpu_seconds_of([&] { map.gather_from_grid(); });
    }
    grid_least = std::min(grid_least, grid), gather_least = std::min(gather_least, gather);
    state.SetIterationTime(grid + gather);

    std::optional<test::ScalarGrid> scalar;
    scalar_grid_least = std::min(scalar_grid_least, cpu_seconds_of([&] { scalar.emplace(discs, map.grid); }));
    std::vector<glm::vec3> irradiance(samples.size());
    scalar_gather_least = std::min(scalar_gather_least, cpu_seconds_of([&] {
                                     for (std::size_t i = 0; i < samples.size(); ++i)
                                       if (samples[i].triangle < shared::END_FIRST)
                                         irradiance[i] = scalar->irradiance(samples[i].position, samples[i].normal);
                                   }));
    double mean = 0;
    worst = found = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      mean += double(irradiance[i].y) / double(samples.size());
      found += double(samples[i].targeted_count + samples[i].caustic_count) / double(samples.size());
      worst = std::max(worst, double(std::abs(samples[i].targeted.y + samples[i].caustic.y - irradiance[i].y)));
    }
    worst /= mean;
  }
  if (!(worst < 1e-4)) state.SkipWithError("GPU and plain C++ give different irradiance");
  state.counters["grid_ms"] = 1e3 * grid_least;
  state.counters["gather_ms"] = 1e3 * gather_least;
  state.counters["scalar_grid_ms"] = 1e3 * scalar_grid_least;
  state.counters["scalar_gather_ms"] = 1e3 * scalar_gather_least;
  state.counters["speed_of_scalar"] = (scalar_grid_least + scalar_gather_least) / (grid_least + gather_least);
  state.counters["found"] = found;
  state.counters["levels"] = map.grid.levels;
  state.counters["difference"] = worst;
}

BENCHMARK(gather)->ArgName("photons")->Arg(30000)->Arg(1000000)->Iterations(3)->UseManualTime()->Unit(
    benchmark::kMillisecond);

}  // namespace
}  // namespace meniscal::bench
