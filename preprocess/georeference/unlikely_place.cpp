// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/unlikely_place.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include "georeference/crs_area.hpp"

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

}  // namespace

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

}  // namespace farlod::georeference
