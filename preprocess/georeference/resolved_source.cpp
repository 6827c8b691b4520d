// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/resolved_source.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/expects.hpp"
#include "farlod/box.hpp"
#include "farlod/error.hpp"
#include "georeference/doubtful_place.hpp"

namespace farlod::georeference {
namespace {

/// Larger than all coordinates of maps of the Earth, including eastings that begin with a zone number.
constexpr double beyond_all_maps_m = 1e8;

void project_to_utm(std::span<Point3d> points, const UtmProjection& utm) {
  for (Point3d& p : points) {
    constexpr double nowhere = std::numeric_limits<double>::infinity();
    const Point2d there = utm.projected(horizontal(p)).value_or(Point2d{nowhere, nowhere});
    p = {there.x, there.y, p.z};
  }
}

}  // namespace

Projection make_projection(const Crs& from, const Crs& to, Point2d typical) {
  // Coordinates in the output CRS stay the same, to the last bit
  if (from.equals(to)) return [](std::span<Point3d>) {};
  // Between two units of the same projection, coordinates differ by a factor
  if (from.is_projected() && from.unit() != 1.0 && from.counted_in(metre).equals(to))
    return [unit_m = from.unit()](std::span<Point3d> points) {
      for (Point3d& p : points) p = {unit_m * p.x, unit_m * p.y, p.z};
    };
  // UTM on the same datum is a formula without a datum shift
  if (const auto zone = to.utm_zone(); zone && from.is_in_degrees_from_greenwich() && to.geographic().equals(from))
    return [utm = UtmProjection(*zone, to.ellipsoid())](std::span<Point3d> points) { project_to_utm(points, utm); };
  return [way = CrsTransformation(from, to, typical)](std::span<Point3d> points) { way.apply(points); };
}

bool is_on_a_map(const Point3d& p) { return std::abs(p.x) < beyond_all_maps_m && std::abs(p.y) < beyond_all_maps_m; }

namespace {

bool is_on_earth(Point2d lon_lat_deg) { return std::abs(lon_lat_deg.x) <= 180.0 && std::abs(lon_lat_deg.y) <= 90.0; }

CrsTransformation make_transformation(const Crs& crs, Point2d typical) {
  const auto wgs84 = Crs::find("EPSG:4326");
  FARLOD_EXPECTS(wgs84.has_value());
  return {crs, *wgs84, typical};
}

}  // namespace

void ProblemLocator::locate(Problem& problem) {
  if (!problem.position) return;
  if (!lon_lat_from_crs_) lon_lat_from_crs_ = make_transformation(crs_, typical_);
  const auto lon_lat_deg = lon_lat_from_crs_->apply(horizontal(axes_.p_map(*problem.position)));
  if (lon_lat_deg && is_on_earth(*lon_lat_deg)) problem.lon_lat_deg = lon_lat_deg;
}

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

/// The typical coordinates of a file, which a few stray buildings do not change. In the units and axes of the file.
struct TypicalPlace {
  /// The median, by axis, of the first vertices of the buildings; without buildings, of the points of the relief.
  Point3d place;
  std::optional<double> building_extent;  ///< median of the larger side of the bounding rectangles of the buildings
  /// The median of the larger side of the facets; without facets, of the distances between consecutive points of the relief. It
  /// tells metres from degrees. Facets are used, since one stray facet can make a building as large as the Earth.
  std::optional<double> grain;
};

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

/// The source must have at least one point.
TypicalPlace typical_place(const SourceCity& source) {
  if (!source.city.points().empty()) return typical_of_buildings(source.city);
  FARLOD_EXPECTS(!source.relief_points.empty());
  return typical_of_relief(source.relief_points);
}

/// The order of the axes by definition: that of the authority, or easting first if the name or the format requires
/// `longitude_first`.
AxisOrder stated_order(const Crs& crs, bool longitude_first) {
  return crs.northing_first() && !longitude_first ? AxisOrder::northing_first : AxisOrder::easting_first;
}

/// The axes of the file, without the unit of heights.
///   (1) degrees are in the stated order; projected coordinates have the easting first, as in CityGML and CityJSON files, even if
///       the authority has the other order
///   (2) if the CRS cannot be used at that place, another order or a zone number before the easting is assumed, provided that the
///       place then lies in the area of use
FileAxes find_axes(Point2d typical_place, const Crs& crs, bool longitude_first) {
  const FileAxes usual{crs.is_projected() ? AxisOrder::easting_first : stated_order(crs, longitude_first)};
  if (may_be_used_at(crs, on_map(usual, typical_place))) return usual;
  for (const AxisOrder order : {usual.order, other(usual.order)})
    for (const FileAxes axes : {FileAxes{order}, FileAxes{order, zone_before_easting(crs)}})
      if (lies_in_area_of_use(crs, on_map(axes, typical_place))) return axes;
  return usual;
}

/// Whether the coordinates can be in a CRS: those of a geographic CRS look like degrees, those of a projected one do not.
bool may_count_in(const TypicalPlace& typical, const Crs& crs) {
  if (!typical.grain) return true;
  const bool looks_like_degrees = may_be_lon_lat(horizontal(typical.place)) && *typical.grain < between_degrees_and_metres;
  return crs.is_projected() == !looks_like_degrees;
}

/// Throws InputError if the coordinates cannot be in the CRS (may_count_in). `advice` ends the message.
void check_units(const std::string& source, const TypicalPlace& typical, const Crs& crs, const std::string& advice) {
  if (may_count_in(typical, crs)) return;
  const std::string end = " (" + place_text(horizontal(typical.place)) + "): " + advice;
  if (crs.is_projected())
    throw InputError(source + ": its CRS " + crs.name() + " is projected, but its coordinates look like degrees" + end);
  throw InputError(source + ": its CRS " + crs.name() + " counts in degrees, but its coordinates cannot be degrees" + end);
}

constexpr const char* how_to_name_crs = "name the CRS that they are in, in the file or with --crs EPSG:n";

/// Reports problems of a whole file.
class FileReport {
 public:
  FileReport(const std::string& source, const TypicalPlace& typical, Report& report)
      : source_(source), typical_(typical), report_(report) {}

