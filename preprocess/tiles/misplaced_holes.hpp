// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "farlod/point.hpp"

namespace farlod {

/// A hole that takes nothing away from its facet.
struct MisplacedHole {
  std::size_t ring = 0;
  std::string_view reason;
};

/// How the rings of a facet lie to each other, where that is not as it should be.
struct RingPlaces {
  /// The hole that surrounds the first ring: the two were exchanged when the facet was written.
  std::optional<std::size_t> true_outer;
  std::vector<MisplacedHole> misplaced;  ///< by ring
};

/// Finds holes that would add area if even and odd were asked, where a hole only ever takes away:
///   (1) holes wholly outside of the outer ring, and holes wholly within another hole
///   (2) holes that are another hole once more, and those that are the outer ring once more, which would leave nothing
/// Rings that cross each other are none of these. Exact: a hole may touch what it lies beside.
[[nodiscard]] RingPlaces places_of_rings(std::span<const std::span<const Point3d>> rings);

}  // namespace farlod
