// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "farlod/package.hpp"
#include "view/view_frame.hpp"

namespace farlod {

/// Crowns above one square of the plan, as an upright prism.
struct CanopyColumn {
  std::uint16_t column = 0, row = 0;               ///< of the square, from the north-west
  double bottom_local_m = 0.0, top_local_m = 0.0;  ///< of the lowest crown and of the highest one at its middle
};

/// The canopy of a package as it is drawn.
struct CanopyColumns {
  Point2d north_west_local;  ///< outer corner of the first square
  double step_m = 0.0;       ///< edge of a square, along the axes of the local frame
  std::vector<CanopyColumn> columns;

  /// As the page reads it: five 32-bit floats, east and north of the corner, the step, the lowest bottom and the metres of a
  /// unit of height; then four 16-bit numbers a column: column, row, and bottom and top in units above the lowest bottom. All
  /// are little-endian.
  [[nodiscard]] std::string bytes() const;
};

/// More would make an exported page larger by megabytes, and slow where there is no graphics processor.
inline constexpr std::size_t most_canopy_columns = 150'000;
/// Crowns of single trees have their shape in squares of this edge; coarser ones only save time.
inline constexpr double finest_canopy_step_m = 0.5;

/// The columns of all crowns:
///   (1) there are at most `most` of them, in the finest step of ½, 1, 2, 4 … m that allows it; where
///       a coarser one has the same, as of a raster of pixels of 2 m, in that one
///   (2) a column is as high as the crowns at the middle of its square, so that area and volume are those of the crowns, but for
///       the squares that their borders cross
/// Empty of a package without crowns. Throws PackageUnusable, PackageDamaged.
[[nodiscard]] CanopyColumns canopy_columns_of(const Package& package, const ViewFrame& frame,
                                              std::size_t most = most_canopy_columns);

}  // namespace farlod
