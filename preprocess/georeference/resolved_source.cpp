// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/resolved_source.hpp"

#include <span>
#include <sstream>
#include <utility>

#include "georeference/source_coordinates.hpp"
#include "georeference/unlikely_place.hpp"

namespace farlod::georeference {
namespace {

/// Reports problems of a whole file.
class FileReport {
 public:
  FileReport(const SourceCity& source, const TypicalPlace& typical, Report& report)
      : source_(source), typical_(typical), report_(report) {}

  void add(ProblemCode code, const std::string& detail) {
    report_.add({code, source_.source, "the whole file", detail, typical_.place});
  }

 private:
  const SourceCity& source_;
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

}  // namespace

ResolvedSource resolve(SourceCity source, const InputCrs& given, Report& report) {
  const TypicalPlace typical = typical_place(source);
  const InputCrs input = resolved_crs(given, typical);
  const Crs& crs = input.named.crs;
  const bool longitude_first = source.crs.longitude_first || input.named.longitude_first;
  FileReport of_file(source, typical, report);
  if (input.problem) of_file.add(*input.problem, input.detail);
  check_units(source, typical, crs, "name the CRS that they are in, in the file or with --crs EPSG:n");
  FileAxes axes = find_axes(horizontal(typical.place), crs, longitude_first);
  axes.height_unit_m = source.crs.heights_in_metres ? 1.0 : crs.height_unit_m();
  if (is_swapped(axes, crs, longitude_first)) of_file.add(ProblemCode::axes_swapped, detail_of_swap(axes, crs, typical.place));
  if (axes.before_easting != 0.0) of_file.add(ProblemCode::zone_in_easting, detail_of_zone(axes, crs, typical.place));
  const Point2d place = horizontal(axes.p_map(typical.place));
  if (const auto doubt = doubt_about_place(crs, place, typical.building_extent)) of_file.add(ProblemCode::unlikely_place, *doubt);
  if (axes != FileAxes{}) normalize_points(source, axes);
  return {std::move(source), crs, place, axes};
}

}  // namespace farlod::georeference
