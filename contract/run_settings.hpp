// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <thread>

#include "farlod/error.hpp"
#include "farlod/run.hpp"

namespace farlod {

/// Throws InvalidArgument where a setting is not what its declaration promises.
inline void require_usable(const RunSettings& run) {
  constexpr std::size_t most_threads = 4096;
  if (run.threads > most_threads)
    throw InvalidArgument("threads is " + std::to_string(run.threads) + ": give a number up to " + std::to_string(most_threads) +
                          ", or 0 for all cores");
  constexpr std::uint64_t most_mib = 1ULL << 40;
  if (run.memory_limit_mib && (*run.memory_limit_mib == 0 || *run.memory_limit_mib > most_mib))
    throw InvalidArgument("memory_limit_mib is " + std::to_string(*run.memory_limit_mib) + ": give a number from 1 to " +
                          std::to_string(most_mib) + ", or none for no limit");
}

/// How many threads a run uses.
[[nodiscard]] inline std::size_t thread_count(const RunSettings& run) {
  return run.threads > 0 ? run.threads : std::max<std::size_t>(1, std::thread::hardware_concurrency());
}

}  // namespace farlod
