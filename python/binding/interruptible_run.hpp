// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <functional>
#include <optional>

#include "farlod/run.hpp"

namespace farlod {

/// How a caller in Python wants a run to be carried out.
struct CallerSettings {
  std::size_t threads = 0;                        ///< RunSettings::threads
  std::optional<std::uint64_t> memory_limit_mib;  ///< RunSettings::memory_limit_mib
  /// Called as progress(stage, done, all), or None. Always by the thread that called us, some times a second.
  pybind11::object progress;
};

/// Work that does not touch Python.
using Work = std::function<void(const RunSettings& run)>;

/// Carries out `work` in a thread of its own while the calling thread waits without the interpreter's lock. Ctrl-C, and whatever
/// `progress` raises, ends the run (RunSettings::stop) and is raised here; what `work` throws is thrown here. Throws
/// InvalidArgument in a process that was forked from one that had work done before: the threads of its runs are not in it.
void run_interruptibly(const CallerSettings& caller, const Work& work);

/// Throws what run_interruptibly throws in a forked process.
void require_threads_of_this_process();

}  // namespace farlod
