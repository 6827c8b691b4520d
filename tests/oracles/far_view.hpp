// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "farlod/point.hpp"
#include "package/far_map.hpp"
#include "package/horizon_edge.hpp"
#include "package/layout.hpp"
#include "tests/oracles/distance_to_segment.hpp"

namespace farlod {

/// Whether a far map stores an occluder as explicit for a patch (docs/package_format.md, "ExplicitOccluder").
[[nodiscard]] inline bool is_explicit_in(const package::ExplicitOccluder& occluder, const ReceiverPatches& patches,
                                         std::uint32_t patch) {
  const std::uint32_t square = patch % patches.squares(), layer = patch / patches.squares();
  return ((occluder.squares >> square) & 1U) != 0 && ((occluder.layers >> layer) & 1U) != 0;
}

/// What the far city does to a direction, as far as its map knows.
enum class FarVerdict : std::uint8_t {
  free,               ///< hides nothing there, for certain
  estimated_free,     ///< may hide the sky there, and likely does not
  estimated_blocked,  ///< may leave the sky open there, and likely does not
  blocked             ///< hides the sky there, for certain
};

/// What a receiver of a cell sees of a far map of the kind `horizon`, direction by direction and edge by edge, as if all of the
/// far city were grounded.
class FarView {
 public:
  /// The map must outlive it. The receiver is given in the cell frame.
  FarView(const FarHorizon& map, const Point3f& p_cell);

  /// Of a direction above the horizontal.
  [[nodiscard]] FarVerdict verdict(const Point3d& direction) const;

 private:
  /// How far a corner may lie from where the exact engine sees it: both round to floats, in frames whose origins are a city apart
  /// (0.25 mm at 4 km each). What is certain gives way by this.
  static constexpr double rounding_m = 0.0005;
  /// Directions round to floats too.
  static constexpr double rounding = 1e-6;
  /// Nearer than this, rounding decides where an edge stands: it may hide anything.
  static constexpr double too_close_m = 0.01;

  /// An edge that runs counter-clockwise around the eye.
  struct Seen {
    Point2d a, b;           ///< towards its ends, of length 1
    double turn_a, turn_b;  ///< how far its ends may lie from there, in radians
    SlopePlane plane;       ///< level where it is looked along: then it shows no more than its ends
    double give;            ///< how far a slope may lie from the plane's
    bool hides;             ///< for certain, between its ends

    /// Whether a direction lies between its ends, each of which is moved inwards by so many times what it may move.
    [[nodiscard]] bool covers(Point2d u, double times) const {
      return std::max(dot(a, u), dot(b, u)) > 0.0 && across(a, u) >= times * turn_a && across(u, b) >= times * turn_b;
    }
  };
  [[nodiscard]] static double across(Point2d a, Point2d b) { return a.x * b.y - a.y * b.x; }
  void add(EdgeView edge);

  const FarHorizon& map_;
  const Point3f p_cell_;
  const std::optional<std::uint32_t> patch_;
  std::vector<Seen> edges_;  ///< the explicit edges that matter
  bool is_too_close_ = false;
};

inline FarView::FarView(const FarHorizon& map, const Point3f& p_cell)
    : map_(map), p_cell_(p_cell), patch_(map.patches.patch_of(p_cell)) {
  const ExplicitOccluders& occluders = map.occluders;
  const Point3d shift =
      Point3d{occluders.cell_from_block_m.x, occluders.cell_from_block_m.y, 0.0} - Point3d{p_cell.x, p_cell.y, p_cell.z};
  const auto seen = [&shift](const Point3f& p) { return shift + Point3d{p.x, p.y, p.z}; };
  for (const package::ExplicitOccluder& occluder : occluders.explicit_edges) {
    const HorizonEdge& edge = occluders.edges[occluder.row];
    if (edge.role == EdgeRole::underside) continue;
    // Below the lowest level no patch says what may be left out
    if (!patch_ || is_explicit_in(occluder, map.patches, *patch_)) add({seen(edge.a), seen(edge.b)});
  }
}

inline void FarView::add(EdgeView edge) {
  if (edge.a.z <= -rounding_m && edge.b.z <= -rounding_m) return;
  if (edge.turn() < 0.0) std::swap(edge.a, edge.b);
  const Point2d a = horizontal(edge.a), b = horizontal(edge.b);
  const double nearest_m = distance_to_segment(a, b);
  if (nearest_m < too_close_m) {
    is_too_close_ = true;
    return;
  }
  const double steepest = std::max({edge.a.z, edge.b.z, 0.0}) / nearest_m;
  const bool hides = edge.turn() > rounding_m * norm(b - a);
  const SlopePlane plane = hides ? edge.plane() : SlopePlane{};
  // What moves by the rounding rises so much at the distance, and shows another place of its plane, as much steeper as that is
  const double give = (rounding_m / nearest_m + rounding) * (1.0 + steepest + std::hypot(plane.along_x, plane.along_y));
  edges_.push_back({1.0 / norm(a) * a, 1.0 / norm(b) * b, rounding_m / norm(a) + rounding, rounding_m / norm(b) + rounding, plane,
                    give + (hides ? 0.0 : steepest), hides});
}

inline FarVerdict FarView::verdict(const Point3d& direction) const {
  const double length = std::hypot(direction.x, direction.y), slope = direction.z / length;
  const Point2d u = length > 0.0 ? Point2d{direction.x / length, direction.y / length} : Point2d{1.0, 0.0};
  double surely = 0.0, perhaps = is_too_close_ ? std::numeric_limits<double>::infinity() : 0.0;
  for (const Seen& edge : edges_) {
    if (!edge.covers(u, -1.0)) continue;
    perhaps = std::max(perhaps, edge.plane.slope(u) + edge.give);
    if (edge.hides && edge.covers(u, 1.0)) surely = std::max(surely, edge.plane.slope(u) - edge.give);
  }
  const std::size_t bins = map_.bins.count, bin = map_.bins.bin_of(u), row = patch_.value_or(0) * bins;
  const auto [next_row, share] = map_.floor_above(patch_.value_or(0), p_cell_.z);
  const float here = map_.estimate[row + bin], above = map_.estimate[next_row * bins + bin];
  // Below the lowest level nothing is certain of the residual city
  const float low = patch_ ? map_.low[row + bin] : 0.0F;
  const float high = patch_ ? map_.high[row + bin] : std::numeric_limits<float>::infinity();
  const double estimate = std::clamp(here + share * (above - here), low, high);
  return slope < std::max<double>(surely, low)     ? FarVerdict::blocked
         : slope > std::max<double>(perhaps, high) ? FarVerdict::free
         : slope > std::max(perhaps, estimate)     ? FarVerdict::estimated_free
                                                   : FarVerdict::estimated_blocked;
}

}  // namespace farlod
