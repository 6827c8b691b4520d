// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "city/city_model.hpp"
#include "farlod/point.hpp"
#include "farlod/problem.hpp"

namespace farlod::tiles {

/// Files round to millimetres: the two legs of a spike differ by at most this along each axis.
inline constexpr double spike_width_m = 0.001;

/// A vertex at which a ring turns back along its last edge.
struct Spike {
  std::size_t vertex = 0;  ///< in the ring, counted from 0
  Point3d tip;
  double length_m = 0.0;  ///< of the shorter leg
};

struct DespikedRing {
  std::vector<Point3d> ring;
  std::vector<Spike> spikes;  ///< what was taken out
};

/// Removes the spikes of a ring. The result encloses the same area up to slivers of width `spike_width_m`. Nothing when there is
/// no spike, and when no area would remain.
[[nodiscard]] std::optional<DespikedRing> without_spikes(std::span<const Point3d> ring);

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

/// What is wrong with a ring of a facet.
struct FacetFinding {
  ProblemCode code;
  std::size_t ring = 0;  ///< of the facet, as the city has it
  std::string detail;
  Point3d position;
};

/// The rings of a facet without spikes, which enclose nothing, and without misplaced holes, which remove nothing.
struct RepairedFacet {
  std::vector<std::span<const Point3d>> rings;  ///< the outer one first; into the city, or into `changed`
  std::list<std::vector<Point3d>> changed;
  std::vector<FacetFinding> findings;
};

/// Removes spikes from rings, removes misplaced holes, and exchanges the outer ring with a hole where the file confuses them.
/// Rings that cannot be repaired with certainty stay as they are: the triangulation reports them.
[[nodiscard]] RepairedFacet repaired_rings(const CityModel& city, const Facet& facet);

/// What a ring is called in the report: ", ring 1 (hole)".
[[nodiscard]] std::string name_of_ring(std::size_t ring);

}  // namespace farlod::tiles
