#include "host/render/gpu_backend.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/passes/gather.h"
#include "host/passes/highlights.h"
#include "host/passes/paths.h"
#include "host/render/highlights.h"
#include "host/stopwatch.h"

namespace meniscal {
namespace {

// Of either set: what the pilot shares out anew, may become as large as the larger one.
std::uint32_t photon_capacity(const PhotonSet& set, const RenderSettings& settings) {
  const std::uint32_t most = std::max(settings.caustics.count(), settings.global.count());
  return set.count() > 0 ? std::min(most, settings.photons_at_once) : 0;
}

// The photons of the caustics' maps, or of the global map, and the passes that look them up.
struct Map {
  bool global;
  std::uint32_t capacity;  // of photons at once
  const passes::PhotonBuffers& photons;
  passes::CellsPass cells;
  passes::GatherPass gather;
  std::uint32_t grids = 0;  // that the pass took so far

  Map(const gpu::Device& device, const passes::PhotonBuffers& p, std::uint32_t c,
      const std::vector<passes::PixelTile>& tiles, std::uint32_t kernel, bool g, bool glossy, bool texel)
      : global(g),
        capacity(c),
        photons(p),
        cells(device, photons, passes::entry_capacity(capacity), passes::most_cells(capacity), texel),
        gather(device, photons, cells, tiles, kernel, global, glossy, texel) {}
};

}  // namespace

struct GpuBackend::Passes {
  gpu::Device device;
  const World& world;
  RenderSettings settings;
  gpu::Commands commands;
  Stopwatch set_up;
  std::uint32_t capacity, global_capacity;
  passes::SceneTables tables;
  double upload_seconds = set_up.seconds(), compile_seconds;
  std::vector<passes::PixelTile> tiles;
  passes::PhotonBuffers photons;
  std::optional<passes::PhotonBuffers> global_photons;
  passes::PathsPass paths;
  std::optional<Map> caustics, global;               // none without photons
  std::optional<passes::HighlightsPass> highlights;  // made once a pixel sees a meniscus

  Passes(gpu::Device d, const World& w, RenderSettings s, bool allow_texel)
      : device(std::move(d)),
        world(w),
        settings(std::move(s)),
        commands(device),
        capacity(photon_capacity(settings.caustics, settings)),
        global_capacity(photon_capacity(settings.global, settings)),
        tables(device, world, passes::largest_table(std::max(capacity, global_capacity), settings.crop.pixels()),
               allow_texel),
        tiles(passes::make_tiles(device, settings.crop.pixels(), settings.crop.width(), world.glossy)),
        photons(device, capacity, world.glossy),
        global_photons(global_capacity > 0 ? std::optional<passes::PhotonBuffers>(std::in_place, device,
                                                                                  global_capacity, world.glossy, true)
                                           : std::nullopt),
        paths(device, world, tables, photons, global_photons ? &*global_photons : nullptr, tiles, settings) {
    if (capacity > 0)
      caustics.emplace(device, photons, capacity, tiles, settings.kernel, false, world.glossy, tables.texel);
    if (global_photons)
      global.emplace(device, *global_photons, global_capacity, tiles, settings.kernel, true, world.glossy,
                     tables.texel);
    compile_seconds = set_up.seconds() - upload_seconds;
  }

  // By the stages of interface: seconds of "photons", "grid", "gather", and of set-up.
  std::map<std::string, double> seconds() const {
    std::map<std::string, double> sums = {{"upload", upload_seconds}, {"compile", compile_seconds}};
    const std::string global_map = "global ";
    for (const auto& [stage, time] : commands.seconds_by_stage())
      sums[stage.starts_with(global_map) ? stage.substr(global_map.size()) : stage] += time;
    return sums;
  }

