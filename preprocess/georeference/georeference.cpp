// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/georeference.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

#include "city/input_error.hpp"
#include "farlod/box.hpp"
#include "georeference/output_crs.hpp"
#include "georeference/problem_locator.hpp"
#include "georeference/source_coordinates.hpp"

namespace farlod {
namespace {

using Projection = std::function<void(std::span<Point3d>)>;

/// No map of the Earth has coordinates as large as this, zone numbers before the easting included.
constexpr double beyond_all_maps_m = 1e8;

/// A file whose x is the easting or longitude, and whose heights are in metres.
struct SettledSource {
  SourceCity source;
  Crs crs;
  Point2d typical;
  AxisOrder order_in_file = AxisOrder::as_usual;
};

SettledSource settle(SourceCity source, const GeoreferenceSettings& settings) {
  NamedCrs named = crs_of_input(source.source, source.crs.definition, settings.crs);
  const TypicalBuilding typical = typical_building(source.city);
  check_units(source, typical, named.crs);
  const bool northing_first = is_northing_first(typical.place, named.crs, source.crs.longitude_first || named.longitude_first);
  settle_axes(source, named.crs, northing_first);
  const Point2d place = northing_first ? Point2d{typical.place.y, typical.place.x} : typical.place;
  return {std::move(source), std::move(named.crs), place, northing_first ? AxisOrder::northing_first : AxisOrder::as_usual};
}

void project_to_utm(std::span<Point3d> points, const UtmProjection& utm) {
  for (Point3d& p : points) {
    constexpr double nowhere = std::numeric_limits<double>::infinity();
    const Point2d there = utm.projected(horizontal(p)).value_or(Point2d{nowhere, nowhere});
    p = {there.x, there.y, p.z};
  }
}

Projection make_projection(const Crs& from, const Crs& to, Point2d typical) {
  // Coordinates that are in the output CRS already stay what they are, to the last bit
  if (from.equals(to)) return [](std::span<Point3d>) {};
  // Feet to metres is a factor, wherever the coordinates lie
  if (from.is_projected() && from.unit() != 1.0 && from.in_metres().equals(to))
    return [unit_m = from.unit()](std::span<Point3d> points) {
      for (Point3d& p : points) p = {unit_m * p.x, unit_m * p.y, p.z};
    };
  // UTM on the same datum is a formula: no datum shift can come between
  if (const auto zone = to.utm_zone(); zone && from.is_in_degrees_from_greenwich() && to.geographic().equals(from))
    return [utm = UtmProjection(*zone, to.ellipsoid())](std::span<Point3d> points) { project_to_utm(points, utm); };
  return [way = CrsTransformation(from, to, typical)](std::span<Point3d> points) { way.apply(points); };
}

bool is_on_a_map(const Point3d& p) { return std::abs(p.x) < beyond_all_maps_m && std::abs(p.y) < beyond_all_maps_m; }

std::string detail_of(const Point3d& given, const Crs& output) {
  std::ostringstream text;
  text.precision(10);
  text << "a vertex at " << given.x << ", " << given.y << " has no place in " << output.name();
  return text.str();
}

/// A settled point as the file has it.
Point3d p_file(const Point3d& p, const SettledSource& settled) {
  const double height_unit_m = settled.source.crs.heights_in_metres ? 1.0 : settled.crs.height_unit_m();
  const bool northing_first = settled.order_in_file == AxisOrder::northing_first;
  return {northing_first ? p.y : p.x, northing_first ? p.x : p.y, p.z / height_unit_m};
}

void locate_problems(const SettledSource& settled, Report& report) {
  ProblemLocator locator(settled.crs, settled.order_in_file, settled.typical);
  for (Problem& problem : report.since(0))
    if (problem.source == settled.source.source) locator.locate(problem);
}

/// Appends a copy of a building.
void copy_building(const CityModel& from, const Building& b, CityModel& to) {
  to.begin_building(b.id, b.stands_on_ground, b.source);
  for (const Facet& f : from.facets_of(b)) {
    to.begin_facet(f.kind, f.surface, f.part);
    for (std::uint32_t k = 0; k < f.ring_count; ++k) to.add_ring(from.ring(f, k));
  }
}

/// The building's points, to be changed.
std::span<Point3d> mutable_points_of(CityModel& city, const Building& b) {
  const auto points = std::as_const(city).points_of(b);
  if (points.empty()) return {};
  return city.points().subspan(static_cast<std::size_t>(points.data() - city.points().data()), points.size());
}

/// Projects a file, building by building, and returns those that lie nowhere.
std::vector<std::size_t> project(SettledSource& settled, const Crs& output, Report& report) {
  const Projection projection = make_projection(settled.crs, output, settled.typical);
  std::vector<std::size_t> lost;
  std::vector<Point3d> before;
  CityModel& city = settled.source.city;
  for (std::size_t n = 0; n < city.buildings().size(); ++n) {
    const Building& b = city.buildings()[n];
    const auto points = mutable_points_of(city, b);
    before.assign(points.begin(), points.end());
    projection(points);
    const auto bad = std::find_if_not(points.begin(), points.end(), is_on_a_map);
    if (bad == points.end()) continue;
    const Point3d& given = before[static_cast<std::size_t>(bad - points.begin())];
    report.add(
        {ProblemCode::outside_of_projection, settled.source.source, b.id, detail_of(given, output), p_file(given, settled)});
    lost.push_back(n);
  }
  return lost;
}

void append_without(CityModel& city, CityModel&& more, const std::vector<std::size_t>& lost) {
  if (lost.empty()) return city.append(std::move(more));
  for (std::size_t n = 0; n < more.buildings().size(); ++n)
    if (!std::binary_search(lost.begin(), lost.end(), n)) copy_building(more, more.buildings()[n], city);
}

/// From the projected frame into the city frame.
Georeference move_to_origin(CityModel& city, const Crs& output) {
  Box2d box;
  for (const Point3d& p : city.points()) box.add(horizontal(p));
  const Georeference georeference = georeference_around(0.5 * (box.low + box.high), output);
  for (Point3d& p : city.points()) p = p - Point3d{georeference.origin_m.x, georeference.origin_m.y, 0.0};
  return georeference;
}

}  // namespace

LocatedCity georeference(std::vector<SourceCity> sources, const GeoreferenceSettings& settings, Report& report) {
  LocatedCity located;
  std::optional<Crs> output;
  for (SourceCity& source : sources) {
    if (source.city.points().empty()) continue;
    SettledSource settled = settle(std::move(source), settings);
    if (!output) output = choose_output_crs(settled.crs, settled.typical, settings.out_crs);
    const auto lost = project(settled, *output, report);
    locate_problems(settled, report);
    settled.source.city.set_source(static_cast<std::uint32_t>(located.sources.size()));
    located.sources.push_back(settled.source.source);
    append_without(located.city, std::move(settled.source.city), lost);
  }
  if (located.city.points().empty())
    throw InputError("no building is left that could be put on the map: see the report for what is wrong with each");
  located.georeference = move_to_origin(located.city, *output);
  return located;
}

}  // namespace farlod
