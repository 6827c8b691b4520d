// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/block_writing.hpp"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>

#include "base/cancellation.hpp"
#include "base/expects.hpp"
#include "package/package_writer.hpp"

namespace farlod::pipeline {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Tells how many blocks are done, one call at a time.
class BlockProgress {
 public:
  BlockProgress(const RunSettings& run, std::size_t all) : run_(run), all_(all) { tell(); }
  void add_one() {
    const std::lock_guard lock(mutex_);
    ++done_;
    tell();
  }

 private:
  void tell() const {
    if (run_.on_progress) run_.on_progress({"far maps", done_, all_});
  }
  const RunSettings& run_;
  std::size_t all_, done_ = 0;
  std::mutex mutex_;
};

/// Bakes and writes blocks. Any number of them at once.
class BlockMaking {
 public:
  BlockMaking(const BlockSource& source, const UnfinishedPackage& unfinished, const RunSettings& run)
      : source_(source), unfinished_(unfinished), run_(run), writer_(unfinished.package_folder()) {}

  void make(const PlannedBlock& planned) {
    throw_if_cancelled(run_.stop);
    if (unfinished_.finished(planned.block, planned.mapped)) {
      ++found_;
      return;
    }
    const auto start = Clock::now();
    const bool has_maps = far_maps_of(planned, source_.grid) > 0;
    // While a thread waits for the cells of its block, it must not begin another block, which would be held beside it
    const BakedBlock maps = has_maps ? oneapi::tbb::this_task_arena::isolate([&] { return bake(planned); }) : BakedBlock{};
    bake_s_ += seconds_since(start);
    const auto baked = Clock::now();
    unfinished_.record(writer_.write_block(source_.tiles, maps, source_.grid, planned.block, source_.shape, planned.mapped));
    source_.tiles.let_go(source_.grid.cells_of(planned.block));
    write_s_ += seconds_since(baked);
  }

  [[nodiscard]] BlockTally tally(double wall_s) const {
    const double busy_s = bake_s_ + write_s_;
    const double bake_share = busy_s > 0.0 ? bake_s_ / busy_s : 0.0;
    return {wall_s * bake_share, wall_s * (1.0 - bake_share), writer_.far_map_bytes(), found_};
  }

 private:
  [[nodiscard]] BakedBlock bake(const PlannedBlock& planned) const {
    FARLOD_EXPECTS(source_.baker != nullptr);
    return planned.mapped ? source_.baker->bake(planned.block, *planned.mapped, run_.stop)
                          : source_.baker->bake(planned.block, run_.stop);
  }

  const BlockSource& source_;
  const UnfinishedPackage& unfinished_;
  const RunSettings& run_;
  PackageWriter writer_;
  std::atomic<double> bake_s_ = 0.0, write_s_ = 0.0;
  std::atomic<std::size_t> found_ = 0;
};

}  // namespace

BlockTally make_blocks(const BlockSource& source, const BlockPlan& plan, std::span<const std::size_t> places,
                       const UnfinishedPackage& unfinished, const RunSettings& run, std::size_t blocks_at_once) {
  const auto start = Clock::now();
  BlockMaking making(source, unfinished, run);
  BlockProgress progress(run, places.size());
  std::atomic<std::size_t> next = 0;
  const auto make_next_ones = [&](std::size_t) {
    for (std::size_t n = next++; n < places.size(); n = next++) {
      if (const PlannedBlock& planned = plan.blocks[places[n]]; !planned.kept) making.make(planned);
      progress.add_one();
    }
  };
  oneapi::tbb::parallel_for(std::size_t{0}, std::min(blocks_at_once, places.size()), make_next_ones,
                            oneapi::tbb::simple_partitioner());
  return making.tally(seconds_since(start));
}

}  // namespace farlod::pipeline
