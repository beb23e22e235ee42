#include "host/render/gpu_backend.h"

#include <algorithm>
#include <chrono>
#include <optional>

#include "host/passes/camera.h"
#include "host/passes/gather.h"

namespace meniscal {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::size_t most_photons(const RenderSettings& settings) {
  return settings.photons.empty() ? 0 : *std::max_element(settings.photons.begin(), settings.photons.end());
}

// Everything that photon maps need; not made for a scene without specular surfaces or lights.
struct MapPasses {
  passes::PhotonBuffers photons;
  passes::PhotonPass trace;
  passes::SortPass sort;
  passes::CellsPass cells;
  passes::GatherPass gather;

  MapPasses(const gpu::Device& device, const passes::SceneTables& tables, const std::vector<passes::PixelTile>& tiles,
            const RenderSettings& settings)
      : MapPasses(device, tables, tiles, most_photons(settings), settings.discs) {}

 private:
  MapPasses(const gpu::Device& device, const passes::SceneTables& tables, const std::vector<passes::PixelTile>& tiles,
            std::size_t capacity, const Discs& discs)
      : photons(device, capacity),
        trace(device, tables, photons, !discs.round()),
        sort(device, photons.keys, capacity),
        cells(device, photons, sort, capacity, passes::make_grid(static_cast<std::uint32_t>(capacity), discs).cells(),
              tables.texel),
        gather(device, cells, tiles, tables.texel) {}
};

}  // namespace

struct GpuBackend::Passes {
  gpu::Device device;
  const World& world;
  RenderSettings settings;
  gpu::Commands commands;
  Clock::time_point start = Clock::now();
  passes::SceneTables tables;
  double upload_seconds = seconds_since(start), compile_seconds;
  std::vector<passes::PixelTile> tiles;
  passes::CameraPass camera;
  std::optional<MapPasses> maps;

  Passes(gpu::Device d, const World& w, RenderSettings s, bool allow_texel)
      : device(std::move(d)),
        world(w),
        settings(std::move(s)),
        commands(device),
        tables(device, world, 3 * most_photons(settings), allow_texel),
        tiles(passes::make_tiles(device, settings.crop.pixels())),
        camera(device, tables, tiles) {
    if (most_photons(settings) > 0) maps.emplace(device, tables, tiles, settings);
    compile_seconds = seconds_since(start) - upload_seconds;
  }

  // By the stages of interface: seconds of "photons", "grid", "gather", and of set-up.
  std::map<std::string, double> seconds() const {
    std::map<std::string, double> sums = {{"upload", upload_seconds}, {"compile", compile_seconds}};
    for (const auto& [pass, time] : commands.seconds_by_pass())
      sums[pass == "photons" || pass == "camera" || pass == "gather" ? pass : "grid"] += time;
    return sums;
  }

  Tally tally(std::size_t stratum) const {
    const std::uint32_t started = settings.photons[stratum];
    Tally tally;
    tally.flux_landed.resize(world.surfaces.size());
    for (const shared::PhotonEnd& p : maps->photons.ends.download<shared::PhotonEnd>(0, started))
      tally.count(double(p.entered), mean_of(p.flux), p.end,
                  [&](std::uint32_t triangle) { return world.triangles[triangle].material; });
    return tally;
  }
};

GpuBackend::GpuBackend(gpu::Device device, const World& world, RenderSettings settings, bool allow_texel)
    : passes_(std::make_unique<Passes>(std::move(device), world, std::move(settings), allow_texel)) {}
GpuBackend::~GpuBackend() = default;

PassResult GpuBackend::render_pass(std::uint32_t pass) {
  Passes& p = *passes_;
  p.camera.run(p.commands, p.world, p.settings, pass);
  PassResult result;
  for (std::size_t s = 0; s < p.settings.photons.size(); ++s) {
    const std::uint32_t count = p.settings.photons[s];
    result.tallies.emplace_back().flux_landed.resize(p.world.surfaces.size());
    if (count == 0) continue;
    const passes::Grid grid = passes::make_grid(count, pass_discs(p.settings.discs, pass));
    p.maps->trace.run(p.commands, p.world, p.settings, s, pass, grid);
    p.maps->sort.record(p.commands, count, grid.digits);
    p.maps->cells.record(p.commands, count, grid.digits);
    p.maps->gather.run(p.commands, grid, p.world.strata[s].stream);
    result.tallies.back() = p.tally(s);
  }
  p.tables.collect_counters();
  for (const passes::PixelTile& tile : p.tiles) {
    const auto samples = tile.samples.download<shared::PixelSample>();
    result.samples.insert(result.samples.end(), samples.begin(), samples.end());
  }
  return result;
}

std::vector<PhotonEnd> GpuBackend::trace_photons(std::size_t stratum, std::uint32_t pass) {
  Passes& p = *passes_;
  const std::uint32_t count = p.settings.photons[stratum];
  p.maps->trace.run(p.commands, p.world, p.settings, stratum, pass,
                    passes::make_grid(count, pass_discs(p.settings.discs, pass)));
  std::vector<PhotonEnd> ends;
  for (const shared::PhotonEnd& e : p.maps->photons.ends.download<shared::PhotonEnd>(0, count))
    ends.push_back({glm::dvec3(e.position), glm::dvec3(e.flux), e.end});
  return ends;
}

Backend::Statistics GpuBackend::statistics() const {
  const Passes& p = *passes_;
  const gpu::DeviceInfo& info = p.device.info();
  return {info.name,
          info.type,
          info.driver,
          p.seconds(),
          p.device.bytes_peak(),
          p.tables.sums[shared::COUNTER_RAYS],
          p.tables.sums[shared::COUNTER_TRAVERSAL_LIMIT]};
}

}  // namespace meniscal
