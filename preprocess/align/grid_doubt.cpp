// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "align/grid_doubt.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <vector>

#include "farlod/box.hpp"

namespace farlod::align {
namespace {

/// A smaller grid takes no time worth a word.
constexpr double large_grid_m2 = 25e6;
/// Villages in the mountains have some buildings for each square kilometre.
constexpr double empty_m2_of_each_building = 12.5e6;
/// What a few buildings may not multiply the grid by.
constexpr double most_times_larger = 10.0;
constexpr std::size_t least_town = 20, most_strays = 10;

struct Place {
  Point2d p_grid;
  std::size_t building = 0;
};

std::vector<Place> places_of(const CityModel& city, const Grid& grid) {
  std::vector<Place> places;
  city.for_each_building([&](std::size_t n, const Building& b) {
    if (const auto points = city.points_of(b); !points.empty())
      places.push_back({grid.rotation.grid_from_city(horizontal(points.front())), n});
  });
  return places;
}

/// All places but for some outermost ones on each side: a hundredth, at least one and at most ten.
Box2d inner_box(const std::vector<Place>& places) {
  const std::size_t strays = std::clamp<std::size_t>(places.size() / 100, 1, most_strays);
  Box2d box;
  std::vector<double> values(places.size());
  const auto at = [&](double Point2d::*axis, std::size_t row) {
    std::transform(places.begin(), places.end(), values.begin(), [&](const Place& place) { return place.p_grid.*axis; });
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(row), values.end());
    return values[row];
  };
  const std::size_t last = places.size() - 1 - strays;
  box.low = {at(&Point2d::x, strays), at(&Point2d::y, strays)};
  box.high = {at(&Point2d::x, last), at(&Point2d::y, last)};
  return box;
}

double area_m2(const Box2d& box) { return (box.high.x - box.low.x) * (box.high.y - box.low.y); }

std::string kilometres(Point2d size_m) {
  std::ostringstream text;
  text.precision(3);
  text << size_m.x / 1000.0 << " km by " << size_m.y / 1000.0 << " km";
  return text.str();
}

/// The buildings far from the inner box, and the farthest of them.
std::string strays_beyond(const Box2d& inner, const std::vector<Place>& places, const CityModel& city) {
  const auto beyond = [&](const Place& place) {
    const Point2d p = place.p_grid, q{std::clamp(p.x, inner.low.x, inner.high.x), std::clamp(p.y, inner.low.y, inner.high.y)};
    return norm(p - q);
  };
  const double near_m = std::sqrt(area_m2(inner));
  const auto count = std::count_if(places.begin(), places.end(), [&](const Place& place) { return beyond(place) > near_m; });
  const auto farthest =
      std::max_element(places.begin(), places.end(), [&](const Place& a, const Place& b) { return beyond(a) < beyond(b); });
  return std::to_string(count) + " of " + std::to_string(places.size()) + " buildings, such as " +
         city.buildings()[farthest->building].id;
}

}  // namespace

std::optional<std::string> doubt_about_grid(const CityModel& city, const Grid& grid) {
  const Box2d whole = grid.rectangle();
  if (area_m2(whole) < large_grid_m2) return std::nullopt;
  const std::vector<Place> places = places_of(city, grid);
  const std::string size =
      "the grid is " + kilometres(whole.high - whole.low) + ", " + std::to_string(grid.cells.size()) + " cells, ";
  if (places.size() >= least_town)
    if (const Box2d inner = inner_box(places); most_times_larger * area_m2(inner) < area_m2(whole))
      return size + "but would be about " + kilometres(inner.high - inner.low) + " without " +
             strays_beyond(inner, places, city) +
             ": are they where they should be? Leave them out, or pack the two places one by one";
  if (static_cast<double>(places.size()) * empty_m2_of_each_building >= area_m2(whole)) return std::nullopt;
  return size + "for " + std::to_string(places.size()) + (places.size() == 1 ? " building" : " buildings") +
         ": are all of them where they should be, and in the right unit?";
}

}  // namespace farlod::align
