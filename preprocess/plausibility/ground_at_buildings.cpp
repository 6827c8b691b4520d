// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plausibility/ground_at_buildings.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "farlod/box.hpp"
#include "farlod/error.hpp"

namespace farlod::plausibility {
namespace {

/// Fewer buildings may stand on mounds, or be towers.
constexpr std::size_t fewest = 8;

Box2d outline_of_building(std::span<const Point3d> points) {
  Box2d box;
  for (const Point3d& p : points) box.add(horizontal(p));
  return box;
}

/// How much higher the ground is in the middle of a building than beside it: than the mean of two opposite sides, so that a slope
/// makes no bump; on the axis with fewer neighbours.
std::optional<double> bump_m(const Box2d& box, const KnownGroundHeightAt& ground_height) {
  constexpr double beside_m = 3.0;
  const Point2d middle = 0.5 * (box.low + box.high), half = box.high - middle;
  const auto top_m = ground_height(middle);
  std::optional<double> highest_m;
  for (const Point2d away : {Point2d{half.x + beside_m, 0.0}, Point2d{0.0, half.y + beside_m}}) {
    const auto a_m = ground_height(middle + away), b_m = ground_height(middle - away);
    if (top_m && a_m && b_m) highest_m = std::max(highest_m.value_or(-1e9), *top_m - 0.5 * (*a_m + *b_m));
  }
  return highest_m;
}

double at_share(std::vector<double>& values, double share) {
  const auto n = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + n, values.end());
  return values[static_cast<std::size_t>(n)];
}

std::string tenths_of_metres(double length_m) { return fmt::format("{:.1f} m", length_m); }

/// The roofs of a file above the ground.
struct RoofsOfFile {
  std::vector<double> above_ground_m;
  Point3d place;

  void add(std::span<const Point3d> points, const KnownGroundHeightAt& ground_height) {
    const Box2d box = outline_of_building(points);
    const auto ground_m = ground_height(0.5 * (box.low + box.high));
    if (!ground_m) return;
    const auto by_height = [](const Point3d& p, const Point3d& q) { return p.z < q.z; };
    if (above_ground_m.empty()) place = points.front();
    above_ground_m.push_back(std::max_element(points.begin(), points.end(), by_height)->z - *ground_m);
  }
};

}  // namespace

void require_ground_without_roofs(const LocatedCity& located, const SurveyedGround& ground) {
  constexpr double least_bump_m = 2.5, share = 0.25;
  if (!ground.is_raster) return;
  std::vector<double> bumps_m;
  const CityModel& city = located.city;
  city.for_each_building([&](std::size_t, const Building& b) {
    const Box2d box = outline_of_building(city.points_of(b));
    if (box.empty() || !ground.extent_city.contains(0.5 * (box.low + box.high))) return;
    if (const auto found_m = bump_m(box, ground.height_at)) bumps_m.push_back(*found_m);
  });
  if (bumps_m.size() < fewest || at_share(bumps_m, share) < least_bump_m) return;
  throw InputError(
      "the terrain (--terrain, or the raster among the inputs) has roofs in it, as a surface model (DSM) does: nearly all of "
      "the " +
      std::to_string(bumps_m.size()) + " buildings stand on a bump of their own size, of typically " +
      tenths_of_metres(at_share(bumps_m, 0.5)) + ". Give a terrain without buildings (DTM), or pack the surface model alone.");
}

void report_roofs(const LocatedCity& located, const SurveyedGround& ground, Report& report) {
  constexpr double too_high_m = 30.0, too_many_below = 0.1;
  std::vector<RoofsOfFile> files(std::max<std::size_t>(located.sources.size(), 1));
  const CityModel& city = located.city;
  city.for_each_building([&](std::size_t, const Building& b) {
    const auto points = city.points_of(b);
    if (b.height_reference == HeightReference::down_to_ground && !points.empty()) files[b.source].add(points, ground.height_at);
  });
  for (std::size_t n = 0; n < files.size(); ++n) {
    auto& [above_ground_m, place] = files[n];
    if (above_ground_m.size() < fewest) continue;
    const std::string source = n < located.sources.size() ? located.sources[n] : "";
    const double median_m = at_share(above_ground_m, 0.5);
    const std::string end = " the ground, typically " + tenths_of_metres(std::abs(median_m)) +
                            ": are both heights above the same datum, in the same unit? --terrain-offset shifts the terrain";
    if (median_m <= 0.0) throw InputError(source + ": the roofs of most buildings are below" + end + ".");
    const bool are_too_low = at_share(above_ground_m, too_many_below) <= 0.0;
    if (!are_too_low && at_share(above_ground_m, 0.05) < too_high_m) continue;
    const Point2d origin_m = located.georeference.origin_m;
    report.add({ProblemCode::another_datum, source, "the whole file",
                (are_too_low ? "a tenth of the roofs and more are below" : "all roofs are 30 m and more above") + end,
                place + Point3d{origin_m.x, origin_m.y, 0.0}});
  }
}

}  // namespace farlod::plausibility
