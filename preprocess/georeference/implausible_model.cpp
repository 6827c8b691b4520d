// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/implausible_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "farlod/box.hpp"

namespace farlod::georeference {
namespace {

/// The highest building is Burj Khalifa, 828 m; the Jeddah Tower will pass 1,000 m.
constexpr double highest_building_m = 1'200.0;
/// Roof area times height. Boeing's factory in Everett has 0.014 km³, Beijing's airport terminal below 0.04 km³, and Burj Khalifa
/// with its podium below 0.1 km³. Bridges and city walls of many kilometres have less roof.
constexpr double largest_building_m3 = 0.5e9;
/// No town, and no group of ten towers, has such a typical height.
constexpr double highest_median_m = 400.0;
constexpr double smallest_median_m = 1.0;
constexpr std::size_t enough_for_median = 10;
/// Ground that climbs by so much, over so little of the longer side, and a multiple of the shorter side. Steep towns climb by a
/// tenth of the longer side.
constexpr double least_climb_m = 200.0, steepest_town = 0.3, least_climb_to_shorter_side = 3.0;

struct BuildingSize {
  Box2d box;
  double base_m = std::numeric_limits<double>::infinity(), top_m = -std::numeric_limits<double>::infinity();
  double roof_m2 = 0.0;
  std::optional<Point3d> highest;

