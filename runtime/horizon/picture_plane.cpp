// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/picture_plane.hpp"

#include <cmath>

#include "base/expects.hpp"

namespace farlod {
namespace {

/// A receiver whose normal rises or falls by less is upright.
constexpr double level_normal = 1e-9;

/// The spherical triangle of both ends and the zenith: the tangent of half of it is the volume that the three unit vectors span
/// over 1 and the sum of their products.
double solid_angle_up_to_zenith(const PicturePlane::Place& left, const PicturePlane::Place& right) {
  const double p = std::sqrt(1.0 + left.t * left.t + left.y * left.y), q = std::sqrt(1.0 + right.t * right.t + right.y * right.y);
  const double cosines = p * q + (1.0 + left.t * right.t + left.y * right.y) + left.y * q + right.y * p;
  return 2.0 * std::atan2(right.t - left.t, cosines);
}

}  // namespace

PicturePlane::PicturePlane(const Wedge& wedge, const Point3d& normal, SkyWeight weight)
    : wedge_(wedge), normal_(in_wedge(normal)), weight_(weight) {
  FARLOD_EXPECTS(wedge.tangent > 0.0);
  // A level line of sight is in front of the receiver where n_x + n_y τ ≥ 0
  const double first = normal_.x, last = normal_.x + normal_.y * wedge.tangent;
  if ((first < 0.0) == (last < 0.0)) {
    add_floor(0.0, wedge.tangent, first >= 0.0);
  } else {
    const double turn = wedge.tangent * (first / (first - last));
    add_floor(0.0, turn, first >= 0.0);
    add_floor(turn, wedge.tangent, last >= 0.0);
  }
}

void PicturePlane::add_floor(double from, double to, bool is_in_front) {
  if (!(from < to)) return;
  if (is_in_front)
    floor_[parts_++] = {{from, 0.0}, {to, 0.0}};
  else if (normal_.z > level_normal)
    floor_[parts_++] = {plane_at(from), plane_at(to)};
}

double PicturePlane::sky_above(const Place& left, const Place& right) const {
  if (normal_.z >= -level_normal) return sky_up_to_zenith(left, right);
  // A receiver that looks down has sky below its own plane
  const Place first = plane_at(left.t), last = plane_at(right.t);
  const double open_left = first.y - left.y, open_right = last.y - right.y;
  if (open_left <= 0.0 && open_right <= 0.0) return 0.0;
  if (open_left >= 0.0 && open_right >= 0.0) return sky_up_to_zenith(left, right) - sky_up_to_zenith(first, last);
  const Place crossing = plane_at(left.t + (right.t - left.t) * (open_left / (open_left - open_right)));
  return open_left > 0.0 ? sky_up_to_zenith(left, crossing) - sky_up_to_zenith(first, crossing)
                         : sky_up_to_zenith(crossing, right) - sky_up_to_zenith(crossing, last);
}

/// Lambert's formula: a sum over the borders of (angle) × (unit normal of the border's plane) · n. The borders are the segment,
/// and two upright ones up to the zenith.
double PicturePlane::sky_up_to_zenith(const Place& left, const Place& right) const {
  if (weight_ == SkyWeight::solid_angle) return solid_angle_up_to_zenith(left, right);
  const Point3d p{1.0, left.t, left.y}, q{1.0, right.t, right.y};
  const Point3d across = cross(p, q);
  const double scale = 1.0 / std::sqrt(dot(p, p) * dot(q, q)), x = 1.0 - dot(p, q) * scale;
  // (angle)/sin(angle) · 1/(|p| |q|): where the angle is small, by its series in x = 1 − cos(angle), Σ (n!)² (2x)ⁿ/(2n + 1)!, of
  // which the first term that is left out is below 3e-17
  constexpr double small = 0.01;
  double sky = dot(across, normal_);
  if (x < small) {
    const double high = 2.0 / 35.0 + x * (8.0 / 315.0 + x * (8.0 / 693.0 + x * (16.0 / 3003.0)));
    sky *= scale * (1.0 + x * (1.0 / 3.0 + x * (2.0 / 15.0 + x * high)));
  } else {
    const double sine = norm(across);
    sky *= std::atan2(sine, dot(p, q)) / sine;
  }
  if (normal_.x == 0.0 && normal_.y == 0.0) return sky;
  const auto upright = [this](const Place& at) {
    const double run = std::sqrt(1.0 + at.t * at.t);
    return std::atan2(run, at.y) * (at.t * normal_.x - normal_.y) / run;
  };
  return sky + upright(right) - upright(left);
}

}  // namespace farlod
