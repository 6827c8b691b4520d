// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "evaluate/sky_evaluator.hpp"
#include "farlod/evaluation.hpp"

namespace farlod {

/// Statistics of the values of one column of some cells: sky view factors, or others. Sums are added cell by cell, in order, so
/// that the mean does not depend on the number of threads. A value on a surface weighs as much as the area that it stands for,
/// and any other one 1.
struct SvfStatistics {
  std::size_t count = 0;
  double sum = 0.0, weight_sum = 0.0;
  float min = std::numeric_limits<float>::infinity(), max = -std::numeric_limits<float>::infinity();
  double width_sum = 0.0;
  float width_max = 0.0F;

  void add(float svf, float weight = 1.0F) {
    ++count;
    sum += double{svf} * double{weight};
    weight_sum += double{weight};
    min = std::min(min, svf);
    max = std::max(max, svf);
  }
  void add_width(float width) {
    width_sum += width;
    width_max = std::max(width_max, width);
  }
  /// Nothing where there is no value.
  [[nodiscard]] std::optional<ValueRange> range() const {
    return count > 0 ? std::optional(ValueRange{min, sum / weight_sum, max}) : std::nullopt;
  }
  [[nodiscard]] BoundsWidth width() const { return {width_sum / static_cast<double>(count), width_max}; }
  void add(const SvfStatistics& o) {
    *this = {count + o.count,
             sum + o.sum,
             weight_sum + o.weight_sum,
             std::min(min, o.min),
             std::max(max, o.max),
             width_sum + o.width_sum,
             std::max(width_max, o.width_max)};
  }
};

/// How many values lie in each of ten thousand equal parts of [0, 1], or how much they weigh.
class SvfDistribution {
 public:
  void add(std::span<const float> values);
  /// Values that weigh as much as their areas, to the square millimetre, where there are areas.
  void add(std::span<const float> values, std::span<const float> areas_m2);
  /// The middle of the part in which the middle value lies: within .00005 of it. Of an even number, the mean of the two in the
  /// middle; of areas, below it lies one half of the area. There must be a value.
  [[nodiscard]] double median() const;

 private:
  /// The middle of the part in which the value lies that has `before` smaller ones before it.
  [[nodiscard]] double value_after(std::uint64_t before) const;

  [[nodiscard]] std::uint64_t& count_of(float value);

  static constexpr std::size_t parts = 10'000;
  std::vector<std::uint64_t> counts_ = std::vector<std::uint64_t>(parts);
};

/// Without those that are no data.
[[nodiscard]] SvfStatistics statistics_of(std::span<const float> values);
/// Those of a cell, whose receivers may stand for areas.
[[nodiscard]] SvfStatistics statistics_of(const CellReceivers& cell, const SvfValues& values);
/// Those of the receivers near buildings, where that was asked for.
[[nodiscard]] SvfStatistics statistics_near_buildings(const CellReceivers& cell, const SvfValues& values);
/// Those of each column of further values.
[[nodiscard]] std::vector<SvfStatistics> further_statistics_of(const CellReceivers& cell, const SvfValues& values,
                                                               const Quantities& further);

void store_statistics(const SvfStatistics& all, const SvfDistribution& values, bool bounds, EvaluationSummary& run);
void store_statistics_near_buildings(const SvfStatistics& near, EvaluationSummary& run);
void store_further_statistics(std::span<const SvfStatistics> all, const Quantities& further, EvaluationSummary& run);

}  // namespace farlod
