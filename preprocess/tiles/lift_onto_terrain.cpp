// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/lift_onto_terrain.hpp"

#include <algorithm>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

#include "city/height_limits.hpp"

namespace farlod::tiles {
namespace {

/// The lowest ground under a building's outline.
std::optional<double> lowest_ground_m(std::span<const Point3d> points, const KnownGroundHeightAt& ground_height) {
  std::optional<double> lowest_m;
  for (const Point3d& p : points)
    if (const auto height_m = ground_height(horizontal(p)); height_m && (!lowest_m || *height_m < *lowest_m)) lowest_m = height_m;
  return lowest_m;
}

struct Refusal {
  ProblemCode code;
  std::string detail;
};

/// Moves the points that are nearer to the base than to the roof to the ground, or says why it cannot.
std::optional<Refusal> reach_down(std::span<Point3d> points, std::optional<double> ground_m) {
  const auto by_height = [](const Point3d& a, const Point3d& b) { return a.z < b.z; };
  const auto [lowest, highest] = std::minmax_element(points.begin(), points.end(), by_height);
  const double roof_m = highest->z, middle_m = 0.5 * (lowest->z + highest->z);
  std::ostringstream detail;
  detail << "its roof is at " << roof_m << " m, ";
  if (!ground_m) return Refusal{ProblemCode::no_height, detail.str() + "and the terrain does not say where the ground is"};
  detail << "the ground there at " << *ground_m << " m";
  if (roof_m <= *ground_m) return Refusal{ProblemCode::height_not_positive, detail.str()};
  if (roof_m - *ground_m > highest_building_m) return Refusal{ProblemCode::absurd_height, detail.str()};
  for (Point3d& p : points)
    if (p.z < middle_m) p.z = *ground_m;
  return std::nullopt;
}

Problem problem_of(const LocatedCity& located, const Building& b, Refusal refusal, const Point3d& p_city) {
  const Point2d origin_m = located.georeference.origin_m;
  return {refusal.code, b.source < located.sources.size() ? located.sources[b.source] : "", b.id, std::move(refusal.detail),
          p_city + Point3d{origin_m.x, origin_m.y, 0.0}};
}

}  // namespace

void lift_onto_terrain(LocatedCity& located, const KnownGroundHeightAt& ground_height, Report& report) {
  CityModel& city = located.city;
  std::vector<bool> is_lost(city.facets().size(), false);
  for (const Building& b : city.buildings()) {
    if (b.height_reference == HeightReference::elevation || b.facet_count == 0) continue;
    const std::span<Point3d> points = city.points_of(b);
    const std::optional<double> ground_m = lowest_ground_m(points, ground_height);
    if (b.height_reference == HeightReference::on_ground) {
      for (Point3d& p : points) p.z += ground_m.value_or(0.0);
    } else if (auto refusal = reach_down(points, ground_m)) {
      report.add(problem_of(located, b, std::move(*refusal), points.front()));
      const auto first = is_lost.begin() + static_cast<std::ptrdiff_t>(b.first_facet);
      std::fill_n(first, b.facet_count, true);
    }
  }
  city.drop_facets(is_lost);
}

}  // namespace farlod::tiles
