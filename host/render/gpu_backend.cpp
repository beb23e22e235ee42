#include "host/render/gpu_backend.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/passes/gather.h"
#include "host/passes/paths.h"
#include "host/stopwatch.h"

namespace meniscal {
namespace {

std::uint32_t photon_capacity(const RenderSettings& settings) {
  return std::min(settings.photons(), settings.photons_at_once);
}

// What photon maps need beside their photons; not made for a scene without specular surfaces or lights.
struct MapPasses {
  passes::CellsPass cells;
  passes::GatherPass gather;

  MapPasses(const gpu::Device& device, const passes::PhotonBuffers& photons, std::uint32_t capacity,
            const std::vector<passes::PixelTile>& tiles, bool texel)
      : cells(device, photons, passes::entry_capacity(capacity), passes::most_cells(capacity), texel),
        gather(device, photons, cells, tiles, texel) {}
};

}  // namespace

struct GpuBackend::Passes {
  gpu::Device device;
  const World& world;
  RenderSettings settings;
  gpu::Commands commands;
  Stopwatch set_up;
  passes::SceneTables tables;
  double upload_seconds = set_up.seconds(), compile_seconds;
  std::vector<passes::PixelTile> tiles;
  std::uint32_t capacity;  // of photons at once
  passes::PhotonBuffers photons;
  passes::PathsPass paths;
  std::optional<MapPasses> maps;
  std::uint32_t grids = 0;  // that the last pass took

  Passes(gpu::Device d, const World& w, RenderSettings s, bool allow_texel)
      : device(std::move(d)),
        world(w),
        settings(std::move(s)),
        commands(device),
        tables(device, world, passes::largest_table(photon_capacity(settings), settings.crop.pixels()), allow_texel),
        tiles(passes::make_tiles(device, settings.crop.pixels(), settings.crop.width())),
        capacity(photon_capacity(settings)),
        photons(device, capacity),
        paths(device, world, tables, photons, tiles, settings) {
    if (capacity > 0) maps.emplace(device, photons, capacity, tiles, tables.texel);
    compile_seconds = set_up.seconds() - upload_seconds;
  }

  // By the stages of interface: seconds of "photons", "grid", "gather", and of set-up.
  std::map<std::string, double> seconds() const {
    std::map<std::string, double> sums = {{"upload", upload_seconds}, {"compile", compile_seconds}};
    for (const auto& [stage, time] : commands.seconds_by_stage()) sums[stage == "cells" ? "grid" : stage] += time;
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

  // Calls done(count, grid) for the photons of a pass, as many at a time as fit, with the grid to put them into.
  template <class Done>
  void trace(std::uint32_t pass, const Done& done) {
    const std::uint32_t started = maps ? settings.photons() : 0;
    for (std::uint32_t first = 0, count = 0; first < started; first += count) {
      count = std::min(capacity, started - first);
      const passes::Grid grid = passes::make_grid(count, pass_discs(settings.discs, pass));
      paths.trace_photons(commands, settings, pass, first, count, grid);
      tables.collect_counters();
      done(count, grid);
    }
  }

  // One camera path a pixel, lit by the photons of the pass, and how these ended.
  Tallies render(std::uint32_t pass, const View& view) {
    Tallies tallies;
    for (Tally& t : tallies) t.flux_landed.resize(world.surfaces.size());
    paths.trace_camera(commands, settings, pass, view);
    grids = 0;
    trace(pass, [&](std::uint32_t count, const passes::Grid& grid) {
      for (std::uint32_t first = 0; first < count; ++grids) {
        first += maps->cells.build(commands, grid, first, count - first);
        maps->gather.run(commands, grid);
      }
      tally(tallies, count);
    });
    return tallies;
  }

  // Another view of the pass, after render: where all photons fit into one grid, they are still there; else they are
  // traced anew.
  void render_again(std::uint32_t pass, const View& view) {
    if (grids > 1) {
      render(pass, view);
      return;
    }
    paths.trace_camera(commands, settings, pass, view);
    if (grids == 1) maps->gather.run(commands, passes::make_grid(settings.photons(), pass_discs(settings.discs, pass)));
  }

  std::vector<PhotonEnd> ends(std::uint32_t count) const {
    std::vector<PhotonEnd> ends;
    ends.reserve(count);
    for (const shared::PhotonEnd& e : photons.ends.download<shared::PhotonEnd>(0, count))
      ends.push_back({std::signbit(e.flux.x), e.end, glm::dvec3(e.position), glm::abs(glm::dvec3(e.flux))});
    return ends;
  }

  void tally(Tallies& tallies, std::uint32_t count) const {
    for (const shared::PhotonEnd& p : photons.ends.download<shared::PhotonEnd>(0, count))
      tallies[std::signbit(p.flux.x)].count(double(p.entered), mean_of(glm::abs(p.flux)), p.end,
                                            [&](std::uint32_t triangle) { return world.triangles[triangle].material; });
  }
};

GpuBackend::GpuBackend(gpu::Device device, const World& world, RenderSettings settings, bool allow_texel)
    : passes_(std::make_unique<Passes>(std::move(device), world, std::move(settings), allow_texel)) {}
GpuBackend::~GpuBackend() = default;

Tallies GpuBackend::render_pass(std::uint32_t pass, const TakeSamples& take) {
  Passes& p = *passes_;
  const std::vector<View> views = views_of(p.settings);
  Tallies tallies = p.render(pass, views.front());
  take(p.samples(), views.front());
  for (std::size_t i = 1; i < views.size(); ++i) {
    p.render_again(pass, views[i]);
    take(p.samples(), views[i]);
  }
  p.tables.collect_counters();
  return tallies;
}

std::vector<PhotonEnd> GpuBackend::trace_photons(std::uint32_t pass) {
  std::vector<PhotonEnd> all;
  passes_->trace(pass, [&](std::uint32_t count, const passes::Grid&) {
    const std::vector<PhotonEnd> ends = passes_->ends(count);
    all.insert(all.end(), ends.begin(), ends.end());
  });
  return all;
}

std::vector<shared::PixelSample> GpuBackend::trace_camera(std::uint32_t pass, const View& view) {
  passes_->paths.trace_camera(passes_->commands, passes_->settings, pass, view);
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
