// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "farmap/edge_over_square.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "package/horizon_edge.hpp"

namespace farlod {
namespace {

/// Tangent of .49 π. An edge that some eye sees so far aside from where the centre of the square sees it is too close to be
/// bounded.
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

void EdgeOverSquare::set_edge(const Point3d& a, const Point3d& b, const Box2d& square) {
  a_ = a;
  b_ = b;
  corners_ = {square.low, Point2d{square.high.x, square.low.y}, square.high, Point2d{square.low.x, square.high.y}};
  nearest_m_ = distance_m(horizontal(a), horizontal(b), square, corners_);
  borders_known_ = false;
  high_at_m_ = low_at_m_ = std::numeric_limits<double>::quiet_NaN();
  bin_count_ = 0;
  // Angles count from the direction between the centres of square and edge
  const Point2d toward = 0.5 * (horizontal(a_) + horizontal(b_)) - 0.5 * (square.low + square.high);
  const std::optional<Turns> turns = turns_over(toward);
  constexpr Turn widest_right{-tangent_of_widest_turn, 1.0}, widest_left{tangent_of_widest_turn, 1.0};
  is_unbounded_ = !(turns && widest_right < turns->from && turns->to < widest_left && nearest_m_ > 0.0);
  if (!is_unbounded_) find_bins(*turns, toward);
}

/// The azimuth of an end is extreme at a corner of the square, so the four corners bound the edge for all eyes.
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
  // Where all corners are on one side of the edge's line, all eyes are
  one_sided_ = left == 4 || right == 4;
  return turns;
}

void EdgeOverSquare::find_bins(const Turns& turns, Point2d toward) {
  // The bins in which some eye sees the edge: rounding makes the range wider
  const Point2d from = turned(direction_of(turns.from, toward), -bound_rounding);
  const BinRange range = borders_->between(from, turned(direction_of(turns.to, toward), bound_rounding));
  first_bin_ = range.first;
  bin_count_ = range.count;
  // The bins that the edge covers whole for all eyes: rounding makes the range narrower
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

/// Tabulates the slopes of the edge's line at the borders of its bins, from each corner. They serve all heights: the slope is
/// linear in the eye's height.
void EdgeOverSquare::evaluate_borders() {
  if (borders_known_) return;
  borders_known_ = true;
  const std::size_t count = bin_count_ + 1;
  const double *cosine = borders_->cosines_from(first_bin_), *sine = borders_->sines_from(first_bin_);
  const Point2d along = horizontal(b_) - horizontal(a_);
  // u × (b − a) for each border's direction u: it is the same from each corner
  across_.resize(count);
  for (std::size_t n = 0; n < count; ++n) across_[n] = cosine[n] * along.y - sine[n] * along.x;
  for (std::size_t c = 0; c < corners_.size(); ++c) {
    const EdgeView view = seen_from(corners_[c], a_, b_);
    const SlopePlane plane = view.plane();
    const double turn = view.turn();
    FromCorner& seen = from_corner_[c];
    seen.slope_at_0.resize(count);
    seen.per_metre.resize(count);
    for (std::size_t n = 0; n < count; ++n) {
      // Beside or behind the eye the line bounds nothing
      const double per_metre = across_[n] / turn, slope_at_0 = plane.slope({cosine[n], sine[n]});
      const bool in_front = per_metre > 0.0;
      seen.per_metre[n] = in_front ? per_metre : 0.0;
      seen.slope_at_0[n] = in_front ? slope_at_0 : std::numeric_limits<double>::infinity();
    }
  }
}

std::span<const double> EdgeOverSquare::high(double z_m) {
  if (z_m == high_at_m_) return high_;
  high_at_m_ = z_m;
  // No eye sees it steeper than its highest end at the least distance
  const double rise_m = std::max(a_.z, b_.z) - z_m, anywhere = rise_m / nearest_m_;
  if (rise_m <= 0.0 || !one_sided_) {
    high_.assign(bin_count_, rise_m <= 0.0 ? 0.0 : anywhere + bound_rounding * (1.0 + anywhere));
    return high_;
  }
  // At a border, the eye that sees the line steepest is a corner of the square
  evaluate_borders();
  steepest_.resize(bin_count_ + 1);
  const auto& [p, q, r, s] = from_corner_;
  for (std::size_t n = 0; n < steepest_.size(); ++n) {
    const double south = std::max(p.slope_at_0[n] - z_m * p.per_metre[n], q.slope_at_0[n] - z_m * q.per_metre[n]);
    const double north = std::max(r.slope_at_0[n] - z_m * r.per_metre[n], s.slope_at_0[n] - z_m * s.per_metre[n]);
    steepest_[n] = std::max(0.0, std::max(south, north));
  }
  // Within a bin, slope(u) is a cosine of the azimuth: it exceeds the steeper border by no more than 1 / cos(half a bin)
  high_.resize(bin_count_);
  const double cos_half_bin = borders_->cos_half_bin();
  for (std::size_t n = 0; n < bin_count_; ++n) {
    const double bound = std::min(anywhere, std::max(steepest_[n], steepest_[n + 1]) / cos_half_bin);
    high_[n] = bound + bound_rounding * (1.0 + bound);
  }
  return high_;
}

std::span<const double> EdgeOverSquare::low(double z_m) {
  if (z_m == low_at_m_) return low_;
  low_at_m_ = z_m;
  low_.assign(bin_count_, 0.0);
  if (common_begin_ == common_end_ || std::max(a_.z, b_.z) <= z_m) return low_;
  // The least slope at the two borders, from all corners: between them a positive cosine is nowhere less
  evaluate_borders();
  for (std::size_t n = common_begin_; n < common_end_; ++n) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (from_corner_[0].slope_at_0[n] == infinity || from_corner_[0].slope_at_0[n + 1] == infinity) continue;
    double flattest = infinity;
    for (const FromCorner& seen : from_corner_)
      flattest = std::min(
          {flattest, seen.slope_at_0[n] - z_m * seen.per_metre[n], seen.slope_at_0[n + 1] - z_m * seen.per_metre[n + 1]});
    low_[n] = std::max(0.0, flattest - bound_rounding * (1.0 + std::abs(flattest)));
  }
  return low_;
}

}  // namespace farlod
