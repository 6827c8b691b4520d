// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/whole_package.hpp"

#include <oneapi/tbb/task_group.h>

#include <chrono>
#include <utility>
#include <vector>

namespace farlod::pipeline {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point a, Clock::time_point b) { return std::chrono::duration<double>(b - a).count(); }

/// Before it throws, what is written at the same time comes to its end: a group must not be left with work in it.
BakedBlock bake_beside(oneapi::tbb::task_group& writing, const FarMapBaker& baker, Block block, const Progress& progress,
                       const RunSettings& run) {
  try {
    if (run.on_progress) run.on_progress(progress);
    return baker.bake(block, run.stop);
  } catch (...) {
    try {
      writing.wait();
    } catch (...) {  // the first failure is the one that is told
    }
    throw;
  }
}

}  // namespace

void write_all_blocks(const TileSet& tiles, const FarMapBaker& baker, PackageWriter& writer, std::size_t blocks_at_once,
                      const RunSettings& run, PackedCity& result) {
  package::Manifest& manifest = result.manifest;
  const std::vector<Block> blocks = manifest.grid.blocks();
  double bake_s = 0.0, write_s = 0.0;
  BakedBlock to_write;
  oneapi::tbb::task_group writing;
  for (std::size_t n = 0; n < blocks.size(); ++n) {
    const auto start = Clock::now();
    BakedBlock maps = bake_beside(writing, baker, blocks[n], {"far maps", n, blocks.size()}, run);
    bake_s += seconds_between(start, Clock::now());
    writing.wait();
    to_write = std::move(maps);
    writing.run([&, block = blocks[n]] {
      const auto begin = Clock::now();
      manifest.blocks.push_back(writer.write_block(tiles, to_write, manifest.grid, block, manifest.far_map));
      tiles.let_go(manifest.grid.cells_of(block));
      write_s += seconds_between(begin, Clock::now());
    });
    if (blocks_at_once > 1) continue;
    writing.wait();
    to_write = {};
  }
  writing.wait();
  if (run.on_progress) run.on_progress({"far maps", blocks.size(), blocks.size()});
  result.stage_seconds.emplace_back("far_maps", bake_s);
  result.stage_seconds.emplace_back("package", write_s);
}

}  // namespace farlod::pipeline
