// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "evaluate/sky_evaluator.hpp"

namespace farlod {

/// Sky view factors of receivers by their numbers, with bounds where they are wanted (otherwise `low` and `high` are empty).
struct SvfValues {
  static constexpr float no_data = std::numeric_limits<float>::quiet_NaN();
  std::vector<float> svf, low, high;
  std::vector<float> further;  ///< the values of SkySettings::further, receiver by receiver
  std::size_t further_columns = 0;
  RayCounts counts = {};

  SvfValues(std::size_t size, bool bounds, std::size_t columns = 0)
      : svf(size, no_data),
        low(bounds ? size : 0, no_data),
        high(low),
        further(size * columns, no_data),
        further_columns(columns) {}
  /// Those of the n-th receiver.
  [[nodiscard]] std::span<const float> further_of(std::size_t n) const {
    return std::span(further).subspan(n * further_columns, further_columns);
  }
  /// The n-th of `svf`, `low` or `high`; nothing where it is no data, or where bounds are not wanted.
  [[nodiscard]] static std::optional<double> value(const std::vector<float>& values, std::size_t n) {
    return values.empty() || std::isnan(values[n]) ? std::nullopt : std::optional<double>(values[n]);
  }
};

/// The cells of a run, in their order, and what becomes of their answers.
class CellsOfRun {
 public:
  virtual ~CellsOfRun() = default;
  [[nodiscard]] virtual std::size_t size() const = 0;
  [[nodiscard]] virtual Cell place(std::size_t n) const = 0;
  /// About how many receivers the n-th cell has, before they are placed.
  [[nodiscard]] virtual double receivers_about(std::size_t n) const = 0;
  /// The receivers of the n-th cell: the same at each call, on any thread.
  [[nodiscard]] virtual CellReceivers receivers(std::size_t n) = 0;
  /// Takes the values of the n-th cell, which are in the order of its receivers. Called for one cell at a time, in the order of
  /// the cells.
  virtual void store(std::size_t n, const CellReceivers& cell, const SvfValues& values) = 0;
};

/// Evaluates all receivers of a cell. The values are in the order of the receivers, whatever their indices.
[[nodiscard]] inline SvfValues values_of(const SkyEvaluator& evaluator, CellReceivers cell, bool bounds) {
  SvfValues values(cell.receivers.size(), bounds, evaluator.further_columns());
  for (std::size_t k = 0; k < cell.receivers.size(); ++k) cell.receivers[k].index = k;
  SkyAnswers answers(values.svf, values.low, values.high, values.further);
  answers.counts = &values.counts;
  evaluator.evaluate(cell, answers);
  return values;
}

}  // namespace farlod
