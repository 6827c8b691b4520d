// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "base/grid.hpp"
#include "farlod/evaluation.hpp"
#include "farlod/point.hpp"
#include "scene/vertical_profile.hpp"

namespace farlod {

/// Rays begin at this distance, because a receiver that stands exactly on a surface would be blocked by it. Twice the rounding of
/// a coordinate 5 km from a scene's origin.
inline constexpr float least_distance_m = 0.001F;

/// A point that looks at the sky.
struct Receiver {
  std::size_t index = 0;             ///< of its answer
  Point3f p_cell;                    ///< in the frame of the cell that it belongs to
  Point3f normal{0.0F, 0.0F, 1.0F};  ///< length 1, grid frame
};

/// Calls `visit` for each group of consecutive receivers with the same normal: they share their directions.
template <class Visit>
void for_each_normal(std::span<const Receiver> receivers, const Visit& visit) {
  for (std::size_t first = 0; first < receivers.size();) {
    std::size_t end = first + 1;
    while (end < receivers.size() && receivers[end].normal == receivers[first].normal) ++end;
    visit(receivers.subspan(first, end - first));
    first = end;
  }
}

/// The receivers of one cell.
struct CellReceivers {
  Cell cell;
  std::vector<Receiver> receivers;
  std::size_t left_out = 0;                 ///< of a raster: pixels of the cell where no receiver can stand
  std::size_t outside_of_region = 0;        ///< pixels, points or receivers on surfaces that nobody asks for
  std::vector<bool> is_near_building = {};  ///< of each receiver: near_buildings_m; empty where nobody asks
  std::vector<float> areas_m2 = {};         ///< that receivers on surfaces stand for; empty where all count alike
};

/// The height of a receiver in the package's heights; none where the surface that its height counts from does not exist.
[[nodiscard]] std::optional<float> standing_height_m(const VerticalProfile& profile, HeightAbove above, float height_m);

/// The position of a receiver above a point of a cell; none when that is inside a building or below the ground, or when the
/// surface that its height counts from does not exist (beyond a terrain). `height_m` counts from `above`; for `sea_level`, from
/// the package's height origin. `profile` is that of the point.
[[nodiscard]] std::optional<Point3f> stand(const VerticalProfile& profile, float x_cell, float y_cell, HeightAbove above,
                                           float height_m);
[[nodiscard]] std::optional<Point3f> stand(const PointLocator& locator, float x_cell, float y_cell, HeightAbove above,
                                           float height_m);

}  // namespace farlod
