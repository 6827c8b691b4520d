// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "generator/building_plan.hpp"
#include "generator/plan_frame.hpp"

namespace farlod {

/// What a facet is to its building, in the words of CityGML.
enum class FacetRole : std::uint8_t { roof, wall, ground, outer_ceiling };

/// A planar polygon by vertex numbers, counter-clockwise seen from outside; rings are not closed. A facet with a hole has as
/// many corners in the hole as in the outer ring, and hole corner (n − k) mod n lies opposite to outer corner k.
struct GeneratedFacet {
  FacetRole role = FacetRole::wall;
  std::vector<std::uint32_t> outer;
  std::vector<std::uint32_t> hole;  ///< clockwise; empty if there is none
};

/// A point of a footprint, in whole millimetres.
using PlanPointMm = std::array<std::int64_t, 2>;

/// A building as a closed solid.
///   (1) each edge of its facets is used twice, once in each direction
///   (2) its facets look outwards
///   (3) the corners of a facet lie within `planarity_mm` of a plane, which rounding to millimetres alone spends
struct GeneratedBuilding {
  std::string id;  ///< unique in the city; fit to be an XML id
  BuildingKind kind = BuildingKind::detached;
  int storeys = 1;
  std::vector<PointMm> vertices;  ///< each place once, city frame
  std::vector<GeneratedFacet> facets;
  /// What the building covers, seen from above: counter-clockwise, and clockwise around a court.
  std::vector<PlanPointMm> footprint;
  std::vector<PlanPointMm> footprint_hole;
  std::int64_t base_mm = 0, top_mm = 0;  ///< lowest and highest elevation of the solid

  [[nodiscard]] double height_m() const { return static_cast<double>(top_mm - base_mm) * 1e-3; }
};

/// Rounding moves each coordinate by at most half a millimetre, hence a corner by at most √3/2 mm, to either side of the
/// plane on which it was laid out.
inline constexpr double planarity_mm = 0.8660254037844387;

}  // namespace farlod
