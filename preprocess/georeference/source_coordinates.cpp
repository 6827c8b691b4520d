// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/source_coordinates.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/expects.hpp"
#include "farlod/box.hpp"
#include "farlod/error.hpp"
#include "georeference/crs_area.hpp"
#include "georeference/place_text.hpp"

namespace farlod::georeference {
namespace {

/// Tells metres and feet from degrees: most facets, and the distances between points of a relief, are larger than 5 cm and
/// smaller than 0.05° (5 km).
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

/// By medians, which a few stray buildings do not change.
TypicalPlace typical_of_buildings(const CityModel& city) {
  std::vector<double> x, y, z, extent, grain;
  city.for_each_building([&](std::size_t, const Building& b) {
    const auto points = city.points_of(b);
    if (points.empty()) return;
    x.push_back(points.front().x);
    y.push_back(points.front().y);
    z.push_back(points.front().z);
    extent.push_back(larger_side(points));
    for (const Facet& facet : city.facets_of(b)) grain.push_back(larger_side(city.ring(facet, 0)));
  });
  return {
      {median(std::move(x)), median(std::move(y)), median(std::move(z))}, median(std::move(extent)), median(std::move(grain))};
}

/// By medians of a sample. Most points of a relief follow a neighboring point, since it is written by triangles or rows.
TypicalPlace typical_of_relief(std::span<const Point3d> points) {
  constexpr std::size_t enough = 10'000;
  const std::size_t stride = std::max<std::size_t>(points.size() / enough, 1);
  std::vector<double> x, y, z, steps;
  for (std::size_t n = 0; n < points.size(); n += stride) {
    x.push_back(points[n].x);
    y.push_back(points[n].y);
    z.push_back(points[n].z);
    const double step = n == 0 ? 0.0 : larger_side(points.subspan(n - 1, 2));
    if (step > 0.0) steps.push_back(step);
  }
  const auto grain = steps.empty() ? std::nullopt : std::optional(median(std::move(steps)));
  return {{median(std::move(x)), median(std::move(y)), median(std::move(z))}, std::nullopt, grain};
}

AxisOrder other(AxisOrder order) {
  return order == AxisOrder::easting_first ? AxisOrder::northing_first : AxisOrder::easting_first;
}

/// The number added to eastings that begin with the number of their UTM zone: 32,356,123. With the number of another zone, they
/// do not lie in the area of use.
double zone_before_easting(const Crs& crs) {
  constexpr double one_zone = 1e6;  // no easting of UTM has as many digits
  const auto zone = crs.utm_zone();
  return zone ? zone->number * one_zone : 0.0;
}

Point2d on_map(const FileAxes& axes, Point2d p_file) { return horizontal(axes.p_map({p_file.x, p_file.y, 0.0})); }

}  // namespace

TypicalPlace typical_place(const SourceCity& source) {
  if (!source.city.points().empty()) return typical_of_buildings(source.city);
  FARLOD_EXPECTS(!source.relief_points.empty());
  return typical_of_relief(source.relief_points);
}

AxisOrder stated_order(const Crs& crs, bool longitude_first) {
  return crs.northing_first() && !longitude_first ? AxisOrder::northing_first : AxisOrder::easting_first;
}

FileAxes find_axes(Point2d typical_place, const Crs& crs, bool longitude_first) {
  const FileAxes usual{crs.is_projected() ? AxisOrder::easting_first : stated_order(crs, longitude_first)};
  if (may_be_used_at(crs, on_map(usual, typical_place))) return usual;
  for (const AxisOrder order : {usual.order, other(usual.order)})
    for (const FileAxes axes : {FileAxes{order}, FileAxes{order, zone_before_easting(crs)}})
      if (lies_in_area_of_use(crs, on_map(axes, typical_place))) return axes;
  return usual;
}

bool may_count_in(const TypicalPlace& typical, const Crs& crs) {
  if (!typical.grain) return true;
  const bool looks_like_degrees = may_be_lon_lat(horizontal(typical.place)) && *typical.grain < between_degrees_and_metres;
  return crs.is_projected() == !looks_like_degrees;
}

void check_units(const SourceCity& source, const TypicalPlace& typical, const Crs& crs, const std::string& advice) {
  if (may_count_in(typical, crs)) return;
  const std::string end = " (" + place_text(horizontal(typical.place)) + "): " + advice;
  if (crs.is_projected())
    throw InputError(source.source + ": its CRS " + crs.name() + " is projected, but its coordinates look like degrees" + end);
  throw InputError(source.source + ": its CRS " + crs.name() + " counts in degrees, but its coordinates cannot be degrees" + end);
}

}  // namespace farlod::georeference
