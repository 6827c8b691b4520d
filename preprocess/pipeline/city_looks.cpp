// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/city_looks.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "georeference/place_on_earth.hpp"
#include "tiles/pixel_steps.hpp"

namespace farlod::pipeline {
namespace {

/// The range of some heights.
struct HeightRange {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] bool is_empty() const { return low > high; }
};

CityLooks::Heights heights_in(std::vector<double> heights_m) {
  const auto [least, most] = std::minmax_element(heights_m.begin(), heights_m.end());
  const CityLooks::Heights ends{*least, 0.0, *most};
  const auto middle = heights_m.begin() + static_cast<std::ptrdiff_t>(heights_m.size() / 2);
  std::nth_element(heights_m.begin(), middle, heights_m.end());
  return {ends.least_m, *middle, ends.tallest_m};
}

/// A turned raster is read as points.
bool is_surface(const ReadCity& city) {
  return city.located.city.buildings().empty() && (city.ground.terrain || city.located.sources.empty());
}

/// Whether a building says at which elevation it stands.
bool tells_foot(const Building& b) { return b.height_reference == HeightReference::elevation && b.foot != Foot::above_ground; }

GroundSource source_of(const ReadCity& city) {
  if (is_surface(city)) return GroundSource::surface;
  if (city.ground.terrain) return GroundSource::terrain;
  if (!city.located.relief_points.empty()) return GroundSource::relief;
  const auto buildings = city.located.city.buildings();
  return std::any_of(buildings.begin(), buildings.end(), tells_foot) ? GroundSource::bases : GroundSource::nothing;
}

std::optional<double> survey_at(const ReadCity& city, Point2d p_city) {
  return city.ground.terrain ? city.ground.terrain->height_at(p_city) : std::nullopt;
}

void add_points(const ReadCity& city, HeightRange& range) {
  for (const Point3d& p : city.located.relief_points) range.add(p.z);
}

/// By how much a building begins above a terrain, and its number.
using FootOnGround = std::pair<double, std::size_t>;
std::optional<CityLooks::Feet> feet_in(std::span<const FootOnGround> feet, std::span<const Building> buildings) {
  if (feet.empty()) return std::nullopt;
  std::vector<double> above_m;
  for (const auto& [m, building] : feet) above_m.push_back(m);
  const auto [lowest, highest] = std::ranges::minmax(feet);
  return CityLooks::Feet{heights_in(std::move(above_m)), buildings[lowest.second].id, buildings[highest.second].id};
}

/// A city without buildings: the walls that a raster shows, and how far it reaches up and down.
void look_at_ground(const ReadCity& city, CityLooks& looks) {
  HeightRange range;
  add_points(city, range);
  if (const auto& raster = city.ground.terrain) {
    for (const auto& height_m : raster->height_m)
      if (height_m) range.add(*height_m);
    std::vector<double> walls_m;
    if (raster->covers_pixels) walls_m = tiles::PixelSteps(*raster).heights_m(*raster);
    if (!walls_m.empty()) looks.heights = heights_in(std::move(walls_m));
  }
  if (!range.is_empty()) looks.ground = CityLooks::Ground{range.low, range.high, source_of(city)};
}

struct ReachOfBuilding {
  HeightRange z;
  Box2d outline;
};
ReachOfBuilding reach_of(std::span<const Point3d> points) {
  ReachOfBuilding reach;
  for (const Point3d& p : points) {
    reach.z.add(p.z);
    reach.outline.add(horizontal(p));
  }
  return reach;
}

/// Goes through the buildings once.
void look_at_buildings(const ReadCity& city, CityLooks& looks) {
  const CityModel& model = city.located.city;
  const GroundSource source = source_of(city);
  std::vector<double> heights_m;
  std::vector<FootOnGround> feet;
  HeightRange ground;
  model.for_each_building([&](std::size_t n, const Building& b) {
    const auto [z, outline] = reach_of(model.points_of(b));
    if (z.is_empty()) return;
    const auto survey_m = survey_at(city, 0.5 * (outline.low + outline.high));
    if (survey_m) ground.add(*survey_m);
    if (survey_m && tells_foot(b)) feet.emplace_back(z.low - *survey_m, n);
    if (source == GroundSource::bases && tells_foot(b)) ground.add(z.low);
    if (b.height_reference != HeightReference::down_to_ground)
      heights_m.push_back(z.high - z.low);
    else if (survey_m && z.high > *survey_m)
      heights_m.push_back(z.high - *survey_m);
  });
  if (source == GroundSource::relief) add_points(city, ground);
  if (!heights_m.empty()) looks.heights = heights_in(std::move(heights_m));
  if (source == GroundSource::nothing) ground.add(0.0);
  if (!ground.is_empty()) looks.ground = CityLooks::Ground{ground.low, ground.high, source};
  if (looks.ground) looks.ground->feet = feet_in(feet, model.buildings());
}

}  // namespace

CityLooks looks_of(const ReadCity& city) {
  CityLooks looks;
  const georeference::PlaceOnEarth place = georeference::place_of(city.located.georeference);
  looks.lon_lat_deg = place.lon_lat_deg;
  looks.country = place.country;
  city.located.city.buildings().empty() ? look_at_ground(city, looks) : look_at_buildings(city, looks);
  return looks;
}

}  // namespace farlod::pipeline
