// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "align/align.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <sstream>
#include <vector>

#include "align/inputs_apart.hpp"
#include "base/expects.hpp"
#include "base/paging/paged_array.hpp"
#include "farlod/error.hpp"
#include "farlod/surface_kind.hpp"

namespace farlod::align {
namespace {

/// A wall as seen from above. Its direction modulo 90° is that of a right-angled grid, so four times the angle is kept.
struct Wall {
  std::complex<double> fourfold;  ///< e^{4it}, t the azimuth of the wall or, the same modulo 90°, of its normal
  double length_m = 0.0;
};

/// Twice the area, along the normal: the sum over triangles around the first vertex (Newell 1972).
Point3d doubled_area_vector(std::span<const Point3d> ring) {
  Point3d sum;
  for (std::size_t k = 2; k < ring.size(); ++k) sum = sum + cross(ring[k - 1] - ring[0], ring[k] - ring[0]);
  return sum;
}

double height_of(std::span<const Point3d> points) {
  const auto [low, high] =
      std::minmax_element(points.begin(), points.end(), [](const Point3d& a, const Point3d& b) { return a.z < b.z; });
  return high->z - low->z;
}

std::complex<double> fourfold_of(Point2d normal) {
  const std::complex<double> once = std::complex<double>(normal.y, normal.x) / norm(normal);  // cos t + i sin t
  return (once * once) * (once * once);
}

/// The walls of a building. Area over the building's height is a wall's length, however it is cut into triangles, whose own
/// edges would count diagonals as streets.
void append_walls(const CityModel& city, const Building& b, PagedArray<Wall>& walls) {
  const auto points = city.points_of(b);
  if (points.empty()) return;
  const double height_m = height_of(points);
  for (const Facet& f : city.facets_of(b)) {
    if (f.ring_count == 0) continue;
    const Point3d doubled = doubled_area_vector(city.ring(f, 0));
    const double doubled_area_m2 = norm(doubled);
    if (!(doubled_area_m2 > 0.0) || std::abs(doubled.z) >= wall_normal_z * doubled_area_m2) continue;
    walls.push_back({fourfold_of(horizontal(doubled)), 0.5 * doubled_area_m2 / height_m});
  }
}

PagedArray<Wall> walls_of(const CityModel& city) {
  PagedArray<Wall> walls;
  city.for_each_building([&](std::size_t, const Building& b) { append_walls(city, b, walls); });
  return walls;
}

/// Walls along one street differ by a degree or two, as surveyed; separate grids by more than ten.
constexpr Angle half_window = Angle::degrees(5.0);
constexpr int bins = 90;  // of one degree

int bin_of(std::complex<double> fourfold) {
  const double turn = std::arg(fourfold) / (2.0 * std::numbers::pi) + 0.5;  // in [0, 1], half a turn ahead
  return std::min(static_cast<int>(turn * bins), bins - 1);
}

/// The middle of the window of bins with the longest walls; of equals, the first.
std::complex<double> peak_of(const PagedArray<Wall>& walls) {
  std::array<double, bins> length_m{};
  for (const Wall& w : walls) length_m[static_cast<std::size_t>(bin_of(w.fourfold))] += w.length_m;
  constexpr int reach = 4;
  int best = 0;
  double longest_m = -1.0;
  for (int middle = 0; middle < bins; ++middle) {
    double sum_m = 0.0;
    for (int k = middle - reach; k <= middle + reach; ++k) sum_m += length_m[static_cast<std::size_t>((k + bins) % bins)];
    if (sum_m > longest_m) best = middle, longest_m = sum_m;
  }
  return std::polar(1.0, 2.0 * std::numbers::pi * ((best + 0.5) / bins - 0.5));
}

/// Mean direction of the walls within the window around `centre`.
std::complex<double> mean_around(const PagedArray<Wall>& walls, std::complex<double> centre) {
  const double least_cosine = cos(4.0 * half_window);
  std::complex<double> sum;
  for (const Wall& w : walls)
    if ((w.fourfold * std::conj(centre)).real() >= least_cosine) sum += w.length_m * w.fourfold;
  return std::abs(sum) > 0.0 ? sum / std::abs(sum) : centre;
}

/// Moves the window to the mean of what it shows until it stays (mean shift, Cheng 1995), so that where the bins of the
/// histogram began is forgotten.
std::complex<double> refine(const PagedArray<Wall>& walls, std::complex<double> centre) {
  constexpr int most_moves = 100;  // the walls in the window are a finite choice: real cities need about ten
  for (int move = 0; move < most_moves; ++move) {
    const std::complex<double> next = mean_around(walls, centre);
    if (next == centre) break;
    centre = next;
  }
  return centre;
}

/// In (-45°, 45°]: the principal argument is in [-π, π], and -π is the same street as π.
Angle bearing_of(std::complex<double> fourfold) {
  const double turn = std::arg(fourfold);
  return Angle::radians(0.25 * (turn <= -std::numbers::pi ? std::numbers::pi : turn));
}

}  // namespace

Alignment street_alignment(const CityModel& city) {
  const PagedArray<Wall> walls = walls_of(city);
  double length_m = 0.0;
  std::complex<double> sum;
  for (const Wall& w : walls) {
    length_m += w.length_m;
    sum += w.length_m * w.fourfold;
  }
  if (!(length_m > 0.0)) return {};
  return {bearing_of(refine(walls, peak_of(walls))), std::min(std::abs(sum) / length_m, 1.0)};
}

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

/// A text that the grid is very large for its buildings, with what would explain it: a few stray buildings without which it would
/// be a tenth, or less than one building for 12.5 km². Empty when it is not. The size of the cells makes no difference.
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

/// 200 km by 200 km of cells of 50 m. Each cell has a tile and a far map: beyond, a stray building is likelier than a city.
constexpr double most_cells = 16e6;

Grid empty_grid(Angle bearing, const GridSettings& settings) {
  FARLOD_EXPECTS(settings.cell_edge_m > 0.0 && settings.neighborhood > 0 && settings.neighborhood % 2 == 1 &&
                 settings.block_edge > 0);
  Grid grid;
  grid.rotation = GridRotation(bearing);
  grid.cell_edge_m = exact_cell_edge_m(settings.cell_edge_m);
  grid.neighborhood = settings.neighborhood;
  grid.block_edge = settings.block_edge;
  return grid;
}

/// Runs before cells are numbered: 32 bits may be too few.
void check_extent(const Box2d& box_grid, double cell_edge_m) {
  const Point2d size_m = box_grid.high - box_grid.low;
  const double cells = (size_m.x / cell_edge_m + 1.0) * (size_m.y / cell_edge_m + 1.0);
  if (cells <= most_cells) return;
  std::ostringstream text;
  text << "the city would be " << size_m.x / 1000.0 << " km by " << size_m.y / 1000.0 << " km, which is " << cells << " cells of "
       << cell_edge_m
       << " m: remove buildings that lie far from all others, check the CRS of each input, or give a larger --cell";
  throw InputError(text.str());
}

void cover(Grid& grid, const Box2d& box_grid) {
  FARLOD_EXPECTS(!box_grid.empty());
  check_extent(box_grid, grid.cell_edge_m);
  const Cell first = grid.cell_of(box_grid.low), last = grid.cell_of(box_grid.high);
  grid.cells = {first.i, first.j, last.i + 1, last.j + 1};
}

std::string weakness(const Alignment& streets) {
  std::ostringstream text;
  text.precision(3);
  text << "strength " << streets.strength << " is below " << least_alignment_strength << ": the grid stays to the north";
  return text.str();
}

Angle chosen_bearing(const Alignment& streets, const GridSettings& settings, Report& report) {
  if (settings.align == AlignMode::fixed) return settings.fixed_bearing;
  if (settings.align == AlignMode::none) return {};
  if (streets.strength >= least_alignment_strength) return streets.bearing;
  report.add({ProblemCode::no_dominant_direction, "", "whole city", weakness(streets)});
  return {};
}

}  // namespace

