// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/paging/paged_array.hpp"
#include "city/city_model.hpp"
#include "farlod/point.hpp"
#include "package/crown.hpp"

namespace farlod {

/// No tree on Earth is higher, or has a wider crown.
inline constexpr double highest_tree_m = 130.0, widest_crown_m = 80.0;

/// A tree of an inventory, or a square of a plant cover, with all of its sizes: what the file does not say is filled in.
struct Tree {
  Point2d place;  ///< in a frame that is named
  float height_m = 0.0F, crown_diameter_m = 0.0F;
  float trunk_height_m = 0.0F;  ///< at which the crown begins; below the height
  std::uint16_t source = 0;     ///< the number of its file
  Foliage foliage = Foliage::unknown;
  CrownShape shape = CrownShape::spheroid;  ///< or a prism, as wide as the diameter, along the axes of its frame

  bool operator==(const Tree&) const = default;
};

/// An inventory, read: places are still those of the file.
struct SourceTrees {
  std::string source;  ///< the file's name as the user gave it
  SourceCrs crs;
  PagedArray<Tree> trees;
  SkippedFeatures skipped = {};
};

/// Heights of crowns in square cells, in the city frame. Rows and columns may run any way, at right angles.
struct CanopyRaster {
  std::string source;                                  ///< the file's name as the user gave it
  Point2d first;                                       ///< the centre of cell (0, 0)
  Point2d column_step{1.0, 0.0}, row_step{0.0, -1.0};  ///< to the next column and to the next row; equally long
  std::size_t columns = 0, rows = 0;
  PagedArray<float> top_m;    ///< row by row; NaN: no data
  PagedArray<float> trunk_m;  ///< the same: where crowns begin; NaN: not known. Empty where there is no such raster

  [[nodiscard]] Point2d centre(std::size_t column, std::size_t row) const {
    return first + static_cast<double>(column) * column_step + static_cast<double>(row) * row_step;
  }
};

}  // namespace farlod
