// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "farlod/point.hpp"
#include "farlod/surfaces.hpp"
#include "package/package_reader.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// A place that the user named, in the output CRS.
struct PlaceOfReceiver {
  Point2d p_projected;
  std::optional<double> height_m;             ///< absolute; when absent, HeightAbove decides
  Point3f normal_grid{0.0F, 0.0F, 1.0F};      ///< where it looks, of length 1
  std::optional<double> above_ground_m = {};  ///< where there is no height_m; it goes before HeightAbove
};

/// The places by cell, in the order of the cells; a place's index is its position in `places`. Cells may lie outside of the grid:
/// a receiver out there stands on the far terrain, or else on the height that the ground has where the grid ends.
[[nodiscard]] std::vector<std::pair<Cell, std::vector<std::size_t>>> places_by_cell(const PackageReader& package,
                                                                                    std::span<const PlaceOfReceiver> places);

/// The receivers at some of the places, all in one cell; those inside buildings are left out. Throws Cancelled when `stop` is
/// asked for. `above_ground_m` is empty, or as long as `places`: how high they stand above the ground, where there is one.
[[nodiscard]] CellReceivers receivers_at(const PackageReader& package, Cell cell, std::span<const PlaceOfReceiver> places,
                                         std::span<const std::size_t> chosen, HeightAbove above, float height_m,
                                         const std::stop_token& stop = {}, std::span<double> above_ground_m = {});

/// Distance of a receiver from its surface, so that the surface itself does not block it: a hundred times the rounding of a
/// coordinate in a scene of 10 km (0.5 mm would do), and a fiftieth of a window's reveal.
inline constexpr float surface_offset_m = 0.01F;

/// A receiver on a surface, and the area that it stands for.
struct SurfaceReceiver {
  std::uint32_t triangle = 0;  ///< of the cell's tile
  float area_m2 = 0.0F;
  Point3f p_cell;                   ///< off the surface by surface_offset_m, or ahead of its top by as much
  Point3f normal;                   ///< the surface's, grid frame
  bool is_inside_building = false;  ///< or below the ground: a party wall, a cellar
};

/// Spreads receivers over the pieces of surfaces in one tile: each triangle of area A has ⌈A/spacing²⌉ of them, at least one,
/// evenly placed (the R2 sequence, folded into the triangle), each standing for an equal share of its area. Areas therefore add
/// up to the surface's own, whatever the spacing. Throws Cancelled when `stop` is asked for.
[[nodiscard]] std::vector<SurfaceReceiver> surface_receivers(const PackageReader& package, Cell cell, SurfaceChoice choice,
                                                             double spacing_m, const std::stop_token& stop = {});

}  // namespace farlod
