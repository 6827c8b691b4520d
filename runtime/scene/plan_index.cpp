// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/plan_index.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "base/expects.hpp"

namespace farlod {
namespace {

constexpr std::size_t most_squares_along = 64;

/// Rounding of this file's own doubles, as a share of the coordinates: a thousand times what a sum of products loses.
constexpr double own_rounding = 1e-12;

struct Interval {
  double low, high;
};

/// Columns of a row, half open. A triangle covers none but `possible`, and all of `certain`, whatever rounding says.
struct Columns {
  std::size_t possible_begin = 0, possible_end = 0, certain_begin = 0, certain_end = 0;
};

/// The distance from a line is at_first + column·per_column + row·per_row, in metres, positive on the inner side.
struct Line {
  double at_first = 0.0, per_column = 0.0, per_row = 0.0;
};

/// The rows and columns of a lattice that one triangle covers.
class TriangleRows {
 public:
  TriangleRows(const PlanTriangle& t, const PlanLattice& lattice)
      : count_(lattice.columns), slack_m_(lattice.rounding_m + own_rounding * reach_m(t, lattice)) {
    columns_ = extent(t, lattice, lattice.column_m);
    rows_ = extent(t, lattice, lattice.row_m());
    if (row_begin() < row_end(lattice.rows)) set_lines(t, lattice);
  }

  [[nodiscard]] std::size_t row_begin() const { return first_from(rows_.low); }
  [[nodiscard]] std::size_t row_end(std::size_t rows) const { return std::min(end_at(rows_.high), rows); }

  [[nodiscard]] Columns columns_of(std::size_t row) const {
    Interval possible = columns_, certain = columns_;
    for (const Line& line : lines_) {
      const double distance_m = line.at_first + static_cast<double>(row) * line.per_row;
      narrow(possible, line.per_column, distance_m + slack_m_);
      narrow(certain, line.per_column, distance_m - slack_m_);
    }
    const auto end = [this](double high) { return std::min(end_at(high), count_); };
    return {first_from(possible.low), end(possible.high), first_from(certain.low), end(certain.high)};
  }

 private:
  /// No coordinate is larger.
  [[nodiscard]] static double reach_m(const PlanTriangle& t, const PlanLattice& lattice) {
    double reach = std::max(std::abs(lattice.first_m.x), std::abs(lattice.first_m.y));
    for (const Point3f& p : t) reach = std::max({reach, double{std::abs(p.x)}, double{std::abs(p.y)}});
    return reach;
  }
  /// Where a triangle begins and ends along a step of the lattice, counted in steps, with slack.
  [[nodiscard]] Interval extent(const PlanTriangle& t, const PlanLattice& lattice, Point2d step_m) const {
    const double per_step = 1.0 / dot(step_m, step_m), slack = slack_m_ * std::sqrt(per_step);
    Interval steps{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const Point3f& p : t) {
      const double at = dot(Point2d{p.x, p.y} - lattice.first_m, step_m) * per_step;
      steps = {std::min(steps.low, at), std::max(steps.high, at)};
    }
    return {steps.low - slack, steps.high + slack};
  }
  void set_lines(const PlanTriangle& t, const PlanLattice& lattice) {
    const double inwards = plan_area(t) > 0.0 ? 1.0 : -1.0;
    for (std::size_t k = 0; k < 3; ++k) lines_[k] = line(t[k], t[(k + 1) % 3], inwards, lattice);
  }
  /// The line from a to b; its inner side is to the left where `inwards` is 1, to the right where it is −1.
  [[nodiscard]] static Line line(const Point3f& a, const Point3f& b, double inwards, const PlanLattice& lattice) {
    const double along_x = double{b.x} - a.x, along_y = double{b.y} - a.y;
    const double per_length = inwards / std::sqrt(along_x * along_x + along_y * along_y);
    const Point2d normal{-along_y * per_length, along_x * per_length};
    return {dot(lattice.first_m - Point2d{a.x, a.y}, normal), dot(lattice.column_m, normal), dot(lattice.row_m(), normal)};
  }
  /// Leaves the columns where distance_m + column·per_column is not negative.
  static void narrow(Interval& columns, double per_column, double distance_m) {
    if (per_column > 0.0) {
      columns.low = std::max(columns.low, -distance_m / per_column);
    } else if (per_column < 0.0) {
      columns.high = std::min(columns.high, -distance_m / per_column);
    } else if (distance_m < 0.0) {
      columns.high = -1.0;
    }
  }
  [[nodiscard]] static std::size_t first_from(double low) {
    return static_cast<std::size_t>(std::ceil(std::clamp(low, 0.0, most)));
  }
  [[nodiscard]] static std::size_t end_at(double high) {
    return static_cast<std::size_t>(std::floor(std::clamp(high, -1.0, most)) + 1.0);
  }
  static constexpr double most = 1e9;

