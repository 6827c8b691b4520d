// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "farlod/box.hpp"
#include "generator/city_layout.hpp"

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

/// The role of a facet, by the semantic surfaces of CityGML.
enum class FacetRole : std::uint8_t { roof, wall, ground, outer_ceiling };

/// What CityGML and CityJSON call a surface of this role.
[[nodiscard]] constexpr std::string_view surface_name_of(FacetRole role) {
  switch (role) {
    case FacetRole::roof:
      return "RoofSurface";
    case FacetRole::wall:
      return "WallSurface";
    case FacetRole::ground:
      return "GroundSurface";
    case FacetRole::outer_ceiling:
      break;
  }
  return "OuterCeilingSurface";
}

/// What fills an opening of a wall: a facet may be a window or a door.
enum class Filling : std::uint8_t { none, window, door };

/// A planar polygon by vertex numbers, counter-clockwise seen from outside; the first vertex is not repeated. A hole has as many
/// corners as the outer ring, and its corner (n − k) mod n lies opposite to corner k of the outer ring.
struct GeneratedFacet {
  FacetRole role = FacetRole::wall;
  std::vector<std::uint32_t> outer = {};
  std::vector<std::uint32_t> hole = {};                   ///< clockwise; empty if there is none
  std::vector<std::vector<std::uint32_t>> openings = {};  ///< of a wall: further holes, clockwise
  Filling filling = Filling::none;                        ///< the role of a window or a door is that of a wall
  std::size_t in_wall = 0;                                ///< of a window or a door: the facet whose opening it fills
};

/// A point of a footprint, in whole millimetres.
using PlanPointMm = std::array<std::int64_t, 2>;

/// The role of a component: the whole building, a BuildingPart, or a BuildingInstallation.
enum class ComponentKind : std::uint8_t { body, part, installation };

/// Consecutive facets of a building that form one solid. Two components have no vertex in common.
struct GeneratedComponent {
  ComponentKind kind = ComponentKind::body;
  std::string id;      ///< of the body: that of the building
  bool closed = true;  ///< whether its facets enclose a volume without a gap
  std::size_t first_facet = 0, facet_count = 0;
  /// The footprint: counter-clockwise, with a clockwise hole for a court. Installations have none.
  std::vector<PlanPointMm> footprint = {}, footprint_hole = {};
  std::int64_t base_mm = 0, top_mm = 0;  ///< its lowest and highest elevation
};

/// A building: one body, or parts, and then installations.
///   (1) each edge of a closed component's facets is used twice, once in each direction
///   (2) facets look outwards
///   (3) the corners of a facet lie within `planarity_mm` of a plane: only the rounding to millimetres moves them off it
struct GeneratedBuilding {
  std::string id;  ///< unique in the city; fit to be an XML id
  BuildingKind kind = BuildingKind::detached;
  int storeys = 1;
  std::vector<PointMm> vertices;  ///< city frame; each place once in a component
  std::vector<GeneratedFacet> facets;
  std::vector<GeneratedComponent> components;          ///< never empty; together they hold all facets, in order
  std::vector<PlanPointMm> footprint, footprint_hole;  ///< of the first component
  std::int64_t base_mm = 0, top_mm = 0;                ///< lowest and highest elevation of the building

  [[nodiscard]] double height_m() const { return static_cast<double>(top_mm - base_mm) * 1e-3; }
};

/// Rounding moves each coordinate by at most half a millimetre, hence a corner by at most √3/2 mm, to either side of the
/// plane on which it was laid out.
inline constexpr double planarity_mm = 0.8660254037844387;

}  // namespace farlod
