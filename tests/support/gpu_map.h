// The passes of the photon maps, run one by one.
#pragma once

#include "host/passes/gather.h"
#include "host/passes/paths.h"

namespace meniscal::test {

struct GpuMap {
  GpuMap(const gpu::Device& device, const World& w, const RenderSettings& rs)
      : world(w),
        settings(rs),
        count(settings.photons()),
        grid(passes::make_grid(count, settings.discs)),
        commands(device),
        tables(device, world, 3 * std::size_t(count), true),
        tiles(passes::make_tiles(device, settings.crop.pixels(), settings.crop.width())),
        photons(device, count),
        paths(device, world, tables, photons, tiles, settings),
        cells(device, photons, count, grid.cells(), tables.texel),
        gather(device, cells, tiles, tables.texel) {}

  // The photons, and the pixels, to which gathering adds.
  void prepare() {
    paths.trace_camera(commands, settings, 0, shared::BRANCH_ROULETTE);
    paths.trace_photons(commands, settings, 0, 0, count, grid);
  }
  void build_grid() {
    cells.record(commands, count, grid.digits);
    commands.submit_and_wait();
  }
  void gather_all() { gather.run(commands, grid); }
  std::vector<shared::PixelSample> samples() const { return tiles.at(0).samples.download<shared::PixelSample>(); }

  const World& world;
  const RenderSettings& settings;
  std::uint32_t count;
  passes::Grid grid;
  gpu::Commands commands;
  passes::SceneTables tables;
  std::vector<passes::PixelTile> tiles;
  passes::PhotonBuffers photons;
  passes::PathsPass paths;
  passes::CellsPass cells;
  passes::GatherPass gather;
};

}  // namespace meniscal::test
