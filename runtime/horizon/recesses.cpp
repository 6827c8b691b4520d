// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/recesses.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace farlod {
namespace {

/// Coordinates of packages are rounded, and a recess reaches some millimetres into its sides.
constexpr double give_m = 0.01;

/// How an edge lies about an eye, in the plan.
struct EdgeBeside {
  double ahead_m = 0.0, run_m = 0.0;  ///< from its first end to the foot of the eye on its line, and to the other end
  double aside_m = 0.0;               ///< from the line to the eye
  bool is_above_facet = true;         ///< whether the eye is above the facet on its side, or there is a wall

  EdgeBeside(const HorizonEdge& edge, const Point3d& eye) {
    const Point3d a = to_double(edge.a), along = to_double(edge.b) - a;
    run_m = norm(horizontal(along));
    if (run_m == 0.0) return;
    const Point2d v = horizontal(eye - a);
    ahead_m = dot(horizontal(along), v) / run_m;
    const double left_m = (along.x * v.y - along.y * v.x) / run_m;
    aside_m = std::abs(left_m);
    const std::int8_t facet = left_m > 0.0 ? edge.adjacent.left : edge.adjacent.right;
    if (facet == AdjacentSlopes::straight_down) return;
    // As in may_be_silhouette, at right angles to the edge
    const double rise_m = ((eye.z - a.z) * run_m - ahead_m * along.z) / norm(along);
    is_above_facet = rise_m > aside_m * AdjacentSlopes::slope(facet) - facing_slack_m;
  }
  /// Whether the edge may lie over a recess of at most this depth with the eye in it, at right angles to the edge.
  [[nodiscard]] bool may_be_over(double depth_m) const {
    return !is_above_facet && aside_m <= depth_m + give_m && ahead_m >= -give_m && ahead_m <= run_m + give_m;
  }
  /// Whether it is one of the borders around that recess.
  [[nodiscard]] bool may_be_own() const {
    const double beyond_m = std::max({-ahead_m, ahead_m - run_m, 0.0}), reach_m = most_recess_extent_m + give_m;
    return !is_above_facet && aside_m * aside_m + beyond_m * beyond_m <= reach_m * reach_m;
  }

 private:
  static Point3d to_double(const Point3f& p) { return {p.x, p.y, p.z}; }
};

/// Whether an interval comes so near to another one that an edge in it may be a receiver's own.
bool is_near(float a, float b, float centre, float half) {
  constexpr auto reach_m = static_cast<float>(most_recess_extent_m + 2.0 * give_m);
  return std::min(a, b) <= centre + half + reach_m && std::max(a, b) >= centre - half - reach_m;
}

Point3d eye_of(const ReceiverPacket& r, std::size_t lane) { return {r.x[lane], r.y[lane], r.z[lane]}; }

}  // namespace

Overhead Recesses::overhead_of(const ReceiverPacket& r, std::uint32_t below) const {
  Overhead overhead{below, 0};
  if (below == 0) return overhead;
  for (const HorizonEdge& edge : silhouettes_.over_recesses) {
    const double depth_m = edge.role == EdgeRole::grounded ? most_recess_depth_m : max_lean_m;
    for (std::size_t l = 0; l < r.count; ++l)
      if (has_bit(below, l) && EdgeBeside(edge, eye_of(r, l)).may_be_over(depth_m)) overhead.in_recess |= 1U << l;
  }
  return overhead;
}

/// Borders of all recesses of the packet are drawn for those receivers alone to whose recess they do not belong.
void Recesses::draw_others(const ReceiverPacket& receivers, std::uint32_t in_recess, PacketHorizon& grounded) {
  const SilhouetteEdges& all = silhouettes_.grounded;
  chosen_.assign(all.batches().size(), 0xFFFF);
  for (const OwnBorder& border : own_) choose(border.number, false);
  edges_.assign(all, chosen_);
  drawn_.raise(edges_, receivers);
  for (std::size_t l = 0; l < receivers.count; ++l) {
    if (!has_bit(in_recess, l)) continue;
    grounded.copy_lane(l, drawn_);
    chosen_.assign(all.batches().size(), 0);
    for (const OwnBorder& border : own_)
      if (!has_bit(border.receivers, l)) choose(border.number, true);
    edges_.assign(all, chosen_);
    by_others_.clear();
    by_others_.raise(edges_, receivers);
    grounded.raise_lane(l, by_others_);
  }
}

void Recesses::choose(std::size_t number, bool is_chosen) {
  const auto bit = static_cast<std::uint16_t>(1U << number % SilhouetteEdges::lanes);
  std::uint16_t& batch = chosen_[number / SilhouetteEdges::lanes];
  batch = static_cast<std::uint16_t>(is_chosen ? batch | bit : batch & ~bit);
}

void Recesses::find_own_borders(const ReceiverPacket& receivers, std::uint32_t in_recess) {
  const SilhouetteEdges& all = silhouettes_.grounded;
  const CenteredBox box = bounds_of(receivers).box;
  own_.clear();
  for (std::size_t n = 0; n < all.size(); ++n) {
    const SilhouetteEdges::Batch& e = all.batches()[n / SilhouetteEdges::lanes];
    const std::size_t k = n % SilhouetteEdges::lanes;
    if (!is_near(e.ax[k], e.bx[k], box.x, box.half_x) || !is_near(e.ay[k], e.by[k], box.y, box.half_y)) continue;
    const HorizonEdge edge = all.at(n);
    OwnBorder border{n, 0};
    for (std::size_t l = 0; l < receivers.count; ++l)
      if (has_bit(in_recess, l) && EdgeBeside(edge, eye_of(receivers, l)).may_be_own()) border.receivers |= 1U << l;
    if (border.receivers != 0) own_.push_back(border);
  }
}

}  // namespace farlod
