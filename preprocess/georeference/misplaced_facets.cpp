// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/misplaced_facets.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>
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

}  // namespace farlod::georeference
