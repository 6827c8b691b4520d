// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <cstddef>

namespace farlod {

/// Runs work with this many threads, also where the machine has fewer processors.
template <class Work>
auto with_threads(std::size_t threads, const Work& work) {
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
  oneapi::tbb::task_arena arena(static_cast<int>(threads));
  return arena.execute(work);
}

inline constexpr std::size_t many_threads = 8;
/// Threads that meet differently each time are given some chances. ThreadSanitizer needs none: it compares what has no order.
#ifdef __SANITIZE_THREAD__
inline constexpr int repeats = 1;
#else
inline constexpr int repeats = 3;
#endif

}  // namespace farlod
