// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/batches.hpp"

#include <oneapi/tbb/parallel_pipeline.h>

namespace farlod::tiles {

void make_and_place_batches(const std::function<std::unique_ptr<MadeBatch>()>& next) {
  namespace tbb = oneapi::tbb;
  // A pipeline hands on what can be copied
  using Batch = std::shared_ptr<MadeBatch>;
  const auto begin = [&](tbb::flow_control& flow) {
    Batch batch = next();
    if (!batch) flow.stop();
    return batch;
  };
  const auto make = [](const Batch& batch) {
    batch->make();
    return batch;
  };
  const auto place = [](const Batch& batch) { batch->place(); };
  tbb::parallel_pipeline(batches_at_once, tbb::make_filter<void, Batch>(tbb::filter_mode::serial_in_order, begin) &
                                              tbb::make_filter<Batch, Batch>(tbb::filter_mode::parallel, make) &
                                              tbb::make_filter<Batch, void>(tbb::filter_mode::serial_in_order, place));
}

}  // namespace farlod::tiles
