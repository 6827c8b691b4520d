// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "farlod/point.hpp"

namespace farlod::ingest {

using Ring = std::vector<Point3d>;
/// A polygon: the outer ring first, then its holes.
using Rings = std::vector<Ring>;

/// How a format ends a ring: by writing the first point once more (GML, OGR), or not at all (OBJ, CityJSON).
enum class RingEnd { repeats_first, implied };

enum class RingState { usable, too_few_points, unreadable_coordinate };

struct RingFindings {
  RingState state = RingState::usable;
  std::size_t repeated_vertices = 0;  ///< taken out
  bool was_open = false;              ///< the format repeats the first point, and this ring did not
  double gap = 0.0;                   ///< from the last vertex to the first, where it was open
};

/// No reference system of the Earth reaches this far, in metres or in feet: a larger number is a slip.
inline constexpr double farthest_coordinate = 1e9;

/// Whether all coordinates are numbers, and none lies beyond the Earth.
[[nodiscard]] bool is_readable(const Point3d& p);

/// The first vertex that is readable.
[[nodiscard]] std::optional<Point3d> first_readable(std::span<const Ring> rings);

/// Brings a ring into the form that CityModel promises: not closed, no vertex twice in a row, at least three different
/// points. Rings of all formats are checked here, and nowhere else. A ring that is not usable is left partly changed.
[[nodiscard]] RingFindings clean_ring(Ring& ring, RingEnd end);

}  // namespace farlod::ingest
