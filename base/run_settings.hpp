// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <thread>

#include "farlod/error.hpp"
#include "farlod/run.hpp"

namespace farlod {

/// A number as messages show it: without trailing zeros.
[[nodiscard]] inline std::string setting_text(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

// Each of these throws InvalidArgument, which names the setting, where it is not what its declaration promises.

/// Wants low ≤ value ≤ high; NaN is refused, too.
inline void require_between(const char* setting, double value, double low, double high) {
  if (low <= value && value <= high) return;
  throw InvalidArgument(std::string(setting) + " is " + setting_text(value) + ": give a number from " + setting_text(low) +
                        " to " + setting_text(high));
}

/// The same for whole numbers, which its message shows in full.
inline void require_count_between(const char* setting, std::size_t value, std::size_t low, std::size_t high) {
  if (low <= value && value <= high) return;
  throw InvalidArgument(std::string(setting) + " is " + std::to_string(value) + ": give a number from " + std::to_string(low) +
                        " to " + std::to_string(high));
}

/// Beyond it lies nothing that anybody maps, in metres or degrees.
inline constexpr double farthest_coordinate = 1e8;

inline void require_coordinate(const char* setting, double value) {
  require_between(setting, value, -farthest_coordinate, farthest_coordinate);
}

/// An enumeration may hold any number, when a caller casts to it.
template <class Enum>
void require_one_of(const char* setting, Enum value, Enum last) {
  if (value >= Enum{} && value <= last) return;
  throw InvalidArgument(std::string(setting) + " is " + std::to_string(static_cast<int>(value)) +
                        ", which is none of its values: choose one that its declaration lists");
}

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
