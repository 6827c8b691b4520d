// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/georeference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

#include "farlod/box.hpp"
#include "farlod/error.hpp"
#include "georeference/height_shift.hpp"
#include "georeference/implausible_model.hpp"
#include "georeference/input_crs.hpp"
#include "georeference/resolved_source.hpp"
#include "plausibility/described_twice.hpp"

namespace farlod::georeference {
namespace {

/// The largest scale error of the output CRS. UTM has less than 0.1 % in its zone, Lambert-93 less than 0.3 %. At 1 %, the height
/// of a wall over its distance is wrong by 1 %, and so is the sky view factor.
constexpr double greatest_scale_error = 0.01;

std::optional<double> scale_error_at(const Crs& crs, Point2d p) {
  const auto distortion = crs.distortion_at(p);
  if (!distortion) return std::nullopt;
  return std::max(std::abs(distortion->least_scale - 1.0), std::abs(distortion->greatest_scale - 1.0));
}

bool is_in_area_of_use(const Crs& crs, Point2d p) {
  const auto place = crs.lon_lat_deg(p);
  const auto area = crs.area_of_use();
  return place && (!area || area->contains(*place));
}

/// True for coordinates outside of the area of use: for those of a local site, the scale of the map has no meaning.
bool has_true_metres(const Crs& crs, Point2d p) {
  return !is_in_area_of_use(crs, p) || scale_error_at(crs, p).value_or(0.0) <= greatest_scale_error;
}

Crs utm_around(const Crs& input, Point2d typical) {
  const auto place = input.lon_lat_deg(typical);
  if (!place)
    throw InputError(input.name() + ": the city at " + std::to_string(typical.x) + ", " + std::to_string(typical.y) +
                     " has no place on the Earth: check the input's CRS, or choose the output's with --out-crs EPSG:n");
  const Crs base = input.geographic();
  return (base.is_in_degrees_from_greenwich() ? base : *Crs::find("EPSG:4326")).utm(utm_zone_of(*place));
}

/// ", such as EPSG:32631 (WGS 84 / UTM zone 31N)"; empty where the city has no place on the Earth.
std::string such_as(const Crs& input, Point2d typical) {
  const auto place = input.lon_lat_deg(typical);
  const auto wgs84 = Crs::find("EPSG:4326");
  if (!place || !wgs84) return "";
  const Crs utm = wgs84->utm(utm_zone_of(*place));
  const auto code = utm.epsg();
  return ", such as " + (code ? "EPSG:" + std::to_string(*code) + " (" + utm.name() + ")" : utm.name());
}

Crs wished_crs(const Crs& input, Point2d typical, const std::string& wish) {
  const auto found = find_crs(wish);
  const std::string name = "--out-crs " + wish;
  if (!found) throw InputError(name + ": no such CRS is known: give EPSG:n");
  const Crs& crs = found->crs;
  if (!crs.is_projected() || crs.unit() != 1.0 || !crs.runs_east_and_north())
    throw InputError(name + " (" + crs.name() +
                     ") is not projected in metres to the east and north: give one that is, such as UTM");
  const auto p = CrsTransformation(input, crs, typical).apply(typical);
  if (!p) throw InputError(name + " (" + crs.name() + ") has no place for the city: give one that is meant for its region");
  // Where the city lies is certain if its own CRS is meant to be used there
  const bool is_elsewhere = is_in_area_of_use(input, typical) && scale_error_at(crs, *p).value_or(1.0) > greatest_scale_error;
  if (is_elsewhere || !has_true_metres(crs, *p))
    throw InputError(name + " (" + crs.name() + "): at the city its metres are off by more than 1 %: give a local one" +
                     such_as(input, typical));
  return crs;
}

/// By GeographicLib for UTM, by PROJ for all other projections.
Angle convergence_at(const Crs& crs, Point2d p_projected) {
  if (const auto zone = crs.utm_zone()) return UtmProjection(*zone, crs.ellipsoid()).convergence_at(p_projected);
  const auto distortion = crs.distortion_at(p_projected);
  return distortion ? distortion->convergence : Angle();
}

}  // namespace

Crs choose_output_crs(const Crs& input, Point2d typical, const std::string& wish) {
  if (!wish.empty()) return wished_crs(input, typical, wish);
  if (!input.is_projected() || !input.runs_east_and_north() || !has_true_metres(input, typical))
    return utm_around(input, typical);
  return input.unit() == 1.0 ? input : input.counted_in(metre);
}

Georeference georeference_around(Point2d centre, const Crs& output) {
  Georeference g;
  g.crs_wkt = output.wkt();
  g.epsg = output.epsg();
  g.crs_name = output.name();
  g.origin_m = {std::round(centre.x), std::round(centre.y)};
  g.convergence = convergence_at(output, g.origin_m);
  return g;
}

namespace {

std::string detail_of(const Point3d& given, const Crs& output) {
  std::ostringstream text;
  text.precision(10);
  text << "a vertex at " << given.x << ", " << given.y << " has no place in " << output.name();
  return text.str();
}

std::string detail_of(const MisplacedFacets& misplaced) {
  return std::to_string(misplaced.facets.size()) + (misplaced.all_of_it ? " polygons, the whole building" : " of its polygons");
}

void locate_problems(const ResolvedSource& resolved, Report& report) {
  ProblemLocator locator(resolved.crs, resolved.axes, resolved.typical);
  for (Problem& problem : report.since(0))
    if (problem.source == resolved.source.source) locator.locate(problem);
}

/// Projects the buildings of a file one by one. Points that have no place on the map are reported and become infinite.
void project_buildings(ResolvedSource& resolved, const Projection& projection, const Crs& output, Report& report) {
  std::vector<Point3d> before;
  CityModel& city = resolved.source.city;
  city.for_each_building([&](std::size_t, const Building& b) {
    const std::span<Point3d> points = city.points_of(b);
    before.assign(points.begin(), points.end());
    projection(points);
    const auto bad = std::find_if_not(points.begin(), points.end(), is_on_a_map);
    if (bad == points.end()) return;
    const Point3d& given = before[static_cast<std::size_t>(bad - points.begin())];
    report.add({ProblemCode::outside_of_projection, resolved.source.source, b.id, detail_of(given, output),
                resolved.axes.p_file(given)});
    for (Point3d& p : points)
      if (!is_on_a_map(p)) p.x = p.y = std::numeric_limits<double>::infinity();
  });
}

std::string detail_of(std::size_t lost, std::size_t all, const Point3d& first, const Crs& output) {
  return std::to_string(lost) + " of " + std::to_string(all) + " points of the relief: " + detail_of(first, output);
}

/// Projects the relief of a file. Points that have no place on the map are left out and reported together.
void project_relief(ResolvedSource& resolved, const Projection& projection, const Crs& output, Report& report) {
  std::vector<Point3d>& points = resolved.source.relief_points;
  const std::size_t all = points.size();
  std::optional<Point3d> first_lost;
  std::size_t kept = 0;
  for (const Point3d& given : points) {
    Point3d p = given;
    projection({&p, 1});
    if (is_on_a_map(p))
      points[kept++] = p;
    else if (!first_lost)
      first_lost = given;
  }
  points.resize(kept);
  if (first_lost)
    report.add({ProblemCode::outside_of_projection, resolved.source.source, "relief",
                detail_of(all - kept, all, *first_lost, output), resolved.axes.p_file(*first_lost)});
}

void project(ResolvedSource& resolved, const Crs& output, Report& report) {
  const Projection projection = make_projection(resolved.crs, output, resolved.typical);
  project_buildings(resolved, projection, output, report);
  project_relief(resolved, projection, output, report);
}

void append(std::vector<Point3d>& points, std::vector<Point3d>&& more) {
  if (points.empty())
    points = std::move(more);
  else
    points.insert(points.end(), more.begin(), more.end());
}

/// Adds the longitude and latitude to the problems from `known` on. Positions are in the output CRS.
void locate_problems(std::size_t known, const LocatedCity& located, const Crs& output, Report& report) {
  if (report.problems().size() == known || located.city.points().empty()) return;
  ProblemLocator locator(output, FileAxes{}, horizontal(located.city.points().front()));
  for (Problem& problem : report.since(known)) locator.locate(problem);
}

/// Leaves out facets that have no place on the map, and facets far from the city.
void leave_out_misplaced(LocatedCity& located, const Crs& output, Report& report) {
  const std::vector<MisplacedFacets> misplaced = find_misplaced(located.city);
  if (misplaced.empty()) return;
  const std::size_t known = report.problems().size();
  for (const MisplacedFacets& m : misplaced) {
    if (!std::isfinite(m.first_vertex.x)) continue;  // already reported by project_buildings
    const Building& b = located.city.buildings()[m.building];
    report.add({ProblemCode::far_away, located.sources[b.source], b.id, detail_of(m), m.first_vertex});
  }
  leave_out(located.city, misplaced);
  locate_problems(known, located, output, report);
}

/// Reports files whose buildings are implausible, and refuses a city that cannot be.
void report_doubts(const LocatedCity& located, const Crs& output, Report& report) {
  const std::size_t known = report.problems().size();
  const auto objection = report_implausible(located, report);
  plausibility::report_described_twice(located, report);
  locate_problems(known, located, output, report);
  if (objection) throw InputError(*objection);
}

/// Moves all points from the projected frame to the city frame. Its origin is the middle of the buildings, or of the relief if
/// there are no buildings.
void move_to_origin(LocatedCity& located, const Crs& output) {
  CityModel& city = located.city;
  const std::span<Point3d> relief(located.relief_points);
  Box2d box;
  const auto add = [&box](std::span<const Point3d> points) {
    for (const Point3d& p : points) box.add(horizontal(p));
  };
  if (city.points().empty()) add(relief);
  city.for_each_building([&](std::size_t, const Building& b) { add(city.points_of(b)); });
  located.georeference = georeference_around(0.5 * (box.low + box.high), output);
  const auto move = [origin_m = located.georeference.origin_m](std::span<Point3d> points) {
    for (Point3d& p : points) p = p - Point3d{origin_m.x, origin_m.y, 0.0};
  };
  move(relief);
  city.for_each_building([&](std::size_t, const Building& b) { move(city.points_of(b)); });
}

Crs output_of(const ResolvedSource& first, const std::string& wish, Report& report) {
  Crs output = choose_output_crs(first.crs, first.typical, wish);
  if (!wish.empty()) report_output(first.crs, output, first.typical, report);
  return output;
}

/// Heights that are taken in the unit of the map, for the first file: the tiles of a city are alike.
std::vector<std::string> notes_of_units(const std::vector<SourceCity>& sources, const std::vector<InputCrs>& inputs) {
  for (std::size_t n = 0; n < sources.size(); ++n) {
    if (sources[n].crs.heights_in_metres) continue;
    const Crs& crs = inputs[n].named.crs;
    const auto code = crs.epsg();
    const std::string example = code ? ", such as --crs EPSG:" + std::to_string(*code) + "+5703 (NAVD88 in metres)" : "";
    if (auto note = note_of_height_unit(sources[n].source, crs, "name a CRS with heights in metres" + example)) return {*note};
  }
  return {};
}

bool is_empty(const SourceCity& source) { return source.city.points().empty() && source.relief_points.empty(); }

}  // namespace

LocatedCity georeference(std::vector<SourceCity> sources, const GeoreferenceSettings& settings, Report& report) {
  std::erase_if(sources, is_empty);
  const std::vector<InputCrs> inputs = crs_of_inputs(sources, settings);
  LocatedCity located{.city = {}, .georeference = {}, .notes = notes_of_units(sources, inputs)};
  std::optional<Crs> output;
  std::string heights_of_model;
  for (std::size_t n = 0; n < sources.size(); ++n) {
    ResolvedSource resolved = resolve(std::move(sources[n]), inputs[n], report);
    if (!output) output = output_of(resolved, settings.out_crs, report);
    shift_heights(resolved, located.notes, heights_of_model, report);
    project(resolved, *output, report);
    locate_problems(resolved, report);
    resolved.source.city.set_source(static_cast<std::uint32_t>(located.sources.size()));
    located.sources.push_back(resolved.source.source);
    located.placed.push_back(std::move(resolved.source.placed));
    located.advice.push_back(resolved.source.advice);
    located.city.append(std::move(resolved.source.city));
    append(located.relief_points, std::move(resolved.source.relief_points));
  }
  if (output) leave_out_misplaced(located, *output, report);
  if (located.city.points().empty() && located.relief_points.empty())
    throw InputError("no building is left that could be put on the map: see the report for what is wrong with each");
  report_doubts(located, *output, report);
  move_to_origin(located, *output);
  located.georeference.heights_wkt = heights_of_model;
  return located;
}

}  // namespace farlod::georeference
