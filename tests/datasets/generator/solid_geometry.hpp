// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "generator/generated_building.hpp"

namespace farlod {

using RingNumbers = std::vector<std::uint32_t>;

/// All rings of all facets: outer ones, holes and openings.
[[nodiscard]] std::vector<RingNumbers> rings_of(const GeneratedBuilding& building);
[[nodiscard]] std::vector<RingNumbers> rings_of(const GeneratedBuilding& building, const GeneratedComponent& component);
/// The facets of a component.
[[nodiscard]] std::span<const GeneratedFacet> facets_of(const GeneratedBuilding& building, const GeneratedComponent& component);
/// The facets of a role.
[[nodiscard]] std::vector<GeneratedFacet> facets_with(const GeneratedBuilding& building, FacetRole role);
[[nodiscard]] inline Point3d as_double(const PointMm& p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
}
/// Whether each edge is used once in each direction.
[[nodiscard]] bool is_closed(std::span<const RingNumbers> rings);
/// Six times the volume that the rings enclose, in cubic millimetres; exact. Positive if they look outwards.
[[nodiscard]] std::int64_t six_volumes_mm3(std::span<const RingNumbers> rings, std::span<const PointMm> vertices);
/// Twice the area vector of a ring, exact.
[[nodiscard]] PointMm twice_area_mm2(const RingNumbers& ring, std::span<const PointMm> vertices);
/// Distance of the closest two parallel planes that hold all points between them. The best pair touches three points, or two
/// and two, so that trying the normals of all pairs of connecting lines finds it.
[[nodiscard]] double least_thickness_mm(std::span<const PointMm> points);
/// Twice the signed area of a footprint's ring.
[[nodiscard]] std::int64_t twice_area_mm2(std::span<const PlanPointMm> ring);

/// Every building of a city.
[[nodiscard]] std::vector<GeneratedBuilding> all_buildings(const CitySettings& settings);
/// Cities that together have every kind of roof and overhang, turned and not, on flat ground and on hills.
[[nodiscard]] std::vector<CitySettings> cities_of_all_shapes();
/// One city for each option that adds to buildings or takes from them, and one with all of them.
[[nodiscard]] std::vector<CitySettings> cities_with_each_option();

/// Where a building is, in millimetres.
struct BoxMm {
  PointMm low, high;
};
[[nodiscard]] BoxMm box_of(const GeneratedBuilding& building, std::span<const GeneratedFacet> facets);

}  // namespace farlod
