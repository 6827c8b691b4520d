// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace farlod::plausibility {

/// What the heights of a raster are heights of.
enum class HeightsOf {
  ground,   ///< a terrain below buildings
  surfaces  ///< ground and roofs alike
};

/// A number that a raster has where it knows no height, though it does not declare it as such.
struct StandIn {
  float height_m = 0.0F;
  std::size_t pixels = 0;
  std::size_t first = 0;  ///< index of the first of them
};

/// Empties the pixels that hold a stand-in, and returns all stand-ins, the most frequent first.
///   (1) heights below lowest_elevation_m or above highest_elevation_m, which no place on land has (-9999, -32768, -3.4e38)
///   (2) heights of exactly 0 or -1 where all others are higher than 20 m: ground slopes down to a sea elsewhere. Surfaces may
///       be towers that count from their own ground, at 0: where any other is lower than 100 m, they must be 17 different
///       numbers at least, and more than twice as many pixels, since streets and yards take more room beside towers
///   (3) the lowest number of all, for a ground also the highest one, which no other is near: it stands in one of 1,000 pixels
///       and in 16 at least, and is apart from the others by 50 m (surfaces: 100 m), and by as much as they differ themselves;
///       these are 16 numbers at least. Ground has slopes, and the roof of a tower is not below the town
[[nodiscard]] std::vector<StandIn> take_out_stand_ins(std::vector<std::optional<float>>& heights_m, HeightsOf of);

/// Why stand-ins are heights in another unit, in words that go on behind the name of the file, with what to do: they are more
/// than half of the pixels that have a number, of which `left` were kept, and a hundred different numbers, none of them half of
/// all. No raster has as many numbers for no data. None where they may stand for it.
[[nodiscard]] std::optional<std::string> sign_of_another_unit(std::span<const StandIn> stand_ins, std::size_t left);

}  // namespace farlod::plausibility
