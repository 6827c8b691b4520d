// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "generator/generated_building.hpp"

namespace farlod {

/// A ring of points in the frame of a lot or of the plan.
using LotRing = std::vector<Point2d>;
using PlanRing = std::vector<Point3d>;

/// A facet in the plan frame; z is relative to `PlanSolid::ground_m`. Rings are oriented as in GeneratedFacet.
struct PlanFacet {
  FacetRole role = FacetRole::wall;
  PlanRing outer = {}, hole = {};
  std::vector<PlanRing> openings = {};  ///< clockwise, each filled by a window or a door
  Filling filling = Filling::none;
  std::size_t in_wall = 0;  ///< of a window or a door: the facet of the same solid whose opening it fills
};

/// A solid in the plan frame, in which walls are parallel to the axes and neighbors touch exactly. Its corners are not rounded to
/// millimetres yet.
struct PlanSolid {
  ComponentKind kind = ComponentKind::body;
  std::string suffix;  ///< of its id, after the id of the building; empty for the body
  double ground_m = 0.0;
  bool closed = true;
  std::vector<PlanFacet> facets;
  LotRing footprint, footprint_hole;  ///< plan frame
};

/// A building in the plan frame.
struct PlanBuilding {
  std::string id;
  BuildingKind kind = BuildingKind::detached;
  int storeys = 1;
  std::vector<PlanSolid> solids = {};
};

/// Turns a building into the city frame and rounds its corners to millimetres.
[[nodiscard]] GeneratedBuilding in_city(const PlanBuilding& building, const PlanRotation& rotation);

}  // namespace farlod
