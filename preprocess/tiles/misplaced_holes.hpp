// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "farlod/point.hpp"

namespace farlod::tiles {

/// A hole that removes no area from its facet.
struct MisplacedHole {
  std::size_t ring = 0;
  std::string_view reason;
};

/// The rings of a facet whose positions relative to each other are wrong.
struct RingPlaces {
  /// The hole that surrounds the first ring: the file exchanges the two.
  std::optional<std::size_t> true_outer;
  std::vector<MisplacedHole> misplaced;  ///< by ring
};

/// Finds holes that would add area under the even-odd rule, although a hole can only remove area:
///   (1) holes completely outside of the outer ring, and holes completely inside another hole
///   (2) copies of another hole, and copies of the outer ring, which would leave no area
/// Rings that cross each other are not reported. The tests are exact: a hole may touch another ring. The time is about that of
/// sorting the corners, unless very many rings run across each other: holes that could not be compared with all others before a
/// limit that only hostile facets reach are reported, too, with a reason that says so.
[[nodiscard]] RingPlaces places_of_rings(std::span<const std::span<const Point3d>> rings);

}  // namespace farlod::tiles
