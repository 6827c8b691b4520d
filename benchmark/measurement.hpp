// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <vector>

namespace farlod::benchmark {

/// Wall clock of a call.
template <class Work>
[[nodiscard]] double seconds_of(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The middle value; of an even number, the mean of the two in the middle. At least one.
[[nodiscard]] double median(std::vector<double> values);

/// Two ways to do the same, measured in turn (A B A B …), so that what else the machine does meets both.
struct Duel {
  double first_s = 0.0, second_s = 0.0;  ///< medians
  double ratio = 0.0;                    ///< median of second/first, each within one turn
};
[[nodiscard]] Duel duel(std::size_t turns, const std::function<void()>& first, const std::function<void()>& second);

/// Median wall clock of so many calls.
[[nodiscard]] double median_seconds(std::size_t turns, const std::function<void()>& work);

}  // namespace farlod::benchmark
