// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "base/grid.hpp"
#include "base/paging/paged_array.hpp"
#include "package/crown.hpp"
#include "package/manifest.hpp"

namespace farlod {

/// Whether a place is in a cell of the grid.
[[nodiscard]] inline bool holds(const Grid& grid, Point2d p_grid) {
  const auto& [low, high] = grid.rectangle();
  return low.x <= p_grid.x && p_grid.x < high.x && low.y <= p_grid.y && p_grid.y < high.y;
}

/// The crowns of a city. Each belongs to the cell of the grid in which its axis lies, and is kept in the frame of that cell, as
/// it will be stored. A city has millions of crowns: they take 32 bytes each, on disk where there are many.
class CrownsOfCity {
 public:
  struct OwnedCrown {
    std::uint64_t cell;  ///< its place in CellRange::index_of
    Crown crown;         ///< cell frame
  };

  /// Heights on disk count from `height_origin_m` (TileSet::height_origin_m).
  CrownsOfCity(const Grid& grid, double height_origin_m) : grid_(grid), height_origin_m_(height_origin_m) {}

  /// A crown, which must have finite numbers, a bottom below its top, and a half width above 0. Heights are those of the city.
  /// The turn is that of a prism, counter-clockwise in the grid frame; of other shapes it means nothing. A crown outside of the
  /// grid is counted, and not kept.
  void add(Point2d axis_grid, double bottom_m, double top_m, double half_width_m, CrownShape shape, Foliage foliage,
           double turn_rad_grid = 0.0);

  [[nodiscard]] std::uint64_t size() const { return crowns_.size(); }
  [[nodiscard]] bool empty() const { return crowns_.empty(); }
  /// How many crowns were not kept.
  [[nodiscard]] std::uint64_t outside() const { return outside_; }
  [[nodiscard]] const Grid& grid() const { return grid_; }

  /// Cell by cell, and within a cell in an order that depends on nothing but the crowns, whatever the order in which they came.
  [[nodiscard]] const PagedArray<OwnedCrown>& in_order();

 private:
  Grid grid_;
  double height_origin_m_;
  PagedArray<OwnedCrown> crowns_;
  std::uint64_t outside_ = 0;
  bool is_in_order_ = true;
};

/// Writes `crowns.bin` into the folder of a package, and returns what the manifest says of it (Manifest::canopy). Where there is
/// no crown, it returns nothing, and there is no file. Throws OutputError.
[[nodiscard]] std::optional<package::CanopyFile> write_canopy(const std::filesystem::path& folder, CrownsOfCity& crowns);

}  // namespace farlod
