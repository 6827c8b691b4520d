// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/city/surface_numbering.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace farlod {
namespace {

/// Twice the area of a ring, as a vector along its normal. It counts from the first point: far from the origin, the rounding of
/// the products would exceed the area.
Point3d double_area_of(const FileRing& ring) {
  Point3d sum{};
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) sum = sum + cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
  return sum;
}

std::optional<double> best_of(const std::vector<double>& lods, PackedLod choice) {
  std::optional<double> best;
  for (const double lod : lods) {
    const double whole = std::floor(lod);
    const bool is_wanted = choice ? whole == static_cast<double>(*choice) : whole >= 1.0 && whole <= 3.0;
    if (is_wanted && (!best || lod > *best)) best = lod;
  }
  return best;
}

}  // namespace

void measure(const FileRings& rings, NumberedPolygon& polygon) {
  Point3d sum{};
  for (const FileRing& ring : rings) sum = sum + double_area_of(ring);
  const double length = norm(sum);
  polygon.area = 0.5 * length;
  polygon.steepness = length > 0.0 ? std::abs(sum.z) / length : 0.0;
}

FileCorners corners_of(const FileRings& rings) {
  // NaN has no place in an order
  const auto ordered = [](double x) { return std::isnan(x) ? std::numeric_limits<double>::infinity() : x + 0.0; };
  std::set<std::array<double, 3>> corners;
  for (const FileRing& ring : rings)
    for (const Point3d& p : ring) corners.insert({ordered(p.x), ordered(p.y), ordered(p.z)});
  return {corners.begin(), corners.end()};
}

std::vector<std::optional<double>> chosen_lods(const LodsOfParts& lods_of_parts, PackedLod choice) {
  std::vector<std::optional<double>> chosen;
  for (const std::vector<double>& lods : lods_of_parts) chosen.push_back(best_of(lods, choice));
  const std::optional<double> level = *std::max_element(chosen.begin(), chosen.end());
  if (!level) return chosen;
  for (std::size_t part = 0; part < chosen.size(); ++part) {
    if (std::ranges::count(lods_of_parts[part], *level) > 0)
      chosen[part] = level;
    else if (part == 0)
      chosen[part].reset();
  }
  return chosen;
}

SurfaceKind kind_of_semantics(std::string_view name) {
  for (const std::string_view roof : {"RoofSurface", "OuterFloorSurface"})
    if (name == roof) return SurfaceKind::roof;
  for (const std::string_view wall : {"WallSurface", "Window", "Door", "WindowSurface", "DoorSurface"})
    if (name == wall) return SurfaceKind::wall;
  for (const std::string_view floor : {"GroundSurface", "OuterCeilingSurface"})
    if (name == floor) return SurfaceKind::floor;
  return SurfaceKind::unknown;
}

}  // namespace farlod
