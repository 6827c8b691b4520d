// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/doubtful_place.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>

#include "georeference/place_on_earth.hpp"
#include "plausibility/right_angles.hpp"

namespace farlod::georeference {

bool lies_in_area_of_use(const Crs& crs, Point2d p) {
  const auto place = crs.lon_lat_deg(p);
  const auto area = crs.area_of_use();
  return place && (area ? area->contains(*place) : !crs.is_projected());
}

bool may_be_used_at(const Crs& crs, Point2d p) {
  // Areas of use are bounding boxes of countries and zones. Towns at the border of a zone extend beyond it
  constexpr double country_margin_deg = 0.25, least_margin_deg = 1.0;
  const auto area = crs.area_of_use();
  if (!area && crs.is_projected()) return true;
  const auto place = crs.lon_lat_deg(p);
  const double zone_deg = crs.zone_width_deg();
  const double margin_deg = crs.is_projected() && zone_deg == 0.0 ? country_margin_deg : least_margin_deg;
  return place && (!area || area->contains(*place, std::max(margin_deg, zone_deg), margin_deg));
}

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
  if (is_of_a_site(crs, p_map)) return "it looks like a model of a site: give it its place (--origin X,Y of a mesh)";
  return "is it the right CRS? --crs EPSG:n names another";
}

/// " (57.59° N, 9.10° E)" for a place of a map.
std::string in_degrees(const Crs& crs, Point2d p_map) {
  const auto place = crs.is_projected() ? crs.lon_lat_deg(p_map) : std::nullopt;
  if (!place || std::abs(place->x) > 180.0 || std::abs(place->y) > 90.0) return "";
  return " (" + degrees_text(*place) + ")";
}

/// "SWEREF99 TM (Sweden)".
std::string with_country(const Crs& crs) {
  const std::string country = country_in(crs.area_name());
  return crs.name() + (country.empty() ? "" : " (" + country + ")");
}

}  // namespace

std::optional<std::string> doubt_about_place(const Crs& crs, Point2d p_map, std::optional<double> building_extent) {
  const double building_m = crs.is_projected() ? building_extent.value_or(0.0) * crs.unit() : 0.0;
  const bool elsewhere = !may_be_used_at(crs, p_map) || is_of_a_site(crs, p_map);
  if (!elsewhere && building_m <= largest_building_m) return std::nullopt;
  std::ostringstream text;
  text.precision(10);
  text << "the file lies at " << p_map.x << ", " << p_map.y << (elsewhere ? in_degrees(crs, p_map) : "");
  if (elsewhere) text << ", where " << with_country(crs) << " is not meant to be used";
  if (building_m > largest_building_m) text << ", and its buildings are " << std::round(building_m) << " m wide";
  text << ": " << explanation(crs, p_map, building_extent);
  return text.str();
}

std::optional<std::string> doubt_beside_own(const Crs& given, Point2d p_given, const Crs& own, Point2d p_own) {
  constexpr double same_town_deg = 0.1;
  if (!given.area_of_use() || lies_in_area_of_use(given, p_given) || !lies_in_area_of_use(own, p_own)) return std::nullopt;
  const auto there = given.lon_lat_deg(p_given), here = own.lon_lat_deg(p_own);
  if (there && here && norm(*there - *here) < same_town_deg) return std::nullopt;
  std::ostringstream text;
  text.precision(10);
  text << "the file lies at " << p_given.x << ", " << p_given.y << in_degrees(given, p_given) << ", where " << with_country(given)
       << " is not meant to be used, and its own CRS, " << with_country(own) << ", is meant for its place"
       << in_degrees(own, p_own) << ": leave --crs out, and give the CRS that the package is to have with --out-crs";
  return text.str();
}

std::optional<std::string> doubt_about_order(const SourceCity& source, Point2d lon_lat_deg, bool latitude_first) {
  constexpr double pole_deg = 90.0;
  if (std::abs(lon_lat_deg.x) >= pole_deg) return std::nullopt;
  const plausibility::RightAngles angles = plausibility::right_angles_of(source.city);
  if (!angles.speak_for_exchange()) return std::nullopt;
  std::ostringstream text;
  text << "the file lies at " << degrees_text(lon_lat_deg) << ", where " << angles.as_read << " of " << angles.corners
       << " corners of its buildings are right angles; at " << degrees_text({lon_lat_deg.y, lon_lat_deg.x}) << " "
       << angles.exchanged << " are: its latitudes and longitudes are exchanged; ";
  if (source.crs.longitude_first)
    text << "ogr2ogr -ct \"+proj=axisswap +order=2,1\" NEW FILE exchanges them back";
  else
    text << (latitude_first ? "--crs OGC:CRS84 reads the longitude first" : "--crs EPSG:4326 reads the latitude first");
  return text.str();
}

}  // namespace farlod::georeference
