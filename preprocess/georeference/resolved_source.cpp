// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/resolved_source.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "georeference/crs.hpp"
#include "georeference/crs_area.hpp"
#include "georeference/source_coordinates.hpp"

namespace farlod::georeference {
namespace {

/// The model of a site has its own origin, and no coordinate as large as this.
constexpr double largest_site_m = 20'000.0;
/// The sizes between which most buildings are. The largest ones are factories and airports.
constexpr double largest_building_m = 2'000.0, smallest_building_m = 1.0;

/// A unit, and its name in the plural.
using CountedUnit = std::pair<LengthUnit, const char*>;

const std::array<CountedUnit, 6>& units_of_files() {
  static const std::array<CountedUnit, 6> units{{{us_survey_foot, "US survey feet"},
                                                 {foot, "feet"},
                                                 {metre, "metres"},
                                                 {{"kilometre", 1e3, "9036", " (km)"}, "kilometres"},
                                                 {{"millimetre", 1e-3, "1025", " (mm)"}, "millimetres"},
                                                 {{"centimetre", 1e-2, "1033", " (cm)"}, "centimetres"}}};
  return units;
}

bool is_of_a_site(const Crs& crs, Point2d p_map) {
  return crs.is_projected() && crs.area_of_use() &&
         std::max(std::abs(p_map.x), std::abs(p_map.y)) * crs.unit() < largest_site_m && !lies_in_area_of_use(crs, p_map);
}

/// Whether the place and the buildings of the file would be plausible if it counted in this unit.
bool would_fit(const LengthUnit& unit, const Crs& crs, Point2d p_map, std::optional<double> building_extent) {
  constexpr double like_the_same = 1e-3;  // the two kinds of feet differ by less
  const double factor = unit.metres / crs.unit();
  if (std::abs(factor - 1.0) < like_the_same) return false;
  const double building_m = building_extent.value_or(smallest_building_m / unit.metres) * unit.metres;
  return smallest_building_m <= building_m && building_m <= largest_building_m && lies_in_area_of_use(crs, factor * p_map);
}

/// A unit that would make the place plausible, preferably one for which the register has the CRS in that unit.
std::optional<std::string> unit_that_fits(const Crs& crs, Point2d p_map, std::optional<double> building_extent) {
  std::optional<std::string> without_twin;
  for (const auto& [unit, many] : units_of_files()) {
    if (!would_fit(unit, crs, p_map, building_extent)) continue;
    const std::string counted = std::string("counted in ") + many + " it would lie within";
    if (const auto twin = crs.counted_in(unit).epsg()) return counted + ": was --crs EPSG:" + std::to_string(*twin) + " meant?";
    if (!without_twin) without_twin = counted;
  }
  return without_twin;
}

std::string explanation(const Crs& crs, Point2d p_map, std::optional<double> building_extent) {
  if (crs.is_projected())
    if (auto unit = unit_that_fits(crs, p_map, building_extent)) return *unit;
  if (is_of_a_site(crs, p_map)) return "it looks like a model of a site: --origin X,Y puts an OBJ file on the map";
  return "is it the right CRS? --crs EPSG:n names another";
}

/// A text that the file does not lie in the area of use of its CRS, or that its buildings are too large, with a possible reason:
/// another unit, or a model of a site without a place on the map. Empty when the place is plausible. `p_map`: the typical place,
/// easting or longitude first.
std::optional<std::string> doubt_about_place(const Crs& crs, Point2d p_map, std::optional<double> building_extent) {
  const double building_m = crs.is_projected() ? building_extent.value_or(0.0) * crs.unit() : 0.0;
  const bool elsewhere = !may_be_used_at(crs, p_map) || is_of_a_site(crs, p_map);
  if (!elsewhere && building_m <= largest_building_m) return std::nullopt;
  std::ostringstream text;
  text.precision(10);
  text << "the file lies at " << p_map.x << ", " << p_map.y;
  if (elsewhere) text << ", where " << crs.name() << " is not meant to be used";
  if (building_m > largest_building_m) text << ", and its buildings are " << std::round(building_m) << " m wide";
  text << ": " << explanation(crs, p_map, building_extent);
  return text.str();
}

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