  [[nodiscard]] double height_m() const { return top_m - base_m; }
  [[nodiscard]] double side_m() const { return std::max(box.high.x - box.low.x, box.high.y - box.low.y); }
  [[nodiscard]] bool is_too_large() const {
    return height_m() > highest_building_m || roof_m2 * height_m() > largest_building_m3;
  }
};

/// Twice the area of a ring in the plan, whichever way it runs.
double twice_plan_area(std::span<const Point3d> ring) {
  double sum = 0.0;
  for (std::size_t k = 2; k < ring.size(); ++k) {
    const Point3d a = ring[k - 1] - ring[0], b = ring[k] - ring[0];
    sum += a.x * b.y - a.y * b.x;
  }
  return std::abs(sum);
}

BuildingSize size_of(const CityModel& city, const Building& building) {
  BuildingSize size;
  for (const Point3d& p : city.points_of(building)) {
    size.box.add(horizontal(p));
    size.base_m = std::min(size.base_m, p.z);
    if (p.z > size.top_m) size.highest = p;
    size.top_m = std::max(size.top_m, p.z);
  }
  // A roof without an elevation of its foot reaches down to nowhere yet
  if (building.height_reference == HeightReference::down_to_ground) size.base_m = size.top_m;
  double twice_m2 = 0.0;
  for (const Facet& facet : city.facets_of(building)) twice_m2 += twice_plan_area(city.ring(facet, 0));
  size.roof_m2 = 0.25 * twice_m2;  // what is above has a floor below
  return size;
}

/// The value below which a share of all values lies.
double quantile(std::vector<double> values, double share) {
  const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

/// What of a file's buildings is looked at together.
struct FileSizes {
  std::vector<double> heights_m, sides_m, extents_m, bases_m, x_m, y_m;
  std::size_t too_large = 0;
  std::string largest;  ///< the id of the building that is most beyond the limits
  BuildingSize largest_size;

  void add(const std::string& id, const BuildingSize& size) {
    heights_m.push_back(size.height_m());
    sides_m.push_back(size.side_m());
    extents_m.push_back(std::max(size.height_m(), size.side_m()));
    bases_m.push_back(size.base_m);
    x_m.push_back(0.5 * (size.box.low.x + size.box.high.x));
    y_m.push_back(0.5 * (size.box.low.y + size.box.high.y));
    too_large += size.is_too_large() ? 1 : 0;
    const auto rank = [](const BuildingSize& s) { return std::pair(s.is_too_large(), s.height_m()); };
    if (largest_size.highest && rank(size) <= rank(largest_size)) return;
    largest = id;
    largest_size = size;
  }
};

std::string metres_of(double length_m) {
  std::ostringstream text;
  text.precision(length_m < 10.0 ? 2 : 6);
  text << (length_m < 10.0 ? length_m : std::round(length_m)) << " m";
  return text.str();
}

struct Unit {
  const char* name;
  double metres;
};
constexpr std::array units{Unit{"millimetres", 1e-3}, Unit{"centimetres", 1e-2}, Unit{"inches", 0.0254},
                           Unit{"feet", 0.3048},      Unit{"kilometres", 1e3},   Unit{"hundreds of metres", 1e2}};

bool is_usual_height(double m) { return 2.0 <= m && m <= 100.0; }
bool is_usual_side(double m) { return 3.0 <= m && m <= 300.0; }

/// A unit in which a typical building would be of a usual size.
std::string explanation_of_size(double side_m, double height_m) {
  for (const Unit& unit : units) {
    if (!is_usual_height(unit.metres * height_m)) continue;
    const std::string in_unit = std::string("in ") + unit.name;
    if (is_usual_side(unit.metres * side_m))
      return "counted " + in_unit + ", a typical one would be " + metres_of(unit.metres * side_m) + " wide and " +
             metres_of(unit.metres * height_m) + " high: are these its units?";
    if (is_usual_side(side_m))
      return "are heights " + in_unit + "? A typical one would be " + metres_of(unit.metres * height_m) + " high";
  }
  return "what is the unit of the coordinates, and is each vertex right?";
}

std::string hint_of_format(std::string_view source) {
  if (source.ends_with(".json") || source.ends_with(".jsonl") || source.ends_with(".cityjson"))
    return " CityJSON multiplies its vertices by \"transform\", which may be missing.";
  if (source.ends_with(".obj")) return " OBJ is read in metres: scale it where it is exported.";
  return " Convert it to metres where it is exported, or name the CRS that counts in its unit.";
}

std::optional<std::string> doubt_about_size(const FileSizes& sizes, std::string_view source) {
  const std::size_t count = sizes.heights_m.size();
  const double height_m = quantile(sizes.heights_m, 0.5), side_m = quantile(sizes.sides_m, 0.5);
  const bool is_tiny = quantile(sizes.extents_m, 0.5) < smallest_median_m;
  const bool is_high = count >= enough_for_median && height_m > highest_median_m;
  if (sizes.too_large == 0 && !is_tiny && !is_high) return std::nullopt;
  const std::string all = std::to_string(count) + (count == 1 ? " building" : " buildings");
  if (!is_tiny && !is_high && 2 * sizes.too_large < count)
    return std::to_string(sizes.too_large) + " of " + all + " are larger than any on Earth, such as " + sizes.largest + ", " +
           metres_of(sizes.largest_size.height_m()) + " high and " + metres_of(sizes.largest_size.side_m()) +
           " wide: is one of its vertices wrong, or is it no building?";
  return "of " + all + ", a typical one is " + metres_of(side_m) + " wide and " + metres_of(height_m) + " high, the highest, " +
         sizes.largest + ", " + metres_of(sizes.largest_size.height_m()) + ": " + explanation_of_size(side_m, height_m) +
         hint_of_format(source);
}

double spread(const std::vector<double>& values) {
  constexpr double tail = 0.05;
  return quantile(values, 1.0 - tail) - quantile(values, tail);
}

std::optional<std::string> doubt_about_up(const FileSizes& sizes, std::string_view source) {
  if (sizes.bases_m.size() < enough_for_median) return std::nullopt;
  const double climb_m = spread(sizes.bases_m), x_m = spread(sizes.x_m), y_m = spread(sizes.y_m);
  const bool is_steep = climb_m >= least_climb_m && climb_m >= steepest_town * std::max(x_m, y_m) &&
                        climb_m >= least_climb_to_shorter_side * std::min(x_m, y_m);
  if (!is_steep) return std::nullopt;
  const bool is_obj = source.ends_with(".obj");
  return "its buildings stand at heights that differ by " + metres_of(climb_m) + ", on ground of " +
         metres_of(std::max(x_m, y_m)) + " by " + metres_of(std::min(x_m, y_m)) + ": the model seems to lie on its side. " +
         (is_obj ? "Give --up y, or --up z if that is given." : "Export it with z as the upward axis.");
}

}  // namespace

void report_implausible(const LocatedCity& located, Report& report) {
  std::vector<FileSizes> files(located.sources.size());
  const CityModel& city = located.city;
  city.for_each_building([&](std::size_t, const Building& b) {
    if (const BuildingSize size = size_of(city, b); size.highest) files[b.source].add(b.id, size);
  });
  for (std::size_t n = 0; n < files.size(); ++n) {
    if (files[n].heights_m.empty()) continue;
    const std::string& source = located.sources[n];
    const auto add = [&](ProblemCode code, const std::string& detail) {
      report.add({code, source, "the whole file", detail, files[n].largest_size.highest});
    };
    if (const auto doubt = doubt_about_size(files[n], source)) add(ProblemCode::implausible_size, *doubt);
    if (const auto doubt = doubt_about_up(files[n], source)) add(ProblemCode::lies_on_its_side, *doubt);
  }
}

}  // namespace farlod::georeference
