// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "base/grid.hpp"
#include "base/ground_contact.hpp"
#include "base/paging/paged_array.hpp"
#include "farlod/box.hpp"
#include "farlod/point.hpp"
#include "tiles/horizon_edges.hpp"
#include "tiles/stepped_surface.hpp"

namespace farlod::tiles {

/// The area that the ground covers.
enum class GroundExtent {
  rectangle,  ///< the whole rectangle: a corner beyond the points gets the height of the nearest point
  points      ///< the convex hull of the points: nothing is known beyond it
};

/// The height of the ground at a place.
using GroundHeightAt = std::function<double(Point2d p_grid)>;

/// The largest distance between two places of a border at which its height is compared with the ground.
inline constexpr double ground_sampling_step_m = 1.0;
/// The number of intervals into which a border of this horizontal length is divided by such places.
[[nodiscard]] inline int ground_sampling_intervals(double run_m) {
  return static_cast<int>(std::ceil(std::max(1.0, run_m / ground_sampling_step_m)));
}

/// A triangle of the ground, and those beside it.
struct GroundFace {
  std::array<Point3d, 3> corners;                  ///< counter-clockwise seen from above
  std::array<std::optional<Point3d>, 3> beyond{};  ///< beyond the side opposite of each corner, the third corner of its neighbor

  /// Sides that can be a horizon: the convex ones and the border. Of two triangles, one has the side that they share.
  [[nodiscard]] std::vector<HorizonSegment> horizon_edges() const;
};

/// The ground: a triangulated irregular network (Delaunay in the plane) through points of known height, or the surface of a
/// surface model. A large one lies on disk (PagedHeap, PagedArray). Of a network:
///   (1) Of several points at one place in the plane, the lowest counts.
///   (2) It covers the rectangle, or the convex hull of its points, according to its extent.
///   (3) It does not depend on the order of the points.
class Ground {
 public:
  /// Points outside of the rectangle shape the ground at its edge. Without points the ground is flat at height 0.
  Ground(PagedArray<Point3d> points_grid, const Box2d& rectangle, GroundExtent extent = GroundExtent::rectangle);
  /// Lasts no longer than the raster. The rotation is that of the grid.
  Ground(const TerrainRaster& surface_model, PixelSteps steps, const GridRotation& rotation);
  Ground(Ground&&) noexcept;
  Ground& operator=(Ground&&) noexcept;
  ~Ground();

  /// Height of the ground; beyond it, the height of the nearest point. Of a surface model, that of the pixel there, or of one on
  /// its row. Not thread-safe.
  [[nodiscard]] double height_at(Point2d p_grid) const;
  /// Whether a point is higher above the ground than that. As height_at says, but for a point whose height decides by a
  /// millimetre; much faster for points beside each other. Not thread-safe.
  [[nodiscard]] bool is_above(const Point3d& p_grid, double height_m) const;
  /// The lowest of all corners of its triangles; nothing when it has none.
  [[nodiscard]] std::optional<double> lowest_m() const;
  /// What a surface model is made of, made when it is first asked for; null for a network, whose faces have all of its edges
  /// (GroundFace::horizon_edges).
  [[nodiscard]] const SteppedSurface* surface() const;
  /// PixelSteps::leave_out_squares of a surface model, before its surface is asked for, and what becomes of them.
  std::uint64_t leave_out_squares(const Grid& grid, SquaresOfReaders squares,
                                  const std::function<bool(std::uint64_t)>& are_enough);
  /// Those of a surface model.
  [[nodiscard]] const PixelSteps& pixel_steps() const;

 private:
  friend class GroundFaces;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Hands out all triangles of a ground, in a fixed order and a few at a time: a city has more of them than there is memory.
class GroundFaces {
 public:
  /// The ground must outlive this, and must not move.
  explicit GroundFaces(const Ground& ground);
  GroundFaces(GroundFaces&&) noexcept;
  ~GroundFaces();

  /// The next ones, at most so many; none at the end.
  [[nodiscard]] std::vector<GroundFace> next(std::size_t most);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace farlod::tiles