GridAlignment align(const LocatedCity& located, const GridSettings& settings, Report& report) {
  const Alignment streets = street_alignment(located.city);
  Grid grid = empty_grid(chosen_bearing(streets, settings, report), settings);
  Box2d box_grid;
  located.city.for_each_building([&](std::size_t, const Building& b) {
    for (const Point3d& p_city : located.city.points_of(b)) box_grid.add(grid.rotation.grid_from_city(horizontal(p_city)));
  });
  cover(grid, box_grid);
  auto doubt = area_m2(grid.rectangle()) >= large_grid_m2 ? inputs_apart(located, grid) : std::nullopt;
  if (!doubt) doubt = doubt_about_grid(located.city, grid);
  if (doubt) report.add({ProblemCode::nearly_empty_grid, "", "whole city", *doubt});
  return {grid, streets};
}

Grid grid_over(const Box2d& box_city, const GridSettings& settings) {
  Grid grid = empty_grid(settings.align == AlignMode::fixed ? settings.fixed_bearing : Angle(), settings);
  Box2d box_grid;
  for (const Point2d corner_city :
       {box_city.low, box_city.high, {box_city.low.x, box_city.high.y}, {box_city.high.x, box_city.low.y}})
    box_grid.add(grid.rotation.grid_from_city(corner_city));
  cover(grid, box_grid);
  return grid;
}

}  // namespace farlod::align
