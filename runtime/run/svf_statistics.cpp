// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "run/svf_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "evaluate/quantity_table.hpp"

namespace farlod {

namespace {

/// Slivers of no area weigh a square millimetre: a mean of nothing else is one, too.
constexpr float least_area_m2 = 1e-6F;
float weight_of(const CellReceivers& cell, std::size_t n) {
  return cell.areas_m2.empty() ? 1.0F : std::max(cell.areas_m2[n], least_area_m2);
}

}  // namespace

std::uint64_t& SvfDistribution::count_of(float value) {
  constexpr auto last = static_cast<float>(parts - 1);
  return counts_[static_cast<std::size_t>(std::clamp(value * static_cast<float>(parts), 0.0F, last))];
}

void SvfDistribution::add(std::span<const float> values) {
  for (const float value : values) ++count_of(value);
}

void SvfDistribution::add(std::span<const float> values, std::span<const float> areas_m2) {
  if (areas_m2.empty()) return add(values);
  for (std::size_t n = 0; n < values.size(); ++n)
    count_of(values[n]) += static_cast<std::uint64_t>(std::max(1.0F, areas_m2[n] / least_area_m2));
}

double SvfDistribution::median() const {
  std::uint64_t all = 0;
  for (const std::uint64_t count : counts_) all += count;
  return 0.5 * (value_after((all - 1) / 2) + value_after(all / 2));
}

double SvfDistribution::value_after(std::uint64_t before) const {
  std::size_t part = 0;
  for (std::uint64_t up_to = counts_[0]; up_to <= before; up_to += counts_[part]) ++part;
  return (static_cast<double>(part) + 0.5) / static_cast<double>(parts);
}

SvfStatistics statistics_of(std::span<const float> values) {
  SvfStatistics statistics;
  for (const float value : values)
    if (!std::isnan(value)) statistics.add(value);
  return statistics;
}

SvfStatistics statistics_of(const CellReceivers& cell, const SvfValues& values) {
  SvfStatistics statistics;
  for (std::size_t n = 0; n < values.svf.size(); ++n) statistics.add(values.svf[n], weight_of(cell, n));
  for (std::size_t n = 0; n < values.low.size(); ++n) statistics.add_width(values.high[n] - values.low[n]);
  return statistics;
}

SvfStatistics statistics_near_buildings(const CellReceivers& cell, const SvfValues& values) {
  SvfStatistics statistics;
  for (std::size_t n = 0; n < cell.is_near_building.size(); ++n)
    if (cell.is_near_building[n]) statistics.add(values.svf[n]);
  return statistics;
}

std::vector<SvfStatistics> further_statistics_of(const CellReceivers& cell, const SvfValues& values, const Quantities& further) {
  std::vector<SvfStatistics> statistics(values.further_columns);
  const TotalColumns columns = total_columns_of(further);
  for (std::size_t n = 0; n < values.svf.size(); ++n) {
    const std::span<const float> row = values.further_of(n);
    for (std::size_t k = 0; k < row.size(); ++k)
      if (!std::isnan(row[k])) statistics[k].add(row[k], weight_of(cell, n));
    if (columns.total && columns.low) statistics[*columns.total].add_width(row[*columns.low + 1] - row[*columns.low]);
  }
  return statistics;
}

void store_statistics(const SvfStatistics& all, const SvfDistribution& values, bool bounds, EvaluationSummary& run) {
  run.receivers = all.count;
  const std::optional<ValueRange> range = all.range();
  if (!range) return;
  run.svf_min = range->min;
  run.svf_mean = range->mean;
  run.svf_max = range->max;
  run.svf_median = values.median();
  if (bounds) run.bounds = all.width();
}

void store_statistics_near_buildings(const SvfStatistics& near, EvaluationSummary& run) {
  run.near_buildings = near.count;
  run.svf_mean_near_buildings = near.count > 0 ? std::optional(near.sum / static_cast<double>(near.count)) : std::nullopt;
}

void store_further_statistics(std::span<const SvfStatistics> all, const Quantities& further, EvaluationSummary& run) {
  for (const SvfStatistics& column : all) run.further.push_back(column.range());
  const std::optional<std::size_t> total = total_columns_of(further).total;
  if (!total || run.further.empty()) return;
  run.svf_total = run.further[*total];
  if (run.svf_total && further.svf_total_bounds) run.svf_total_bounds = all[*total].width();
}

}  // namespace farlod
