// The passes of the photon maps, run one by one.
#pragma once

#include "host/passes/gather.h"
#include "host/passes/paths.h"

namespace meniscal::test {

struct GpuMap {
  GpuMap(const gpu::Device& device, const World& w, const RenderSettings& rs)
      : world(w),
        settings(rs),
        count(settings.caustics.count()),
        grid(passes::make_grid(count, settings.caustics.discs)),
        commands(device),
        tables(device, world, passes::largest_table(count, settings.crop.pixels()), true),
        tiles(passes::make_tiles(device, settings.crop.pixels(), settings.crop.width(), world.glossy)),
        photons(device, count, world.glossy),
        paths(device, world, tables, photons, nullptr, tiles, settings),
        cells(device, photons, passes::entry_capacity(count), grid.cells(), tables.texel),
        gather(device, photons, cells, tiles, shared::KERNEL_BIWEIGHT, false, world.glossy, tables.texel) {}

  // The photons, and the pixels, to which gathering adds.
  void prepare() {
    paths.trace_camera(commands, settings, 0, View{});
    paths.trace_photons(commands, settings, false, 0, 0, count, grid);
  }
  // Of as many photons from `first` on as fit; returns how many.
  std::uint32_t build_grid(std::uint32_t first) {
    const std::uint32_t taken = cells.build(commands, grid, first, count - first);
    commands.submit_and_wait();
    return taken;
  }
  void gather_from_grid() { gather.run(commands, grid, settings.crop); }
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
