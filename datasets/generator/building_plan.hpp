// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "farlod/box.hpp"
#include "generator/city_layout.hpp"
#include "generator/plan_frame.hpp"
#include "generator/urban_field.hpp"

namespace farlod {

/// The kind of a building. It is for tests, summaries and attributes, and changes no geometry.
enum class BuildingKind { detached, attached, outbuilding, slab, hall, courtyard, office, tower, pavilion, bridge };

enum class FootprintShape {
  rectangle,  ///< width × depth
  l_shape,    ///< two legs `wing_m` wide along the sides u = 0 and v = 0 of the rectangle
  courtyard   ///< four wings `wing_m` wide around a court
};

/// The roof of LoD2; LoD1 has flat ones only.
enum class RoofShape {
  flat,
  gabled,  ///< ridge along the rectangle's longer side, or along the street if attached; both legs of an L
  hipped,
  stepped  ///< flat, with a narrower top storey block
};

/// A building as drawn in the plan, before it is a solid. Lengths are multiples of a centimetre.
struct BuildingPlan {
  LotFrame lot;
  double width_m = 0.0, depth_m = 0.0;  ///< along the street, and away from it
  FootprintShape shape = FootprintShape::rectangle;
  double wing_m = 0.0;
  double wall_m = 0.0;  ///< from the base to the eaves, or to the top of a flat roof
  RoofShape roof = RoofShape::flat;
  double roof_rise_m =
      0.0;  ///< gabled and hipped: from the eaves to the ridge; stepped: height of the narrower part, inside `wall_m`
  double arcade_depth_m = 0.0;  ///< the ground floor stands back from the street by this much (0: no arcade)
  double arcade_height_m = 0.0;
  double projection_m = 0.0;  ///< the ground floor, `arcade_height_m` high, stands back on all sides by this much
  double clearance_m = 0.0;   ///< of a bridge: its underside above the ground under it
  int storeys = 1;
  BuildingKind kind = BuildingKind::detached;
  /// If there are any, the building consists of them alone; they overlap, and lie in the building's rectangle.
  std::vector<BuildingPlan> parts = {};
};

/// Gabled or hipped.
[[nodiscard]] inline bool has_pitched_roof(const BuildingPlan& plan) {
  return plan.roof == RoofShape::gabled || plan.roof == RoofShape::hipped;
}

/// The rectangle around a building's footprint.
[[nodiscard]] Box2d plan_rectangle(const BuildingPlan& plan);
/// The footprint in the lot's frame, counter-clockwise from the lot's corner, without the court.
[[nodiscard]] std::vector<Point2d> footprint_ring(const BuildingPlan& plan);

/// The plans of the buildings of a block. They depend neither on the level of detail nor on the blocks planned before.
///   (1) no building extends beyond the rectangle of the block
///   (2) no two buildings of a block overlap; attached ones share a wall line
///   (3) `overhangs` changes only the ground floors of some buildings, and makes their roofs flat
[[nodiscard]] std::vector<BuildingPlan> plans_of_block(const CitySettings& settings, CityBlock block);

/// The pedestrian bridges from a block to its northern and eastern neighbors: from wall to wall across the street, between
/// buildings that are tall enough. None without `overhangs`.
[[nodiscard]] std::vector<BuildingPlan> bridges_of_block(const CitySettings& settings, CityBlock block);

/// The elevation of the base of a building: that of the ground at the lowest corner of its rectangle, rounded down to a
/// centimetre.
[[nodiscard]] double base_m(const UrbanField& field, const BuildingPlan& plan);

}  // namespace farlod
