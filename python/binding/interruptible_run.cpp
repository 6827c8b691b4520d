// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "python/binding/interruptible_run.hpp"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <future>
#include <mutex>
#include <string>
#include <utility>

#include "farlod/error.hpp"

namespace py = pybind11;

namespace farlod {
namespace {

constexpr std::chrono::milliseconds between_looks{50};

/// The newest progress, from the threads of the run to the thread that tells it.
class LatestProgress {
 public:
  void put(const Progress& progress) {
    const std::lock_guard lock(mutex_);
    stage_ = progress.stage;
    done_ = progress.done;
    all_ = progress.all;
    is_new_ = true;
  }
  void tell(const py::object& listener) {
    std::unique_lock lock(mutex_);
    if (!std::exchange(is_new_, false)) return;
    const std::string stage = stage_;
    const std::size_t done = done_, all = all_;
    // The listener may take its time, and the run goes on
    lock.unlock();
    listener(stage, done, all);
  }

 private:
  std::mutex mutex_;
  std::string stage_;
  std::size_t done_ = 0, all_ = 0;
  bool is_new_ = false;
};

/// Waits for the end of the work. What the interpreter or the listener raises asks the work to stop; the first of it is returned.
std::exception_ptr wait_for(const std::future<void>& work, std::stop_source& stop, const std::function<void()>& tell) {
  std::exception_ptr raised;
  bool is_done = false;
  while (!is_done) {
    {
      const py::gil_scoped_release release;
      is_done = work.wait_for(between_looks) == std::future_status::ready;
    }
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!raised) tell();
    } catch (...) {
      if (!raised) raised = std::current_exception();
      stop.request_stop();
    }
  }
  return raised;
}

}  // namespace

void require_threads_of_this_process() {
  static std::atomic<pid_t> process_of_threads{0};
  const pid_t here = getpid();
  pid_t expected = 0;
  if (!process_of_threads.compare_exchange_strong(expected, here) && expected != here)
    throw InvalidArgument(
        "this process was forked from one that had used farlod, and the threads of farlod are not in it: start workers with "
        "multiprocessing.get_context(\"spawn\") or \"forkserver\", or fork before the first use");
}

void run_interruptibly(const CallerSettings& caller, const Work& work) {
  require_threads_of_this_process();
  std::stop_source stop;
  LatestProgress latest;
  RunSettings run;
  run.threads = caller.threads;
  run.memory_limit_mib = caller.memory_limit_mib;
  run.stop = stop.get_token();
  const bool is_told = !caller.progress.is_none();
  if (is_told) run.on_progress = [&latest](const Progress& progress) { latest.put(progress); };
  std::future<void> result = std::async(std::launch::async, [&] { work(run); });
  const std::exception_ptr raised = wait_for(result, stop, [&] {
    if (is_told) latest.tell(caller.progress);
  });
  if (raised) std::rethrow_exception(raised);
  result.get();
}

}  // namespace farlod
