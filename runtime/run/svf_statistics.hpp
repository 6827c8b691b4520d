// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "evaluate/sky_evaluator.hpp"
#include "farlod/evaluation.hpp"

namespace farlod {

/// Statistics of the sky view factors of some cells, with crowns or without. Sums are added cell by cell, in order, so that the
/// mean does not depend on the number of threads.
struct SvfStatistics {
  std::size_t count = 0;
  double sum = 0.0;
  float min = 1.0F, max = 0.0F;
  double width_sum = 0.0;
  float width_max = 0.0F;

  void add(float svf) {
    ++count;
    sum += svf;
    min = std::min(min, svf);
    max = std::max(max, svf);
  }
  void add_width(float width) {
    width_sum += width;
    width_max = std::max(width_max, width);
  }
  [[nodiscard]] BoundsWidth width() const { return {width_sum / static_cast<double>(count), width_max}; }
  void add(const SvfStatistics& o) {
    *this = {count + o.count,         sum + o.sum,
             std::min(min, o.min),    std::max(max, o.max),
             width_sum + o.width_sum, std::max(width_max, o.width_max)};
  }
};

/// How many values lie in each of ten thousand equal parts of [0, 1].
class SvfDistribution {
 public:
  void add(std::span<const float> values);
  /// The middle of the part in which the middle value lies: within .00005 of it. Of an even number, the mean of the two in the
  /// middle. There must be a value.
  [[nodiscard]] double median() const;

 private:
  /// The middle of the part in which the value lies that has `before` smaller ones before it.
  [[nodiscard]] double value_after(std::uint64_t before) const;

  static constexpr std::size_t parts = 10'000;
  std::vector<std::uint64_t> counts_ = std::vector<std::uint64_t>(parts);
};

[[nodiscard]] SvfStatistics statistics_of(const SvfValues& values);
/// Those of the receivers near buildings, where that was asked for.
[[nodiscard]] SvfStatistics statistics_near_buildings(const CellReceivers& cell, const SvfValues& values);
/// The statistics of the total sky view factors among the further values, where they are.
[[nodiscard]] SvfStatistics total_statistics_of(const SvfValues& values, const Quantities& further);

void store_statistics(const SvfStatistics& all, const SvfDistribution& values, bool bounds, EvaluationSummary& run);
void store_statistics_near_buildings(const SvfStatistics& near, EvaluationSummary& run);
void store_statistics_of_totals(const SvfStatistics& all, const Quantities& further, EvaluationSummary& run);

}  // namespace farlod
