// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/expects.hpp"
#include "base/grid.hpp"
#include "farlod/point.hpp"

namespace farlod::tiles {

/// The corners of a convex polygon, of which there are few.
template <class Corner, std::size_t most>
class SmallPolygon {
 public:
  using value_type = Corner;

  void push_back(const Corner& corner) {
    FARLOD_EXPECTS(size_ < corners_.size());
    corners_[size_++] = corner;
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] Corner& operator[](std::size_t n) { return corners_[n]; }
  [[nodiscard]] const Corner& operator[](std::size_t n) const { return corners_[n]; }
  [[nodiscard]] const Corner* begin() const { return corners_.data(); }
  [[nodiscard]] const Corner* end() const { return corners_.data() + size_; }

 private:
  std::array<Corner, most> corners_;
  std::uint32_t size_ = 0;
};

/// The part of a triangle within a square has at most seven corners.
using CellPolygon = SmallPolygon<Point3f, 7>;

/// A convex polygon in one cell, rounded to the cell frame.
struct CellPiece {
  Cell cell;
  CellPolygon polygon;
};

[[nodiscard]] double area_of(const CellPolygon& convex);

/// A point of the grid frame in the frame of `cell`: the one way in which a vertex is rounded.
[[nodiscard]] Point3f cell_from_grid(const Point3d& p_grid, Cell cell, const Grid& grid, double height_origin_m);

/// Cuts a triangle of the grid frame along the borders of the grid, exactly, then rounds each corner once.
/// Corners on a border are rounded alike in both cells, so that the pieces still touch. A triangle inside one cell
/// costs no arithmetic beyond the rounding.
[[nodiscard]] std::vector<CellPiece> cut(const std::array<Point3d, 3>& triangle_grid, const Grid& grid, double height_origin_m);
/// As `cut`; but where there is an `only_cell`, the triangle goes whole to it, and wherever it lies.
[[nodiscard]] std::vector<CellPiece> cut_unless_whole(const std::array<Point3d, 3>& triangle_grid,
                                                      const std::optional<Cell>& only_cell, const Grid& grid,
                                                      double height_origin_m);
/// The same, appended to `pieces`.
void cut_unless_whole(const std::array<Point3d, 3>& triangle_grid, const std::optional<Cell>& only_cell, const Grid& grid,
                      double height_origin_m, std::vector<CellPiece>& pieces);
/// The same for a triangle that may reach beyond the grid, as terrains do: only the pieces in cells of the grid.
[[nodiscard]] std::vector<CellPiece> cut_within(const std::array<Point3d, 3>& triangle_grid, const Grid& grid,
                                                double height_origin_m);

}  // namespace farlod::tiles
