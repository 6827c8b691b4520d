// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/source_coordinates.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include "city/input_error.hpp"
#include "farlod/box.hpp"
#include "farlod/expects.hpp"

namespace farlod {
namespace {

/// No building is as small as 5 cm or as large as 0.05° (5 km): its extent tells metres and feet from degrees.
constexpr double between_degrees_and_metres = 0.05;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double larger_side(std::span<const Point3d> points) {
  Box2d box;
  for (const Point3d& p : points) box.add(horizontal(p));
  return std::max(box.high.x - box.low.x, box.high.y - box.low.y);
}

bool may_be_lon_lat(Point2d p) {
  return std::abs(p.x) <= 180.0 && std::abs(p.y) <= 180.0 && std::min(std::abs(p.x), std::abs(p.y)) <= 90.0;
}

std::string text_of(Point2d p) {
  std::ostringstream text;
  text.precision(10);
  text << p.x << ", " << p.y;
  return text.str();
}

bool lies_in_area_of_use(Point2d p, const Crs& crs) {
  const auto area = crs.area_of_use();
  const auto world = Crs::find("EPSG:4326");
  FARLOD_EXPECTS(world.has_value());
  const auto lon_lat_deg = CrsTransformation(crs, *world, p).apply(p);
  return area && lon_lat_deg && area->contains(*lon_lat_deg);
}

}  // namespace

TypicalBuilding typical_building(const CityModel& city) {
  std::vector<double> x, y, extent;
  for (const Building& b : city.buildings()) {
    const auto points = city.points_of(b);
    if (points.empty()) continue;
    x.push_back(points.front().x);
    y.push_back(points.front().y);
    extent.push_back(larger_side(points));
  }
  FARLOD_EXPECTS(!x.empty());
  return {{median(std::move(x)), median(std::move(y))}, median(std::move(extent))};
}

bool is_northing_first(Point2d p, const Crs& crs, bool longitude_first) {
  if (longitude_first || !crs.northing_first()) return false;
  if (!crs.is_projected()) return std::abs(p.x) <= 90.0 || std::abs(p.y) > 90.0;
  return lies_in_area_of_use({p.y, p.x}, crs) && !lies_in_area_of_use(p, crs);
}

void check_units(const SourceCity& source, const TypicalBuilding& typical, const Crs& crs) {
  const bool looks_like_degrees = may_be_lon_lat(typical.place) && typical.extent < between_degrees_and_metres;
  if (crs.is_projected() == !looks_like_degrees) return;
  const std::string place =
      " (" + text_of(typical.place) + "): name the CRS that they are in, in the file, or with --crs EPSG:n if it says none";
  if (crs.is_projected())
    throw InputError(source.source + ": its CRS " + crs.name() + " is projected, but its coordinates look like degrees" + place);
  throw InputError(source.source + ": its CRS " + crs.name() + " counts in degrees, but its coordinates cannot be degrees" +
                   place);
}

void settle_axes(SourceCity& source, const Crs& crs, bool northing_first) {
  const double height_unit_m = source.crs.heights_in_metres ? 1.0 : crs.height_unit_m();
  for (Point3d& p : source.city.points()) {
    if (northing_first) std::swap(p.x, p.y);
    p.z *= height_unit_m;
  }
}

}  // namespace farlod