  // Of all tiles, of one of their buffers.
  template <class T>
  std::vector<T> download(gpu::Buffer passes::PixelTile::*buffer) const {
    std::vector<T> all;
    for (const passes::PixelTile& tile : tiles) {
      const std::size_t left = settings.crop.pixels() - all.size();
      const auto part = (tile.*buffer).template download<T>(0, std::min<std::size_t>(tile.count, left));
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  }
  std::vector<shared::PixelSample> pixels() const { return download<shared::PixelSample>(&passes::PixelTile::samples); }
  Samples samples() const {
    Samples samples{pixels(), {}, {}};
    if (world.glossy) samples.gloss = download<shared::PixelGloss>(&passes::PixelTile::gloss);
    return samples;
  }

  const PhotonSet& set_of(const Map& map) const { return map.global ? settings.global : settings.caustics; }

  // Calls done(count, grid) for the photons of a pass, as many at a time as fit, with the grid to put them into.
  template <class Done>
  void trace(const Map& map, std::uint32_t pass, const Done& done) {
    const PhotonSet& set = set_of(map);
    for (std::uint32_t first = 0, count = 0; first < set.count(); first += count) {
      count = std::min(map.capacity, set.count() - first);
      const passes::Grid grid = passes::make_grid(count, pass_discs(set.discs, pass));
      paths.trace_photons(commands, settings, map.global, pass, first, count, grid);
      tables.collect_counters();
      done(count, grid);
    }
  }

  // Lights the samples by the photons of a pass. Where all of them fit into one grid, they are still there for further
  // views; else they are traced anew. Adds how they ended, the first time.
  void light(Map& map, std::uint32_t pass, float lobe_part, Tallies& tallies) {
    const PhotonSet& set = set_of(map);
    if (map.grids == 1) {
      map.gather.run(commands, passes::make_grid(set.count(), pass_discs(set.discs, pass)), settings.crop, lobe_part);
      return;
    }
    const bool anew = map.grids > 1;
    map.grids = 0;
    trace(map, pass, [&](std::uint32_t count, const passes::Grid& grid) {
      for (std::uint32_t first = 0; first < count; ++map.grids) {
        first += map.cells.build(commands, grid, first, count - first);
        map.gather.run(commands, grid, settings.crop, lobe_part);
      }
      if (!anew) tally(map, tallies, count);
    });
  }

  // Traces a view's samples of one pass, and lights them by another's photons. These are still there afterwards.
  Samples light_camera(std::uint32_t pass, const View& view, std::uint32_t photon_pass, Tallies& tallies) {
    paths.trace_camera(commands, settings, pass, view);
    if (caustics && shows_caustics(settings, view)) light(*caustics, photon_pass, 1, tallies);
    if (global && shows_global(settings, view)) light(*global, photon_pass, global_lobe_part(view), tallies);
    return samples();
  }
  std::vector<glm::vec3> trace_highlights(std::uint32_t pass, const std::vector<std::uint32_t>& pixels) {
    if (pixels.empty()) return {};
    if (!highlights) {
      const Stopwatch compiling;
      highlights.emplace(device, world, tables, settings);
      compile_seconds += compiling.seconds();
    }
    return highlights->run(commands, settings, pass, pixels);
  }
  void forget_photons() {
    for (std::optional<Map>* map : {&caustics, &global})
      if (*map) (*map)->grids = 0;
  }

  Tallies no_tallies() const {
    Tallies tallies;
    for (Tally& t : tallies) t.flux_landed.resize(world.surfaces.size());
    return tallies;
  }

  std::vector<PhotonEnd> ends(const Map& map, std::uint32_t count) const {
    std::vector<PhotonEnd> ends;
    ends.reserve(count);
    for (const shared::PhotonEnd& e : map.photons.ends.download<shared::PhotonEnd>(0, count))
      ends.push_back({map_of(map, e), e.end, glm::dvec3(0), glm::dvec3(e.flux)});
    const auto discs = map.photons.discs.download<shared::PhotonDisc>(0, count);
    for (std::uint32_t i = 0; i < count; ++i)
      if (ends[i].end < shared::END_FIRST) ends[i].position = discs[i].position;
    return ends;
  }

  static std::uint32_t map_of(const Map& map, const shared::PhotonEnd& e) {
    return map.global ? shared::MAP_GLOBAL : e.map;
  }

  void tally(const Map& map, Tallies& tallies, std::uint32_t count) const {
    for (const shared::PhotonEnd& p : map.photons.ends.download<shared::PhotonEnd>(0, count))
      tallies[map_of(map, p)].count({double(p.entered), mean_of(p.flux), double(p.absorbed), double(p.cut), p.end},
                                    [&](std::uint32_t triangle) { return world.triangles[triangle].material; });
  }
};

GpuBackend::GpuBackend(gpu::Device device, const World& world, RenderSettings settings, bool allow_texel)
    : passes_(std::make_unique<Passes>(std::move(device), world, std::move(settings), allow_texel)) {}
GpuBackend::~GpuBackend() = default;

Tallies GpuBackend::render_pass(std::uint32_t pass, const TakeSamples& take) {
  Passes& p = *passes_;
  Tallies tallies = p.no_tallies();
  p.forget_photons();
  HighlightPixels seeing(p.settings.crop);
  for (const View& view : views_of(p.settings)) {
    Samples samples = p.light_camera(pass, view, pass, tallies);
    if (view.main()) seeing.add(samples.pixels);
    if (view.last_main(p.settings)) samples.highlights = p.trace_highlights(pass, seeing.pixels());
    take(samples, view);
  }
  p.tables.collect_counters();
  return tallies;
}

std::vector<PhotonEnd> GpuBackend::trace_photons(std::uint32_t pass) {
  Passes& p = *passes_;
  std::vector<PhotonEnd> all;
  if (!p.caustics) return all;
  p.trace(*p.caustics, pass, [&](std::uint32_t count, const passes::Grid&) {
    const std::vector<PhotonEnd> ends = p.ends(*p.caustics, count);
    all.insert(all.end(), ends.begin(), ends.end());
  });
  return all;
}

std::vector<shared::PixelSample> GpuBackend::trace_camera(std::uint32_t pass, const View& view) {
  passes_->paths.trace_camera(passes_->commands, passes_->settings, pass, view);
  return passes_->pixels();
}

Samples GpuBackend::light_camera(std::uint32_t pass, const View& view, std::uint32_t photon_pass) {
  Tallies tallies = passes_->no_tallies();
  passes_->forget_photons();
  return passes_->light_camera(pass, view, photon_pass, tallies);
}

void GpuBackend::configure(const RenderSettings& settings) { passes_->settings = settings; }

Backend::Statistics GpuBackend::statistics() const {
  const Passes& p = *passes_;
  const gpu::DeviceInfo& info = p.device.info();
  Stages stages;
  stages.add("upload", p.upload_seconds);
  stages.add("compile", p.compile_seconds);
  return {info.name,
          info.type,
          info.driver,
          p.seconds(),
          p.device.bytes_peak(),
          p.tables.sums[shared::COUNTER_RAYS],
          p.tables.sums[shared::COUNTER_TRAVERSAL_LIMIT],
          p.tables.sums[shared::COUNTER_MEDIA_DROPPED],
          p.device.record(),
          stages};
}

}  // namespace meniscal
