// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

namespace farlod {

/// Counts the steps of a program while it lives: how often it enters a basic block of the sources that farlod_counts_steps() of
/// CMake names. As many on any machine, however busy, so that a test may compare them where seconds would depend on others.
/// One at a time; threads count together.
class CountedSteps {
 public:
  /// At the step of this number, calls `then`, on the thread that takes it. 0: never.
  explicit CountedSteps(std::uint64_t at = 0, std::function<void()> then = {});
  CountedSteps(const CountedSteps&) = delete;
  CountedSteps& operator=(const CountedSteps&) = delete;
  ~CountedSteps();

  [[nodiscard]] std::uint64_t count() const;
};

}  // namespace farlod
