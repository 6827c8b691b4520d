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

/// How a format closes a ring: it repeats the first point (GML, OGR), or leaves the last edge out (OBJ, CityJSON).
enum class RingEnd { repeats_first, implied };

enum class RingState { usable, too_few_points, unreadable_coordinate };

struct RingFindings {
  RingState state = RingState::usable;
  std::size_t repeated_vertices = 0;  ///< number of vertices removed
  bool was_open = false;              ///< the ring did not repeat its first point although the format requires it
  double gap = 0.0;                   ///< from the last vertex of an open ring to its first
};

/// No CRS of the Earth has larger coordinates, in metres or in feet.
inline constexpr double farthest_coordinate = 1e9;

/// Whether all coordinates are numbers, and none lies beyond the Earth.
[[nodiscard]] bool is_readable(const Point3d& p);

/// The first vertex with readable coordinates.
[[nodiscard]] std::optional<Point3d> first_readable(std::span<const Ring> rings);

/// Brings a ring into the form that CityModel promises: the first point is not repeated at the end, no vertex comes twice in a
/// row, and at least three points differ. Rings of all formats are checked here alone. An unusable ring may be left partly
/// changed.
[[nodiscard]] RingFindings clean_ring(Ring& ring, RingEnd end);

}  // namespace farlod::ingest
