// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <compare>
#include <cstdint>
#include <vector>

#include "base/expects.hpp"
#include "base/frame.hpp"
#include "farlod/box.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// A square of the grid, by column (east) and row (north) in the grid frame.
struct Cell {
  std::int32_t i = 0, j = 0;
  auto operator<=>(const Cell&) const = default;
};

/// B×B cells: the unit of storing, checking and distributing.
struct Block {
  std::int32_t i = 0, j = 0;
  auto operator<=>(const Block&) const = default;
};

/// A rectangle of cells, half open: i_begin ≤ i < i_end.
struct CellRange {
  std::int32_t i_begin = 0, j_begin = 0, i_end = 0, j_end = 0;
  bool operator==(const CellRange&) const = default;

  [[nodiscard]] constexpr bool contains(Cell c) const { return i_begin <= c.i && c.i < i_end && j_begin <= c.j && c.j < j_end; }
  [[nodiscard]] constexpr std::int64_t width() const { return i_end > i_begin ? i_end - i_begin : 0; }
  [[nodiscard]] constexpr std::int64_t height() const { return j_end > j_begin ? j_end - j_begin : 0; }
  [[nodiscard]] constexpr std::int64_t size() const { return width() * height(); }
  /// Place of a cell in row-major order (row by row from the south, each from the west).
  [[nodiscard]] constexpr std::size_t index_of(Cell c) const {
    return static_cast<std::size_t>((c.j - j_begin) * width() + (c.i - i_begin));
  }
  [[nodiscard]] constexpr Cell cell_at(std::size_t index) const {
    const auto n = static_cast<std::int64_t>(index);
    // An index is below size(), which is 0 where the width is. NOLINTNEXTLINE(clang-analyzer-core.DivideZero)
    return {i_begin + static_cast<std::int32_t>(n % width()), j_begin + static_cast<std::int32_t>(n / width())};
  }
  [[nodiscard]] constexpr CellRange intersection(const CellRange& o) const {
    return {i_begin > o.i_begin ? i_begin : o.i_begin, j_begin > o.j_begin ? j_begin : o.j_begin,
            i_end < o.i_end ? i_end : o.i_end, j_end < o.j_end ? j_end : o.j_end};
  }
};

/// The nearest cell edge whose multiples are exact in double: a float (24 bits) times a 29-bit index.
/// With it both sides of every border mean the same number.
[[nodiscard]] inline double exact_cell_edge_m(double wish_m) { return static_cast<double>(static_cast<float>(wish_m)); }

/// The regular grid that is laid over the city, aligned with its streets.
///   (1) `cell_edge_m` is a float, so that the border lines k·cell_edge_m are exact
///   (2) a point on a border belongs to the cell to its east or north
///   (3) every cell of `cells` lies in exactly one block
struct Grid {
  GridRotation rotation;
  double cell_edge_m = 50.0;
  int neighborhood = 3;  ///< cells along the edge of the near field (N, odd)
  int block_edge = 32;   ///< cells along the edge of a block (B)
  CellRange cells;       ///< the cells that exist; all have a tile (perhaps empty) and a far map

  [[nodiscard]] double border_m(std::int32_t k) const { return k * cell_edge_m; }

  [[nodiscard]] std::int32_t interval_of(double x_grid) const {
    auto k = static_cast<std::int32_t>(std::floor(x_grid / cell_edge_m));
    // The division rounds: choose the side that the exact borders say
    while (border_m(k) > x_grid) --k;
    while (border_m(k + 1) <= x_grid) ++k;
    return k;
  }
  [[nodiscard]] Cell cell_of(Point2d p_grid) const { return {interval_of(p_grid.x), interval_of(p_grid.y)}; }
  [[nodiscard]] Point2d corner_of(Cell c) const { return {border_m(c.i), border_m(c.j)}; }
  [[nodiscard]] Point2d centre_of(Cell c) const { return {(c.i + 0.5) * cell_edge_m, (c.j + 0.5) * cell_edge_m}; }
  /// Corner of the middle cell: where a scene of the whole city has its origin, so that floats are finest in the city.
  [[nodiscard]] Point2d middle_corner() const {
    return corner_of({cells.i_begin + static_cast<std::int32_t>(cells.width() / 2),
                      cells.j_begin + static_cast<std::int32_t>(cells.height() / 2)});
  }
  [[nodiscard]] Box2d square_of(Cell c) const { return {corner_of(c), corner_of({c.i + 1, c.j + 1})}; }

  /// What all cells cover together, in the grid frame.
  [[nodiscard]] Box2d rectangle() const {
    return {corner_of({cells.i_begin, cells.j_begin}), corner_of({cells.i_end, cells.j_end})};
  }

  /// The N×N cells around `c`; some of them may lie outside of `cells`.
  [[nodiscard]] CellRange neighborhood_of(Cell c) const {
    const std::int32_t r = neighborhood / 2;
    return {c.i - r, c.j - r, c.i + r + 1, c.j + r + 1};
  }
  /// Half the edge of the neighborhood's square: how far from a cell's centre the far field begins.
  [[nodiscard]] double neighborhood_half_edge_m() const { return 0.5 * neighborhood * cell_edge_m; }

  [[nodiscard]] Block block_of(Cell c) const { return {floor_divide(c.i, block_edge), floor_divide(c.j, block_edge)}; }
  /// The cells of a block that exist.
  [[nodiscard]] CellRange cells_of(Block b) const {
    return CellRange{b.i * block_edge, b.j * block_edge, (b.i + 1) * block_edge, (b.j + 1) * block_edge}.intersection(cells);
  }
  /// The blocks that hold a cell, row by row from the south-west.
  [[nodiscard]] std::vector<Block> blocks() const {
    std::vector<Block> result;
    if (cells.size() == 0) return result;
    const Block first = block_of({cells.i_begin, cells.j_begin});
    const Block last = block_of({cells.i_end - 1, cells.j_end - 1});
    for (std::int32_t j = first.j; j <= last.j; ++j)
      for (std::int32_t i = first.i; i <= last.i; ++i) result.push_back({i, j});
    return result;
  }

 private:
  [[nodiscard]] static constexpr std::int32_t floor_divide(std::int32_t a, std::int32_t b) {
    return a >= 0 ? a / b : -((-a + b - 1) / b);
  }
};

}  // namespace farlod
