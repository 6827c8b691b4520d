// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "city/city_model.hpp"

namespace farlod::plausibility {

/// Where two tiles of a terrain meet, or lie upon each other.
struct TerrainSeam {
  double step_m = 0.0;         ///< how much higher the other tile is
  bool is_impossible = false;  ///< by more than 40 m, nearly all along
};

/// The step from a tile to another one, along the border of that: 3 m and more, and more than half of the places along the seam
/// differ by. Ground that slopes on through the seam makes none. Nothing where they do not meet.
[[nodiscard]] std::optional<TerrainSeam> seam_between(const TerrainRaster& tile, const TerrainRaster& other);

/// The tiles that hold nothing but 0, or -1, where all others are higher than 20 m: there is no data in them.
[[nodiscard]] std::vector<std::size_t> blank_tiles(std::span<const TerrainRaster> tiles);

}  // namespace farlod::plausibility