  void add(ProblemCode code, const std::string& detail) {
    report_.add({code, source_, "the whole file", detail, typical_.place});
  }

 private:
  const std::string source_;
  const TypicalPlace& typical_;
  Report& report_;
};

std::string text_of(const Point3d& place) {
  std::ostringstream text;
  text.precision(10);
  text << place.x << ", " << place.y;
  return text.str();
}

/// Whether the order of the file is an error. It is not if it is the order of the authority. Projected coordinates with the
/// easting first are not an error either, since most files have that order.
bool is_swapped(const FileAxes& axes, const Crs& crs, bool longitude_first) {
  const bool as_stated = axes.order == stated_order(crs, longitude_first);
  return !as_stated && (axes.order == AxisOrder::northing_first || !crs.is_projected());
}

std::string detail_of_swap(const FileAxes& axes, const Crs& crs, const Point3d& place) {
  const char* of_degrees = axes.order == AxisOrder::northing_first ? "latitude" : "longitude";
  const std::string order = crs.is_projected() ? "northing" : of_degrees;
  return "coordinates such as " + text_of(place) + " are taken " + order + " first: in the other order they do not lie where " +
         crs.name() + " is meant to be used";
}

std::string detail_of_zone(const FileAxes& axes, const Crs& crs, const Point3d& place) {
  std::ostringstream text;
  text.precision(12);
  const Point3d p = axes.p_map(place);
  text << "an easting such as " << p.x + axes.before_easting << " begins with the zone of " << crs.name() << ": " << p.x
       << " is taken";
  return text.str();
}

void normalize_points(std::span<Point3d> points, const FileAxes& axes) {
  for (Point3d& p : points) p = axes.p_map(p);
}

void normalize_points(SourceCity& source, const FileAxes& axes) {
  CityModel& city = source.city;
  city.for_each_building([&](std::size_t, const Building& b) { normalize_points(city.points_of(b), axes); });
  normalize_points(source.relief_points, axes);
}

/// The CRS of --crs, unless the coordinates can be in the CRS of the file and cannot be in that of --crs.
InputCrs resolved_crs(const InputCrs& input, const TypicalPlace& typical) {
  if (!input.own || may_count_in(typical, input.named.crs) || !may_count_in(typical, input.own->named.crs)) return input;
  return {input.own->named, input.problem, input.own->detail};
}

/// By the place alone, else by the angles of its buildings, else by its place in the CRS of the file that --crs overruled.
std::optional<std::string> doubt_about(const InputCrs& input, Point2d place, const TypicalPlace& typical,
                                       const SourceCity& source, const FileAxes& axes) {
  const Crs& crs = input.named.crs;
  if (auto doubt = doubt_about_place(crs, place, typical.building_extent)) return doubt;
  if (crs.is_in_degrees_from_greenwich())
    if (auto doubt = doubt_about_order(source, place, axes.order == AxisOrder::northing_first)) return doubt;
  if (!input.own) return std::nullopt;
  const NamedCrs& own = input.own->named;
  const FileAxes own_axes = find_axes(horizontal(typical.place), own.crs, source.crs.longitude_first || own.longitude_first);
  return doubt_beside_own(crs, place, own.crs, horizontal(own_axes.p_map(typical.place)));
}

}  // namespace

