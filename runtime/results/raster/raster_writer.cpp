// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/raster_writer.hpp"

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <utility>

namespace farlod {
namespace {

std::string definition_of(const std::string& quantity) {
  if (quantity == "svf") return "sky view factor: share of the sky that the receiver sees, weighted by the cosine to its normal";
  Quantities solid;
  solid.svf_solid = true;
  return column_descriptions_of(solid).front().definition;
}

}  // namespace

std::vector<Band> svf_bands(const std::string& quantity, RasterBands bands) {
  const std::string definition = definition_of(quantity);
  std::vector<Band> all{{quantity, "1", definition}};
  if (bands == RasterBands::svf_and_bounds) {
    all.push_back({quantity + "_low", "1", "lower bound of the " + definition});
    all.push_back({quantity + "_high", "1", "upper bound of the " + definition});
  }
  return all;
}

std::vector<std::span<const float>> bands_of(const RasterTile& tile) {
  std::vector<std::span<const float>> bands{tile.svf};
  if (!tile.low.empty()) bands.insert(bands.end(), {tile.low, tile.high});
  bands.insert(bands.end(), tile.further.begin(), tile.further.end());
  return bands;
}

AwaitedRasterWriter::AwaitedRasterWriter(Make make, std::size_t threads)
    : thread_([this, make = std::move(make), threads] { work(make, threads); }) {}

AwaitedRasterWriter::~AwaitedRasterWriter() {
  {
    const std::scoped_lock lock(mutex_);
    is_over_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void AwaitedRasterWriter::work(const Make& make, std::size_t threads) {
  std::packaged_task<std::unique_ptr<RasterWriter>()> making(make);
  {
    using oneapi::tbb::global_control;
    const global_control others(global_control::max_allowed_parallelism, std::max<std::size_t>(threads, 2) - 1);
    making();
  }
  const Made made = making.get_future().share();
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, [this] { return is_over_ || task_.valid(); }), task_.valid()) std::exchange(task_, {})(made);
}

void AwaitedRasterWriter::do_in_thread(Task task) {
  std::future<void> done = task.get_future();
  {
    const std::scoped_lock lock(mutex_);
    task_ = std::move(task);
  }
  changed_.notify_one();
  done.get();
}

void AwaitedRasterWriter::write(const RasterTile& tile) {
  do_in_thread(Task([&tile](const Made& made) { made.get()->write(tile); }));
}

void AwaitedRasterWriter::commit() {
  do_in_thread(Task([](const Made& made) { made.get()->commit(); }));
}

}  // namespace farlod
