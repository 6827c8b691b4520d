// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <oneapi/tbb/parallel_pipeline.h>

#include <cstddef>
#include <stop_token>
#include <utility>
#include <vector>

#include "base/cancellation.hpp"

namespace farlod::tiles {

/// Objects that one thread cuts in one batch, and batches that may wait to be placed. This bounds the memory of what waits.
inline constexpr std::size_t batch_size = 256, batches_at_once = 16;

/// Calls place(item, make(item)) for each item that `next` hands out: some at a time, none at the end. The calls of `make` run in
/// parallel; those of `place` run in order, one at a time.
template <class Next, class Make, class Place>
void make_and_place(const Next& next, const std::stop_token& stop, const Make& make, const Place& place) {
  namespace tbb = oneapi::tbb;
  using Items = decltype(next());
  using Batch = std::pair<Items, std::vector<decltype(make(std::declval<Items>().front()))>>;
  const auto begin_batch = [&](tbb::flow_control& flow) {
    Items items = next();
    if (items.empty()) flow.stop();
    return items;
  };
  const auto make_batch = [&](Items items) {
    Batch batch{std::move(items), {}};
    for (const auto& item : batch.first) {
      throw_if_cancelled(stop);
      batch.second.push_back(make(item));
    }
    return batch;
  };
  const auto place_batch = [&](Batch batch) {
    for (std::size_t k = 0; k < batch.second.size(); ++k) place(batch.first[k], batch.second[k]);
  };
  tbb::parallel_pipeline(batches_at_once, tbb::make_filter<void, Items>(tbb::filter_mode::serial_in_order, begin_batch) &
                                              tbb::make_filter<Items, Batch>(tbb::filter_mode::parallel, make_batch) &
                                              tbb::make_filter<Batch, void>(tbb::filter_mode::serial_in_order, place_batch));
}

/// Hands out the numbers below `count`.
class Numbers {
 public:
  explicit Numbers(std::size_t count) : count_(count) {}
  std::vector<std::size_t> next(std::size_t most) {
    std::vector<std::size_t> numbers;
    for (; numbers.size() < most && next_ < count_; ++next_) numbers.push_back(next_);
    return numbers;
  }

 private:
  std::size_t count_, next_ = 0;
};

}  // namespace farlod::tiles