ResolvedSource resolve(SourceCity source, const InputCrs& given, Report& report) {
  const TypicalPlace typical = typical_place(source);
  const InputCrs input = resolved_crs(given, typical);
  const Crs& crs = input.named.crs;
  const bool longitude_first = source.crs.longitude_first || input.named.longitude_first;
  FileReport of_file(source.source, typical, report);
  if (input.problem) of_file.add(*input.problem, input.detail);
  check_units(source.source, typical, crs, how_to_name_crs);
  FileAxes axes = find_axes(horizontal(typical.place), crs, longitude_first);
  axes.height_unit_m = source.crs.heights_in_metres ? 1.0 : crs.height_unit_m();
  if (is_swapped(axes, crs, longitude_first)) of_file.add(ProblemCode::axes_swapped, detail_of_swap(axes, crs, typical.place));
  if (axes.before_easting != 0.0) of_file.add(ProblemCode::zone_in_easting, detail_of_zone(axes, crs, typical.place));
  const Point2d place = horizontal(axes.p_map(typical.place));
  if (axes != FileAxes{}) normalize_points(source, axes);
  if (const auto doubt = doubt_about(input, place, typical, source, axes)) of_file.add(ProblemCode::unlikely_place, *doubt);
  return {std::move(source), crs, place, axes};
}

void report_place(const std::string& raster, const Crs& crs, Point2d middle, Point2d beside, Report& report) {
  constexpr double least_pixel_m = 0.01, most_pixel_m = 10e3;
  const double pixel = norm(beside - middle);
  const TypicalPlace typical{{middle.x, middle.y, 0.0}, std::nullopt, pixel};
  check_units(raster, typical, crs, how_to_name_crs);
  FileReport of_file(raster, typical, report);
  if (const auto doubt = doubt_about_place(crs, middle, std::nullopt)) of_file.add(ProblemCode::unlikely_place, *doubt);
  const double pixel_m = pixel * (crs.is_projected() ? crs.unit() : metres_in_a_degree);
  if (least_pixel_m <= pixel_m && pixel_m <= most_pixel_m) return;
  std::ostringstream text;
  text << "its pixels are " << pixel_m << " m wide: is its CRS, or the size of its pixels, in another unit?";
  of_file.add(ProblemCode::implausible_size, std::move(text).str());
}

bool is_overruled(const std::string& raster, const InputCrs& given, Point2d middle, double pixel, Report& report) {
  const TypicalPlace typical{{middle.x, middle.y, 0.0}, std::nullopt, pixel};
  const InputCrs input = resolved_crs(given, typical);
  FileReport of_file(raster, typical, report);
  if (input.problem) of_file.add(*input.problem, input.detail);
  if (!input.own) return false;
  // What is far outside of the area of --crs is told when the raster is read
  const Crs& crs = input.named.crs;
  const auto doubt =
      doubt_about_place(crs, middle, std::nullopt) ? std::nullopt : doubt_beside_own(crs, middle, input.own->named.crs, middle);
  if (doubt) of_file.add(ProblemCode::unlikely_place, *doubt);
  return true;
}

void report_whole_file(ProblemCode code, const std::string& file, std::string detail, const Point3d& p_city,
                       const Georeference& georeference, Report& report) {
  const Point2d& origin_m = georeference.origin_m;
  Problem problem{code, file, "the whole file", std::move(detail), p_city + Point3d{origin_m.x, origin_m.y, 0.0}};
  const auto output = Crs::find(georeference.crs_wkt);
  FARLOD_EXPECTS(output.has_value());
  ProblemLocator(*output, FileAxes{}, origin_m).locate(problem);
  report.add(std::move(problem));
}

void report_surface(const std::string& file, const plausibility::SurfaceShape& shape_city, const Georeference& georeference,
                    Report& report) {
  if (auto doubt = plausibility::doubt_about_surface(shape_city))
    report_whole_file(ProblemCode::implausible_size, file, std::move(*doubt), *shape_city.highest, georeference, report);
}

void report_output(const Crs& input, const Crs& output, Point2d typical, Report& report) {
  if (!may_be_used_at(input, typical)) return;
  const auto p = CrsTransformation(input, output, typical).apply(typical);
  if (!p || may_be_used_at(output, *p)) return;
  report.add({ProblemCode::unlikely_place, "", "whole city",
              "the city lies at " + place_text(*p) + ", where the CRS of --out-crs, " + output.name() +
                  ", is not meant to be used: give one of its region, or leave the option out",
              Point3d{p->x, p->y, 0.0}});
}

}  // namespace farlod::georeference
