// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/wedge_envelope.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace farlod {
namespace {

/// An edge nearer than this in the plan is taken to be as far away: it stands straight up there.
constexpr double nearest_m = 1e-6;

}  // namespace

void WedgeEnvelope::begin(const Wedge& wedge, const Point3d& normal, SkyWeight weight) {
  picture_.emplace(wedge, normal, weight);
  const std::span<const Segment> floor = picture_->floor();
  segments_.assign(floor.begin(), floor.end());
  from_ = floor.empty() ? 0.0 : floor.front().left.t;
  to_ = floor.empty() ? 0.0 : floor.back().right.t;
  lid_ = 0.0;
}

void WedgeEnvelope::add(const Point3d& a, const Point3d& b) {
  const Point3d p = picture_->in_wedge(a), q = picture_->in_wedge(b);
  // In front, and below what hides all of the wedge
  if (p.z <= lid_ * p.x && q.z <= lid_ * q.x && p.x > 0.0 && q.x > 0.0) return;
  // The part of the edge in the wedge, from the share u0 to the share u1 of it
  double u0 = 0.0, u1 = 1.0;
  const auto clip = [&](double at_p, double at_q) {  // to where it is positive; the share at which it is 0
    const double share = at_p / (at_p - at_q);
    if (at_p < 0.0)
      u0 = std::max(u0, at_q < 0.0 ? 2.0 : share);
    else if (at_q < 0.0)
      u1 = std::min(u1, share);
    return share;
  };
  const double tangent = picture_->tangent();
  const double first = clip(p.y, q.y), last = clip(tangent * p.x - p.y, tangent * q.x - q.y);
  if (!(u0 <= u1)) return;
  const auto place = [&](double u) {
    const Point3d at = p + u * (q - p);
    const double x = std::max(at.x, nearest_m);
    // Exactly at the border, so that nothing is seen beside an edge that passes close by
    return Place{u == first ? 0.0 : u == last ? tangent : std::clamp(at.y / x, 0.0, tangent), at.z / x};
  };
  Place left = place(u0), right = place(u1);
  if (left.t > right.t) std::swap(left, right);
  if (std::max(left.y, right.y) <= lid_) return;
  segments_.emplace_back(left, right);
  if (left.t <= from_ && right.t >= to_) lid_ = std::max(lid_, std::min(left.y, right.y));
}

/// The highest segment at and right of a place.
std::size_t WedgeEnvelope::highest_at(double t) const {
  std::size_t best = segments_.size();
  for (std::size_t n = 0; n < segments_.size(); ++n) {
    const Segment& s = segments_[n];
    if (!(s.left.t <= t && t < s.right.t)) continue;
    const double above = best < segments_.size() ? s.at(t) - segments_[best].at(t) : 1.0;
    if (above > 0.0 || (above == 0.0 && s.rise > segments_[best].rise)) best = n;
  }
  return best;
}

WedgeEnvelope::Step WedgeEnvelope::step_from(double t, std::size_t now) const {
  const Segment& s = segments_[now];
  Step step{std::min(s.right.t, to_), std::nullopt};
  for (std::size_t n = 0; n < segments_.size(); ++n) {
    const Segment& other = segments_[n];
    const double start = std::max(t, other.left.t);
    if (n == now || start > step.end || start >= other.right.t) continue;
    const double above = other.at(start) - s.at(start), gain = other.rise - s.rise;
    if (above > 0.0 && start > t) {
      step = {start, std::nullopt};  // others may begin at the same place
    } else if (gain > 0.0) {
      const double crossing = start - std::min(above, 0.0) / gain;
      if (crossing < std::min(step.end, other.right.t)) step = {crossing, n};
    }
  }
  return step;
}

/// From the left end to the right one along the highest segment: to where it ends, another one begins above it, or another one
/// crosses it from below. It comes to an end: a step that leads nowhere is a crossing, and each crossing leads to a steeper
/// segment.
WedgeEnvelope::Sky WedgeEnvelope::sky_along(std::vector<Segment>* envelope) const {
  Sky sky;
  if (!(to_ > from_)) return sky;
  double t = from_;
  for (std::size_t now = highest_at(t); t < to_;) {
    const Step step = step_from(t, now);
    const Place left{t, segments_[now].at(t)}, right{step.end, segments_[now].at(step.end)};
    sky.lowest = std::min({sky.lowest, left.y, right.y});
    sky.sky += picture_->sky_above(left, right);
    if (envelope != nullptr && left.t < right.t) envelope->emplace_back(left, right);
    t = step.end;
    if (t < to_) now = step.next ? *step.next : highest_at(t);
  }
  return sky;
}

WedgeEnvelope::Sky WedgeEnvelope::sky_of_kept_envelope() {
  kept_.clear();
  const Sky sky = sky_along(&kept_);
  std::swap(segments_, kept_);
  lid_ = std::max(lid_, sky.lowest);
  return sky;
}

}  // namespace farlod
