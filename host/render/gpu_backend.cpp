#include "host/render/gpu_backend.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "host/passes/camera.h"
#include "host/passes/gather.h"

namespace meniscal {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Photons in the buffers at once: a pass of more takes them in turns, so that memory stays bounded.
constexpr std::uint32_t most_at_once = 1u << 21;

std::uint32_t photons_at_once(const RenderSettings& settings) { return std::min(settings.photons(), most_at_once); }

// Everything that photon maps need; not made for a scene without specular surfaces or lights.
struct MapPasses {
  std::uint32_t capacity;
  passes::PhotonBuffers photons;
  passes::PhotonPass trace;
  passes::CellsPass cells;
  passes::GatherPass gather;

  MapPasses(const gpu::Device& device, const passes::SceneTables& tables, const std::vector<passes::PixelTile>& tiles,
            const World& world, const RenderSettings& settings)
      : MapPasses(device, tables, tiles, photons_at_once(settings), most_beams(world), settings) {}

 private:
  MapPasses(const gpu::Device& device, const passes::SceneTables& tables, const std::vector<passes::PixelTile>& tiles,
            std::uint32_t at_once, std::size_t beams, const RenderSettings& settings)
      : capacity(at_once),
        photons(device, capacity),
        trace(device, tables, photons, beams, settings),
        cells(device, photons, capacity, passes::most_cells, tables.texel),
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
        tables(device, world, 3 * photons_at_once(settings), allow_texel),
        tiles(passes::make_tiles(device, settings.crop.pixels())),
        camera(device, tables, tiles, !settings.discs.round()) {
    if (photons_at_once(settings) > 0) maps.emplace(device, tables, tiles, world, settings);
    compile_seconds = seconds_since(start) - upload_seconds;
  }

  // By the stages of interface: seconds of "photons", "grid", "gather", and of set-up.
  std::map<std::string, double> seconds() const {
    std::map<std::string, double> sums = {{"upload", upload_seconds}, {"compile", compile_seconds}};
    for (const auto& [pass, time] : commands.seconds_by_pass())
      sums[pass == "photons" || pass == "camera" || pass == "gather" ? pass : "grid"] += time;
    return sums;
  }

  std::vector<shared::PixelSample> samples() const {
    std::vector<shared::PixelSample> all;
    for (const passes::PixelTile& tile : tiles) {
      const std::size_t left = settings.crop.pixels() - all.size();
      const auto part = tile.samples.download<shared::PixelSample>(0, std::min<std::size_t>(tile.count, left));
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  }

  // Calls done(ends) for the photons of a pass, as many at a time as fit, with their grid.
  template <class Done>
  void trace(std::uint32_t pass, const Done& done) {
    const std::uint32_t photons = maps ? settings.photons() : 0;
    for (std::uint32_t first = 0, count = 0; first < photons; first += count) {
      count = std::min(maps->capacity, photons - first);
      const passes::Grid grid = passes::make_grid(count, pass_discs(settings.discs, pass));
      maps->trace.run(commands, world, settings, pass, first, count, grid);
      done(count, grid);
    }
  }

  std::vector<PhotonEnd> ends(std::uint32_t count) const {
    std::vector<PhotonEnd> ends;
    ends.reserve(count);
    for (const shared::PhotonEnd& e : maps->photons.ends.download<shared::PhotonEnd>(0, count))
      ends.push_back({std::signbit(e.flux.x), e.end, glm::dvec3(e.position), glm::abs(glm::dvec3(e.flux))});
    return ends;
  }

  void tally(Tallies& tallies, std::uint32_t count) const {
    for (const shared::PhotonEnd& p : maps->photons.ends.download<shared::PhotonEnd>(0, count))
      tallies[std::signbit(p.flux.x)].count(double(p.entered), mean_of(glm::abs(p.flux)), p.end,
                                            [&](std::uint32_t triangle) { return world.triangles[triangle].material; });
  }
};

GpuBackend::GpuBackend(gpu::Device device, const World& world, RenderSettings settings, bool allow_texel)
    : passes_(std::make_unique<Passes>(std::move(device), world, std::move(settings), allow_texel)) {}
GpuBackend::~GpuBackend() = default;

PassResult GpuBackend::render_pass(std::uint32_t pass) {
  Passes& p = *passes_;
  p.camera.run(p.commands, p.world, p.settings, pass);
  PassResult result;
  for (Tally& t : result.tallies) t.flux_landed.resize(p.world.surfaces.size());
  p.trace(pass, [&](std::uint32_t count, const passes::Grid& grid) {
    p.maps->cells.record(p.commands, count, grid.digits);
    p.maps->gather.run(p.commands, grid);
    p.tally(result.tallies, count);
  });
  p.tables.collect_counters();
  result.samples = p.samples();
  return result;
}

std::vector<PhotonEnd> GpuBackend::trace_photons(std::uint32_t pass) {
  std::vector<PhotonEnd> all;
  passes_->trace(pass, [&](std::uint32_t count, const passes::Grid&) {
    const std::vector<PhotonEnd> ends = passes_->ends(count);
    all.insert(all.end(), ends.begin(), ends.end());
  });
  return all;
}

std::vector<shared::PixelSample> GpuBackend::trace_camera(std::uint32_t pass) {
  passes_->camera.run(passes_->commands, passes_->world, passes_->settings, pass);
  return passes_->samples();
}

void GpuBackend::configure(const RenderSettings& settings) { passes_->settings = settings; }

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
