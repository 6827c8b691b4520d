// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/ordered/ordered_work.hpp"

#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

namespace farlod::ingest {

void run_in_order(std::size_t places, const OrderedWork& work) {
  using oneapi::tbb::filter_mode, oneapi::tbb::make_filter;
  // Pieces end in their order, so that those at work follow each other, and each has a place of its own. What the pipeline itself
  // held when work ends early, oneTBB would lose
  std::size_t next = 0;
  const auto begin = [&](oneapi::tbb::flow_control& flow) {
    const std::size_t place = next++ % places;
    if (!work.begin(place)) flow.stop();
    return place;
  };
  const auto do_work = [&](std::size_t place) {
    work.work(place);
    return place;
  };
  // A thread that waits for its last pieces does not begin a piece of the work around this one, for which others would wait
  oneapi::tbb::this_task_arena::isolate([&] {
    oneapi::tbb::parallel_pipeline(places, make_filter<void, std::size_t>(filter_mode::serial_in_order, begin) &
                                               make_filter<std::size_t, std::size_t>(filter_mode::parallel, do_work) &
                                               make_filter<std::size_t, void>(filter_mode::serial_in_order, work.end));
  });
}

std::size_t threads_here() { return static_cast<std::size_t>(oneapi::tbb::this_task_arena::max_concurrency()); }

std::size_t places_for_threads() {
  constexpr std::size_t places_of_a_thread = 2, most_threads = 16;
  return places_of_a_thread * std::min(threads_here(), most_threads);
}

}  // namespace farlod::ingest
