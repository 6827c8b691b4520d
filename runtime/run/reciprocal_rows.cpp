// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "run/reciprocal_rows.hpp"

#include <algorithm>
#include <cmath>

namespace farlod {
namespace {

double sum_of(std::span<const ViewShare> shares) {
  double sum = 0.0;
  for (const ViewShare& s : shares) sum += static_cast<double>(s.share);
  return sum;
}

/// Those that say what is seen of surfaces.
std::span<const ViewShare> of_surfaces(std::span<const ViewShare> shares, std::size_t surfaces) {
  const auto end = std::ranges::lower_bound(shares, surfaces, {}, [](const ViewShare& s) { return std::size_t{s.column}; });
  return shares.first(static_cast<std::size_t>(end - shares.begin()));
}

/// Receivers, and so rays, to the area. A surface that is seen may have none, where all of them are covered.
double density_of(const FoundRow& row) { return row.receivers == 0 ? 0.0 : static_cast<double>(row.receivers) / row.area_m2; }

}  // namespace

ReciprocalRows::ReciprocalRows(std::span<const FoundRow> rows) : rows_(rows), ends_(rows.size() + 1, 0) {
  // Places are counted one further, and each is moved to its end while it is filled
  for (const FoundRow& row : rows)
    for (const ViewShare& s : of_surfaces(row.shares, rows.size())) ++ends_[s.column + 1];
  for (std::size_t n = 1; n < ends_.size(); ++n) ends_[n] += ends_[n - 1];
  by_others_.resize(ends_.back());
  for (std::size_t n = 0; n < rows.size(); ++n)
    for (const ViewShare& s : of_surfaces(rows[n].shares, rows.size()))
      by_others_[ends_[s.column]++] = {static_cast<std::uint32_t>(n), s.share};
}

std::span<const ViewShare> ReciprocalRows::found_by_others(std::size_t n) const {
  const std::uint64_t begin = n == 0 ? 0 : ends_[n - 1];
  return std::span(by_others_).subspan(begin, ends_[n] - begin);
}

void ReciprocalRows::add_pair(std::size_t n, ViewShare found, ViewShare by_other, std::vector<ViewShare>& row) {
  const FoundRow &here = rows_[n], &there = rows_[found.column];
  const double of_here = static_cast<double>(found.share), of_there = static_cast<double>(by_other.share);
  const double rays = static_cast<double>(here.receivers) * of_here + static_cast<double>(there.receivers) * of_there;
  row.push_back({found.column, static_cast<float>(rays / (density_of(here) + density_of(there)) / here.area_m2)});
  if (found.column <= n) return;
  const double deviation = std::abs(here.area_m2 * of_here - there.area_m2 * of_there) / std::max(here.area_m2, there.area_m2);
  ++pairs_;
  reciprocity_sum_ += deviation;
  figures_.reciprocity_max = std::max(figures_.reciprocity_max, deviation);
}

std::vector<ViewShare> ReciprocalRows::row(std::size_t n) {
  const FoundRow& found = rows_[n];
  std::vector<ViewShare> row;
  if (found.receivers == 0) return row;
  const std::span<const ViewShare> surfaces = of_surfaces(found.shares, rows_.size()), others = found_by_others(n);
  auto here = surfaces.begin();
  auto there = others.begin();
  while (here != surfaces.end() || there != others.end()) {
    const bool is_here = here != surfaces.end() && (there == others.end() || here->column <= there->column);
    const bool is_there = there != others.end() && (here == surfaces.end() || there->column <= here->column);
    const std::uint32_t column = is_here ? here->column : there->column;
    add_pair(n, {column, is_here ? (here++)->share : 0.0F}, {column, is_there ? (there++)->share : 0.0F}, row);
  }
  close(found, sum_of(surfaces), row);
  return row;
}

void ReciprocalRows::close(const FoundRow& found, double surfaces_before, std::vector<ViewShare>& row) {
  const double surfaces = sum_of(row), change = std::abs(surfaces - surfaces_before);
  const std::span<const ViewShare> rest = std::span(found.shares).subspan(of_surfaces(found.shares, rows_.size()).size());
  closure_sum_ += change;
  figures_.closure_max = std::max(figures_.closure_max, change);
  const double of_rest = sum_of(rest);
  if (surfaces < 1.0 && of_rest > 0.0) {
    for (const ViewShare& s : rest)
      row.push_back({s.column, static_cast<float>(static_cast<double>(s.share) * (1.0 - surfaces) / of_rest)});
    return;
  }
  ++figures_.divided_rows;
  for (ViewShare& s : row) s.share = static_cast<float>(static_cast<double>(s.share) / surfaces);
}

MatrixFigures ReciprocalRows::figures() const {
  MatrixFigures figures = figures_;
  const auto with_receivers = std::ranges::count_if(rows_, [](const FoundRow& row) { return row.receivers > 0; });
  figures.reciprocity_mean = pairs_ > 0 ? reciprocity_sum_ / static_cast<double>(pairs_) : 0.0;
  figures.closure_mean = with_receivers > 0 ? closure_sum_ / static_cast<double>(with_receivers) : 0.0;
  for (const FoundRow& row : rows_) figures.receivers += row.receivers;
  return figures;
}

}  // namespace farlod
