// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <mutex>

#include "base/cancellation.hpp"
#include "base/run_settings.hpp"
#include "run/cells_in_parallel.hpp"

namespace farlod {

void for_each_cell(std::size_t count, const RunSettings& run, const char* stage, const std::function<void(std::size_t)>& work) {
  std::mutex mutex;
  std::size_t done = 0;
  oneapi::tbb::task_arena arena(static_cast<int>(thread_count(run)));
  arena.execute([&] {
    oneapi::tbb::parallel_for(std::size_t{0}, count, [&](std::size_t n) {
      throw_if_cancelled(run.stop);
      work(n);
      if (!run.on_progress) return;
      const std::lock_guard lock(mutex);
      run.on_progress({stage, ++done, count});
    });
  });
}

}  // namespace farlod
