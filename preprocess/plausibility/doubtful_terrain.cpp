// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plausibility/doubtful_terrain.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "farlod/error.hpp"

namespace farlod::plausibility {
namespace {

constexpr std::size_t fewest_on_terrain = 8;
/// No town is as far above its ground, or below it.
constexpr double impossible_from_terrain_m = 10.0;

/// A unit that a terrain may count in.
struct TerrainUnit {
  const char* name;
  double in_a_metre;
  double most_off;        ///< by which factor the ground may vary more or less than the bases would
  double least_spread_m;  ///< of the bases: what is flatter tells nothing
  double least_correlation;
};

/// Bases begin in cellars and on plinths, and a terrain is smoother: a factor of 100 is told with little relief. One of 3.28
/// needs much.
constexpr std::array terrain_units{TerrainUnit{"centimetres", 100.0, 2.0, 0.05, 0.4},
                                   TerrainUnit{"millimetres", 1000.0, 2.0, 0.05, 0.4},
                                   TerrainUnit{"feet", 1.0 / 0.3048, 1.1, 3.0, 0.95}};

/// How bases and ground vary together.
struct Covariation {
  double count = 0.0, base_spread_m = 0.0, ground_spread_m = 0.0, correlation = 0.0;

  /// How many times as much the ground varies: what bases do by themselves does not count.
  [[nodiscard]] double factor() const { return ground_spread_m / (base_spread_m * correlation); }
  [[nodiscard]] bool is_of(const TerrainUnit& unit) const {
    // Chance may correlate a few as much
    const double least_correlation = std::max(unit.least_correlation, 2.0 / std::sqrt(count));
    if (base_spread_m < unit.least_spread_m || correlation < least_correlation) return false;
    return std::abs(std::log(factor() / unit.in_a_metre)) <= std::log(unit.most_off);
  }
};

/// The pairs without the lowest and highest bases: one at 9999 would hide all others.
std::vector<std::pair<double, double>> without_extremes(std::vector<std::pair<double, double>> pairs) {
  constexpr std::size_t part = 20;
  const auto off = static_cast<std::ptrdiff_t>((pairs.size() + part - 1) / part);
  std::sort(pairs.begin(), pairs.end());
  return {pairs.begin() + off, pairs.end() - off};
}

Covariation covariation_of(const std::vector<std::pair<double, double>>& pairs) {
  const auto count = static_cast<double>(pairs.size());
  double base_m = 0.0, ground_m = 0.0, bases = 0.0, grounds = 0.0, products = 0.0;
  for (const auto& [base, ground] : pairs) {
    base_m += base / count;
    ground_m += ground / count;
  }
  for (const auto& [base, ground] : pairs) {
    bases += (base - base_m) * (base - base_m) / count;
    grounds += (ground - ground_m) * (ground - ground_m) / count;
    products += (base - base_m) * (ground - ground_m) / count;
  }
  const double spreads = std::sqrt(bases * grounds);
  return {count, std::sqrt(bases), std::sqrt(grounds), spreads > 0.0 ? products / spreads : 0.0};
}

double slope_across(const Box2d& box, const KnownGroundHeightAt& ground_height) {
  constexpr double beside_m = 3.0;
  const Point2d middle = 0.5 * (box.low + box.high), half = box.high - middle;
  double squares = 0.0;
  for (const Point2d away : {Point2d{half.x + beside_m, 0.0}, Point2d{0.0, half.y + beside_m}}) {
    const auto a_m = ground_height(middle + away), b_m = ground_height(middle - away);
    const double slope = a_m && b_m ? (*a_m - *b_m) / (2.0 * norm(away)) : 0.0;
    squares += slope * slope;
  }
  return std::sqrt(squares);
}

void tell_of_terrain(std::string detail, const GroundBelowBuildings& below, const LocatedCity& located,
                     const SurveyedGround& ground, Report& report) {
  const Point2d origin_m = located.georeference.origin_m;
  report.add({ProblemCode::implausible_size, ground.source, "the whole file", std::move(detail),
              below.highest + Point3d{origin_m.x, origin_m.y, 0.0}});
}

std::string range_of_ground(const GroundBelowBuildings& below) {
  const auto [low, high] = std::minmax_element(below.height_m.begin(), below.height_m.end());
  const Point2d size = below.outline.high - below.outline.low;
  return fmt::format("from {:.0f} m to {:.0f} m below {} buildings on {:.0f} m", *low, *high, below.height_m.size(),
                     std::max(size.x, size.y));
}

std::string advice_for_unit(const TerrainUnit& unit) {
  return fmt::format("is the terrain in {}? gdal_edit.py -scale {:g} FILE says so; or convert it to metres", unit.name,
                     std::round(1e4 / unit.in_a_metre) / 1e4);
}

}  // namespace

GroundBelowBuildings ground_below(const LocatedCity& located, const SurveyedGround& ground) {
  GroundBelowBuildings below;
  const CityModel& city = located.city;
  city.for_each_building([&](std::size_t, const Building& b) {
    Box2d box;
    double base_m = std::numeric_limits<double>::infinity();
    for (const Point3d& p : city.points_of(b)) {
      box.add(horizontal(p));
      base_m = std::min(base_m, p.z);
    }
    const Point2d middle = 0.5 * (box.low + box.high);
    const auto ground_m = box.empty() || !ground.extent_city.contains(middle) ? std::nullopt : ground.height_at(middle);
    if (!ground_m) return;
    if (below.height_m.empty() || *ground_m > below.highest.z) below.highest = {middle.x, middle.y, *ground_m};
    below.height_m.push_back(*ground_m);
    below.slope.push_back(slope_across(box, ground.height_at));
    for (const Point2d corner : {box.low, box.high}) below.outline.add(corner);
    if (b.height_reference == HeightReference::elevation && b.foot != Foot::above_ground)
      below.base_and_ground.emplace_back(base_m, *ground_m);
  });
  return below;
}

bool report_unit_of_terrain(const GroundBelowBuildings& below, const LocatedCity& located, const SurveyedGround& ground,
                            Report& report) {
  if (!ground.is_raster || below.base_and_ground.size() < fewest_on_terrain) return false;
  const auto pairs = without_extremes(below.base_and_ground);
  const Covariation together = covariation_of(pairs);
  const auto unit =
      std::find_if(terrain_units.begin(), terrain_units.end(), [&](const TerrainUnit& u) { return together.is_of(u); });
  if (unit == terrain_units.end()) return false;
  const std::string detail =
      fmt::format("its heights, {}, vary {:.3g} times as much as the bases of the buildings, from {:.1f} m to {:.1f} m: {}",
                  range_of_ground(below), together.factor(), pairs.front().first, pairs.back().first, advice_for_unit(*unit));
  tell_of_terrain(detail, below, located, ground, report);
  const auto far = std::count_if(pairs.begin(), pairs.end(), [](const auto& pair) {
    return std::abs(pair.first - pair.second) >= impossible_from_terrain_m;
  });
  if (2 * static_cast<std::size_t>(far) > pairs.size())
    throw InputError((ground.source.empty() ? "the terrain" : ground.source) + ": " + detail + ".");
  return true;
}

bool report_steep_terrain(const GroundBelowBuildings& below, const LocatedCity& located, const SurveyedGround& ground,
                          Report& report) {
  constexpr double steepest = 1.0, least_range_m = 100.0;
  if (!ground.is_raster || below.slope.size() < fewest_on_terrain) return false;
  std::vector<double> slopes = below.slope;
  const auto middle = slopes.begin() + static_cast<std::ptrdiff_t>(slopes.size() / 2);
  std::nth_element(slopes.begin(), middle, slopes.end());
  const auto [low, high] = std::minmax_element(below.height_m.begin(), below.height_m.end());
  if (*middle <= steepest || *high - *low <= least_range_m) return false;
  tell_of_terrain(
      fmt::format("its heights, {}, climb or fall by {:.1f} m on a metre below half of them, as below no town: {}; or is it "
                  "another quantity?",
                  range_of_ground(below), *middle, advice_for_unit(terrain_units.front())),
      below, located, ground, report);
  return true;
}

}  // namespace farlod::plausibility
