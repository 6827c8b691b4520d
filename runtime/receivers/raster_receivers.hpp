// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "farlod/box.hpp"
#include "farlod/raster.hpp"
#include "package/manifest.hpp"
#include "package/package_reader.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// The raster over `wanted` (projected frame), or over the city (Manifest::city_projected). Pixels begin at multiples of the
/// step, so that rasters of neighboring runs fit together.
[[nodiscard]] RasterPlan plan_raster(const package::Manifest& manifest, double step_m,
                                     const std::optional<Box2d>& wanted_projected);

/// The pixels of a raster that meet a box, one at least.
[[nodiscard]] RasterPlan plan_within(const RasterPlan& whole, const Box2d& box_projected);

/// A rectangle of pixels, half open: rows run southwards.
struct PixelRange {
  std::size_t column_begin = 0, column_end = 0, row_begin = 0, row_end = 0;

  [[nodiscard]] bool empty() const { return column_begin >= column_end || row_begin >= row_end; }
};

/// Whether pixels of a raster that lie in no cell of the grid have answers: as points have them, where the ground is that at the
/// border of the grid.
enum class BeyondGrid : std::uint8_t { is_left_out, is_answered };

/// The pixels of a raster by the cells that hold their centres; pixel (column, row) has index row·columns + column.
class RasterReceivers {
 public:
  /// The receivers are the pixels whose centres lie in the region, or all when it is null. It must outlive this, as must the
  /// manifest.
  RasterReceivers(const package::Manifest& manifest, RasterPlan plan, const Region* region = nullptr,
                  BeyondGrid beyond_grid = BeyondGrid::is_left_out)
      : manifest_(manifest), plan_(plan), region_(region), beyond_grid_(beyond_grid) {}

  /// The cells that may hold a pixel's centre: the existing ones in the order of CellRange::index_of, then those beyond the grid.
  [[nodiscard]] std::vector<Cell> cells() const;
  /// All pixels whose centres a cell holds lie in this range, and others do.
  [[nodiscard]] PixelRange range_of(Cell cell) const;
  /// The receivers of one cell; pixels inside buildings are left out, and counted. Neighbors in the plane are neighbors in the
  /// list. Throws Cancelled when `stop` is asked for.
  [[nodiscard]] CellReceivers in_cell(const PackageReader& package, Cell cell, HeightAbove above, float height_m,
                                      const std::stop_token& stop = {}) const;
  /// Calls `visit` with the index and the vertical profile of each pixel whose centre an existing cell holds; the profile is
  /// valid during the call only. Throws Cancelled when `stop` is asked for.
  void for_each_profile(const PackageReader& package, Cell cell, const std::stop_token& stop,
                        const std::function<void(std::size_t pixel, const VerticalProfile& profile)>& visit) const;

 private:
  /// The centres of some pixels, in the frame of a cell that may hold them or not.
  struct Centres {
    PlanLattice places;
    std::vector<bool> are_in_cell;
  };
  /// Calls `on_strip` with the places of each strip of a cell's pixels, then `visit` with those places and the number there,
  /// column and row of each pixel that the cell holds and the region wants. Returns how many the region does not want.
  template <class OnStrip, class Visit>
  std::size_t for_each_wanted(Cell cell, const std::stop_token& stop, const OnStrip& on_strip, const Visit& visit) const;
  void add_cells_beyond_grid(std::vector<Cell>& cells) const;
  [[nodiscard]] CellReceivers beyond_grid(const PackageReader& package, Cell cell, HeightAbove above, float height_m,
                                          const std::stop_token& stop) const;
  [[nodiscard]] Centres centres_of(const PixelRange& pixels, Cell cell) const;
  /// How far rounding moves a centre from its place in the plan.
  [[nodiscard]] double rounding_m(const PixelRange& pixels, Cell cell) const;

  const package::Manifest& manifest_;
  RasterPlan plan_;
  const Region* region_;
  BeyondGrid beyond_grid_;
};

}  // namespace farlod
