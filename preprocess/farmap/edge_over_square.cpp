// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "farmap/edge_over_square.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "farlod/horizon/edge_view.hpp"

namespace farlod {
namespace {

/// An edge that some eye sees this far from where the middle sees it is too close to be bounded: its tangent, of .49 π.
constexpr double tangent_of_widest_turn = 31.82;

double squared(Point2d d) { return dot(d, d); }

double squared_distance(const Point2d& p, const Box2d& box) {
  return squared({std::max({box.low.x - p.x, p.x - box.high.x, 0.0}), std::max({box.low.y - p.y, p.y - box.high.y, 0.0})});
}

double squared_distance(Point2d a, Point2d b, Point2d p) {
  const Point2d along = b - a;
  const double length = dot(along, along);
  const double s = length > 0.0 ? std::clamp(dot(p - a, along) / length, 0.0, 1.0) : 0.0;
  return squared(a + s * along - p);
}

/// Between a segment and a box that it does not cross.
double distance_m(Point2d a, Point2d b, const Box2d& box, const std::array<Point2d, 4>& corners) {
  double nearest = std::min(squared_distance(a, box), squared_distance(b, box));
  for (const Point2d corner : corners) nearest = std::min(nearest, squared_distance(a, b, corner));
  return std::sqrt(nearest);
}

EdgeView seen_from(Point2d eye, const Point3d& a, const Point3d& b) {
  return {a - Point3d{eye.x, eye.y, 0.0}, b - Point3d{eye.x, eye.y, 0.0}};
}

}  // namespace

void EdgeOverSquare::look_at(const Point3d& a, const Point3d& b, const Box2d& square) {
  a_ = a;
  b_ = b;
  corners_ = {square.low, Point2d{square.high.x, square.low.y}, square.high, Point2d{square.low.x, square.high.y}};
  nearest_m_ = distance_m(horizontal(a), horizontal(b), square, corners_);
  borders_known_ = false;
  upper_at_m_ = lower_at_m_ = std::numeric_limits<double>::quiet_NaN();
  bin_count_ = 0;
  const Point2d toward = 0.5 * (horizontal(a_) + horizontal(b_)) - 0.5 * (square.low + square.high);
  const std::optional<Turns> turns = turns_over(toward);
  constexpr Turn widest_right{-tangent_of_widest_turn, 1.0}, widest_left{tangent_of_widest_turn, 1.0};
  surrounds_ = !(turns && widest_right < turns->from && turns->to < widest_left && nearest_m_ > 0.0);
  if (!surrounds_) find_range(*turns, toward);
}

std::optional<EdgeOverSquare::Turns> EdgeOverSquare::turns_over(Point2d toward) {
  Turns turns;
  int left = 0, right = 0;
  for (std::size_t c = 0; c < corners_.size(); ++c) {
    const EdgeView view = seen_from(corners_[c], a_, b_);
    Turn low = turn_to(horizontal(view.a), toward), high = turn_to(horizontal(view.b), toward);
    if (low.ahead <= 0.0 || high.ahead <= 0.0) return std::nullopt;
    if (high < low) std::swap(low, high);
    if (c == 0) turns = {low, high, low, high};
    turns.from = std::min(turns.from, low);
    turns.to = std::max(turns.to, high);
    turns.common_from = std::max(turns.common_from, low);
    turns.common_to = std::min(turns.common_to, high);
    left += view.turn() > 0.0 ? 1 : 0;
    right += view.turn() < 0.0 ? 1 : 0;
  }
  one_sided_ = left == 4 || right == 4;
  return turns;
}

void EdgeOverSquare::find_range(const Turns& turns, Point2d toward) {
  const Point2d from = turned(direction_of(turns.from, toward), -bound_rounding);
  const BinRange range = borders_->between(from, turned(direction_of(turns.to, toward), bound_rounding));
  first_bin_ = range.first;
  bin_count_ = range.count;
  common_begin_ = common_end_ = 0;
  if (!one_sided_ || turns.common_to < turns.common_from) return;
  const Point2d common_from = turned(direction_of(turns.common_from, toward), bound_rounding);
  const Point2d common_to = turned(direction_of(turns.common_to, toward), -bound_rounding);
  if (turn_to(common_to, common_from).aside <= 0.0) return;
  // Not the bins that the ends of the common range lie in: the whole bin must be covered
  common_begin_ = borders_->between(from, common_from).count;
  common_end_ = borders_->between(from, common_to).count - 1;
  if (common_begin_ >= common_end_) common_begin_ = common_end_ = 0;
}

void EdgeOverSquare::evaluate_borders() {
  if (borders_known_) return;
  borders_known_ = true;
  const std::size_t count = bin_count_ + 1;
  const double *cosine = borders_->cosines_from(first_bin_), *sine = borders_->sines_from(first_bin_);
  const Point2d along = horizontal(b_) - horizontal(a_);
  across_.resize(count);
  for (std::size_t n = 0; n < count; ++n) across_[n] = cosine[n] * along.y - sine[n] * along.x;
  for (std::size_t c = 0; c < corners_.size(); ++c) {
    const EdgeView view = seen_from(corners_[c], a_, b_);
    const SlopePlane plane = view.plane();
    const double turn = view.turn();
    FromCorner& seen = from_corner_[c];
    seen.rise.resize(count);
    seen.per_metre.resize(count);
    for (std::size_t n = 0; n < count; ++n) {
      // Beside or behind the eyes the line bounds nothing, however high it seems
      const double per_metre = across_[n] / turn, rise = plane.slope({cosine[n], sine[n]});
      const bool in_front = per_metre > 0.0;
      seen.per_metre[n] = in_front ? per_metre : 0.0;
      seen.rise[n] = in_front ? rise : std::numeric_limits<double>::infinity();
    }
  }
}

std::span<const double> EdgeOverSquare::high(double z_m) {
  if (z_m == upper_at_m_) return upper_;
  upper_at_m_ = z_m;
  const double rise_m = std::max(a_.z, b_.z) - z_m, anywhere = rise_m / nearest_m_;
  if (rise_m <= 0.0 || !one_sided_) {
    upper_.assign(bin_count_, rise_m <= 0.0 ? 0.0 : anywhere + bound_rounding * (1.0 + anywhere));
    return upper_;
  }
  evaluate_borders();
  steepest_.resize(bin_count_ + 1);
  const auto& [p, q, r, s] = from_corner_;
  for (std::size_t n = 0; n < steepest_.size(); ++n) {
    const double south = std::max(p.rise[n] - z_m * p.per_metre[n], q.rise[n] - z_m * q.per_metre[n]);
    const double north = std::max(r.rise[n] - z_m * r.per_metre[n], s.rise[n] - z_m * s.per_metre[n]);
    steepest_[n] = std::max(0.0, std::max(south, north));
  }
  upper_.resize(bin_count_);
  const double cos_half_bin = borders_->cos_half_bin();
  for (std::size_t n = 0; n < bin_count_; ++n) {
    const double bound = std::min(anywhere, std::max(steepest_[n], steepest_[n + 1]) / cos_half_bin);
    upper_[n] = bound + bound_rounding * (1.0 + bound);
  }
  return upper_;
}

std::span<const double> EdgeOverSquare::low(double z_m) {
  if (z_m == lower_at_m_) return lower_;
  lower_at_m_ = z_m;
  lower_.assign(bin_count_, 0.0);
  if (common_begin_ == common_end_ || std::max(a_.z, b_.z) <= z_m) return lower_;
  evaluate_borders();
  for (std::size_t n = common_begin_; n < common_end_; ++n) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (from_corner_[0].rise[n] == infinity || from_corner_[0].rise[n + 1] == infinity) continue;
    double flattest = infinity;
    for (const FromCorner& seen : from_corner_)
      flattest = std::min({flattest, seen.rise[n] - z_m * seen.per_metre[n], seen.rise[n + 1] - z_m * seen.per_metre[n + 1]});
    lower_[n] = std::max(0.0, flattest - bound_rounding * (1.0 + std::abs(flattest)));
  }
  return lower_;
}

}  // namespace farlod