  std::size_t count_;
  double slack_m_ = 0.0;
  Interval columns_{}, rows_{};
  std::array<Line, 3> lines_;
};

}  // namespace

template <class Visit>
void PlanIndex::for_each_square(const Visit& visit) const {
  for (std::uint32_t n = 0; n < triangles_.size(); ++n) {
    if (plan_area(triangles_[n]) == 0.0) continue;
    const PlanOutline o = outline_of(triangles_[n]);
    for (std::size_t row = row_of(o.south); row <= row_of(o.north); ++row)
      for (std::size_t column = column_of(o.west); column <= column_of(o.east); ++column) visit(row * edge_ + column, n);
  }
}

PlanIndex::PlanIndex(std::vector<PlanTriangle> triangles) : triangles_(std::move(triangles)) {
  if (triangles_.empty()) return;
  lay_out_squares();
  // Count the triangles of each square, sum up where each square begins, then place the numbers
  first_of_.assign(edge_ * edge_ + 1, 0);
  for_each_square([this](std::size_t square, std::uint32_t) { ++first_of_[square + 1]; });
  for (std::size_t square = 1; square < first_of_.size(); ++square) first_of_[square] += first_of_[square - 1];
  numbers_.resize(first_of_.back());
  std::vector<std::uint32_t> next(first_of_.begin(), first_of_.end() - 1);
  for_each_square([&](std::size_t square, std::uint32_t n) { numbers_[next[square]++] = n; });
}

void PlanIndex::lay_out_squares() {
  PlanOutline all{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
                  std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
  for (const PlanTriangle& t : triangles_) {
    const PlanOutline o = outline_of(t);
    all = {std::min(all.west, o.west), std::max(all.east, o.east), std::min(all.south, o.south), std::max(all.north, o.north)};
  }
  low_ = {all.west, all.south, 0.0F};
  // As many squares as triangles, so that each holds few
  edge_ =
      std::clamp<std::size_t>(static_cast<std::size_t>(std::sqrt(static_cast<double>(triangles_.size()))), 1, most_squares_along);
  const auto per_metre = [this](float length) { return length > 0.0F ? static_cast<float>(edge_) / length : 0.0F; };
  per_x_ = per_metre(all.east - all.west);
  per_y_ = per_metre(all.north - all.south);
}

std::size_t PlanIndex::column_of(float x) const {
  const float place = std::clamp((x - low_.x) * per_x_, 0.0F, static_cast<float>(edge_ - 1));
  return static_cast<std::size_t>(place);
}

std::size_t PlanIndex::row_of(float y) const {
  const float place = std::clamp((y - low_.y) * per_y_, 0.0F, static_cast<float>(edge_ - 1));
  return static_cast<std::size_t>(place);
}

void PlanIndex::find(float x, float y, std::vector<PlanCrossing>& crossings) const {
  if (triangles_.empty()) return;
  const std::size_t square = row_of(y) * edge_ + column_of(x);
  for (std::uint32_t k = first_of_[square]; k < first_of_[square + 1]; ++k) {
    const PlanTriangle& t = triangles_[numbers_[k]];
    if (covers(t, x, y)) crossings.push_back({numbers_[k], height_at(t, x, y)});
  }
}

void LatticeCrossings::find(std::span<const PlanTriangle> triangles, const PlanLattice& lattice) {
  const std::size_t places = lattice.columns * lattice.rows;
  FARLOD_EXPECTS(places <= std::numeric_limits<std::uint32_t>::max() && lattice.x.size() == places && lattice.y.size() == places);
  found_.clear();
  for (std::uint32_t n = 0; n < triangles.size(); ++n)
    if (plan_area(triangles[n]) != 0.0) add(n, triangles[n], lattice);
  sort_by_place(places);
}

void LatticeCrossings::add(std::uint32_t number, const PlanTriangle& t, const PlanLattice& lattice) {
  const TriangleRows rows(t, lattice);
  for (std::size_t row = rows.row_begin(); row < rows.row_end(lattice.rows); ++row) {
    const Columns columns = rows.columns_of(row);
    for (std::size_t column = columns.possible_begin; column < columns.possible_end; ++column) {
      const std::size_t place = row * lattice.columns + column;
      const float x = lattice.x[place], y = lattice.y[place];
      const bool is_certain = columns.certain_begin <= column && column < columns.certain_end;
      if (is_certain || covers(t, x, y)) found_.push_back({static_cast<std::uint32_t>(place), {number, height_at(t, x, y)}});
    }
  }
}

void LatticeCrossings::sort_by_place(std::size_t places) {
  // Count the crossings of each place, sum up where each place begins, then place the crossings
  first_of_.assign(places + 1, 0);
  for (const Found& f : found_) ++first_of_[f.place];
  std::size_t end = 0;
  for (std::size_t& n : first_of_) n = end += n;
  crossings_.resize(found_.size());
  for (auto f = found_.rbegin(); f != found_.rend(); ++f) crossings_[--first_of_[f->place]] = f->crossing;
}

}  // namespace farlod
