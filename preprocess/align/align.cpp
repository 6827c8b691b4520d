// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "align/align.hpp"

#include <cmath>
#include <sstream>
#include <string>

#include "align/grid_doubt.hpp"
#include "base/expects.hpp"
#include "farlod/error.hpp"

namespace farlod::align {
namespace {

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
  if (const auto doubt = doubt_about_grid(located.city, grid))
    report.add({ProblemCode::nearly_empty_grid, "", "whole city", *doubt});
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
