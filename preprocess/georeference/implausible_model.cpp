// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/implausible_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "farlod/box.hpp"

namespace farlod::georeference {
namespace {

/// A distant cluster of at most so many buildings is an error of the data. A larger one is a town.
constexpr std::size_t most_stray_buildings = 10;

using Square = std::pair<std::int64_t, std::int64_t>;

bool is_somewhere(const Point3d& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

Square square_of(const Point3d& p) {
  return {static_cast<std::int64_t>(std::floor(p.x / city_square_m)), static_cast<std::int64_t>(std::floor(p.y / city_square_m))};
}

/// The outer ring of a facet, which is its place.
std::span<const Point3d> outline_of(const CityModel& city, const Facet& facet) { return city.ring(facet, 0); }

bool is_broken(std::span<const Point3d> outline) {
  Box2d box;
  for (const Point3d& p : outline) {
    if (!is_somewhere(p)) return true;
    box.add(horizontal(p));
  }
  return box.high.x - box.low.x > city_square_m || box.high.y - box.low.y > city_square_m;
}

/// The facets and buildings in a square, or in a cluster of squares that touch.
struct Contents {
  std::size_t facets = 0;
  std::set<std::size_t> buildings;  ///< at most one more than most_stray_buildings

  void add(std::size_t building, std::size_t count) {
    facets += count;
    if (buildings.size() <= most_stray_buildings) buildings.insert(building);
  }
  void add(const Contents& other) {
    facets += other.facets;
    for (const std::size_t b : other.buildings) add(b, 0);
  }
};

struct Cluster {
  std::vector<Square> squares;
  Contents contents;
};

std::map<Square, Contents> fill_squares(const CityModel& city) {
  std::map<Square, Contents> squares;
  auto last = squares.end();  // nearly all facets lie in the square of the one before
  city.for_each_building([&](std::size_t n, const Building& b) {
    for (const Facet& facet : city.facets_of(b)) {
      const auto outline = outline_of(city, facet);
      if (is_broken(outline)) continue;
      const Square square = square_of(outline.front());
      if (last == squares.end() || last->first != square) last = squares.try_emplace(square).first;
      last->second.add(n, 1);
    }
  });
  return squares;
}

/// Removes the first square and all squares that are connected with it, and returns them.
Cluster take_cluster(std::map<Square, Contents>& squares) {
  Cluster cluster;
  std::vector<Square> waiting{squares.begin()->first};
  while (!waiting.empty()) {
    const auto found = squares.find(waiting.back());
    waiting.pop_back();
    if (found == squares.end()) continue;
    const Square square = found->first;
    cluster.contents.add(found->second);
    cluster.squares.push_back(square);
    squares.erase(found);
    for (std::int64_t i = -1; i <= 1; ++i)
      for (std::int64_t j = -1; j <= 1; ++j) waiting.emplace_back(square.first + i, square.second + j);
  }
  return cluster;
}

/// The squares of the city and those around them.
std::set<Square> squares_of_city(const CityModel& city) {
  std::map<Square, Contents> squares = fill_squares(city);
  std::vector<Cluster> clusters;
  while (!squares.empty()) clusters.push_back(take_cluster(squares));
  std::size_t most_facets = 0;
  for (const Cluster& c : clusters) most_facets = std::max(most_facets, c.contents.facets);
  std::set<Square> of_city;
  for (const Cluster& c : clusters)
    if (c.contents.buildings.size() > most_stray_buildings || 2 * c.contents.facets > most_facets)
      for (const Square& s : c.squares)
        for (std::int64_t i = -1; i <= 1; ++i)
          for (std::int64_t j = -1; j <= 1; ++j) of_city.emplace(s.first + i, s.second + j);
  return of_city;
}

class MisplacementFinder {
 public:
  explicit MisplacementFinder(const CityModel& city) : city_(city), squares_(squares_of_city(city)) {}

  std::optional<MisplacedFacets> look_at(std::size_t row) const {
    const Building& building = city_.buildings()[row];
    if (is_in_one_square(city_.points_of(building))) return std::nullopt;
    MisplacedFacets found{row, {}, false, {}};
    for (std::uint64_t f = building.first_facet; f < building.first_facet + building.facet_count; ++f) {
      const auto outline = outline_of(city_, city_.facets()[f]);
      const auto stray = std::find_if(outline.begin(), outline.end(), [this](const Point3d& p) { return !is_in_city(p); });
      const bool broken = is_broken(outline);
      if (!broken && stray == outline.end()) continue;
      if (found.facets.empty()) found.first_vertex = stray == outline.end() ? outline.front() : *stray;
      found.facets.push_back(f);
      found.all_of_it |= std::any_of(outline.begin(), outline.end(), [this](const Point3d& p) { return is_in_city(p); });
    }
    if (found.facets.empty()) return std::nullopt;
    found.all_of_it |= found.facets.size() == building.facet_count;
    if (found.all_of_it) take_all(building, found);
    return found;
  }

 private:
  static void take_all(const Building& building, MisplacedFacets& found) {
    found.facets.resize(building.facet_count);
    std::iota(found.facets.begin(), found.facets.end(), building.first_facet);
  }

  /// True for nearly all buildings: all points lie in one square of the city, so that no outline is broken and none is a stray.
  bool is_in_one_square(std::span<const Point3d> points) const {
    if (points.empty() || !is_in_city(points.front())) return false;
    const Square square = square_of(points.front());
    const Point2d low = {city_square_m * static_cast<double>(square.first), city_square_m * static_cast<double>(square.second)};
    return std::all_of(points.begin(), points.end(), [&](const Point3d& p) {
      return low.x < p.x && p.x < low.x + city_square_m && low.y < p.y && p.y < low.y + city_square_m;
    });
  }

  bool is_in_city(const Point3d& p) const {
    // Beyond this the number of a square is no std::int64_t
    constexpr double beyond_all_squares_m = 1e15;
    return std::abs(p.x) < beyond_all_squares_m && std::abs(p.y) < beyond_all_squares_m && squares_.contains(square_of(p));
  }

  const CityModel& city_;
  std::set<Square> squares_;
};

}  // namespace

std::vector<MisplacedFacets> find_misplaced(const CityModel& city) {
  const MisplacementFinder finder(city);
  std::vector<MisplacedFacets> misplaced;
  city.for_each_building([&](std::size_t row, const Building&) {
    if (auto found = finder.look_at(row)) misplaced.push_back(std::move(*found));
  });
  return misplaced;
}

void leave_out(CityModel& city, const std::vector<MisplacedFacets>& misplaced) {
  std::vector<bool> is_misplaced(city.facets().size(), false);
  for (const MisplacedFacets& m : misplaced)
    for (const std::size_t f : m.facets) is_misplaced[f] = true;
  city.drop_facets(is_misplaced);
}

namespace {

/// The highest building is Burj Khalifa, 828 m; the Jeddah Tower will pass 1,000 m.
constexpr double highest_building_m = 1'200.0;
/// Roof area times height. Boeing's factory in Everett has 0.014 km³, Beijing's airport terminal below 0.04 km³, and Burj Khalifa
/// with its podium below 0.1 km³. Bridges and city walls of many kilometres have less roof.
constexpr double largest_building_m3 = 0.5e9;
/// The longest buildings have 1.5 km. Bridges and walls are longer, but not as high.
constexpr double widest_building_m = 2'000.0;
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
  [[nodiscard]] bool is_impossible() const { return height_m() > highest_building_m && side_m() > widest_building_m; }
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
  std::size_t too_large = 0, impossible = 0;
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
    impossible += size.is_impossible() ? 1 : 0;
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
      return "are heights " + in_unit + "? A typical one would be " + metres_of(unit.metres * height_m) + " high.";
  }
  return "what is the unit of the coordinates, and is each vertex right?";
}

std::optional<std::string> doubt_about_size(const FileSizes& sizes, const FormatAdvice& advice) {
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
         sizes.largest + ", " + metres_of(sizes.largest_size.height_m()) + ": " + explanation_of_size(side_m, height_m) + " " +
         std::string(advice.scale);
}

double spread(const std::vector<double>& values) {
  constexpr double tail = 0.05;
  return quantile(values, 1.0 - tail) - quantile(values, tail);
}

std::optional<std::string> doubt_about_up(const FileSizes& sizes, const FormatAdvice& advice) {
  if (sizes.bases_m.size() < enough_for_median) return std::nullopt;
  const double climb_m = spread(sizes.bases_m), x_m = spread(sizes.x_m), y_m = spread(sizes.y_m);
  const bool is_steep = climb_m >= least_climb_m && climb_m >= steepest_town * std::max(x_m, y_m) &&
                        climb_m >= least_climb_to_shorter_side * std::min(x_m, y_m);
  if (!is_steep) return std::nullopt;
  return "its buildings stand at heights that differ by " + metres_of(climb_m) + ", on ground of " +
         metres_of(std::max(x_m, y_m)) + " by " + metres_of(std::min(x_m, y_m)) + ": the model seems to lie on its side. " +
         std::string(advice.up);
}

/// Why the whole city cannot be, in words for the first file without a possible building.
std::optional<std::string> objection_to(const std::vector<FileSizes>& files, const LocatedCity& located) {
  std::size_t all = 0, impossible = 0;
  for (const FileSizes& file : files) {
    all += file.heights_m.size();
    impossible += file.impossible;
  }
  if (all == 0 || 10 * impossible < 9 * all) return std::nullopt;
  std::size_t n = 0;
  while (2 * files[n].impossible <= files[n].heights_m.size()) ++n;
  return located.sources[n] + ": no building is this large: " + *doubt_about_size(files[n], located.advice[n]);
}

}  // namespace

std::optional<std::string> report_implausible(const LocatedCity& located, Report& report) {
  std::vector<FileSizes> files(located.sources.size());
  const CityModel& city = located.city;
  city.for_each_building([&](std::size_t, const Building& b) {
    if (const BuildingSize size = size_of(city, b); size.highest) files[b.source].add(b.id, size);
  });
  for (std::size_t n = 0; n < files.size(); ++n) {
    if (files[n].heights_m.empty()) continue;
    const FormatAdvice& advice = located.advice[n];
    const auto add = [&](ProblemCode code, const std::string& detail) {
      report.add({code, located.sources[n], "the whole file", detail, files[n].largest_size.highest});
    };
    if (const auto doubt = doubt_about_size(files[n], advice)) add(ProblemCode::implausible_size, *doubt);
    if (const auto doubt = doubt_about_up(files[n], advice)) add(ProblemCode::lies_on_its_side, *doubt);
  }
  return objection_to(files, located);
}

}  // namespace farlod::georeference
