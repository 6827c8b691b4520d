// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "farlod/point.hpp"
#include "package/package_reader.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// A place that the user named, in the output CRS.
struct PlaceOfReceiver {
  Point2d p_projected;
  std::optional<double> height_m;         ///< absolute; when absent, HeightAbove decides
  Point3f normal_grid{0.0F, 0.0F, 1.0F};  ///< where it looks, of length 1
};

/// The places by cell, in the order of the cells; a place's index is its position in `places`. Cells may lie outside of the grid:
/// a receiver out there stands on the height that the ground has where the grid ends.
[[nodiscard]] std::vector<std::pair<Cell, std::vector<std::size_t>>> places_by_cell(const PackageReader& package,
                                                                                    std::span<const PlaceOfReceiver> places);

/// The receivers at some of the places, all in one cell; those inside buildings are left out. Throws Cancelled when `stop` is
/// asked for.
[[nodiscard]] CellReceivers receivers_at(const PackageReader& package, Cell cell, std::span<const PlaceOfReceiver> places,
                                         std::span<const std::size_t> chosen, HeightAbove above, float height_m,
                                         const std::stop_token& stop = {});

}  // namespace farlod
