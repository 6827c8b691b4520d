// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "generator/generated_building.hpp"

namespace farlod {

/// A ring of plan points: in a lot's frame, or in the plan.
using LotRing = std::vector<Point2d>;
using PlanRing = std::vector<Point3d>;

/// A facet in the plan frame; z counts from `PlanSolid::ground_m`. Rings run as in GeneratedFacet.
struct PlanFacet {
  FacetRole role = FacetRole::wall;
  PlanRing outer = {}, hole = {};
  std::vector<PlanRing> openings = {};  ///< clockwise, each filled by a window or a door
  Filling filling = Filling::none;
  std::size_t in_wall = 0;  ///< of a window or a door: the facet of the same solid whose opening it fills
};

/// A solid before its corners are rounded to millimetres: still in the frame in which walls are axis-parallel and neighbors
/// touch exactly.
struct PlanSolid {
  ComponentKind kind = ComponentKind::body;
  std::string suffix;  ///< what its id adds to the id of the building; empty for the body
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
