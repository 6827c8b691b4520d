// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "align/align.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <random>
#include <set>

#include "farlod/error.hpp"
#include "pipeline/blocks.hpp"
#include "tests/preprocess/align/extruded_town.hpp"
#include "tests/scenes/refusal.hpp"

namespace farlod::align {
namespace {

using pipeline::AreaCells;
using pipeline::cells_met_by;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

LocatedCity located(CityModel city) { return {std::move(city), {}}; }

LocatedCity town(double bearing_deg) {
  CityModel city;
  add_quarter(city, 40, Angle::degrees(bearing_deg), {-300.0, 20.0});
  return located(std::move(city));
}

LocatedCity round_town() {
  CityModel city;
  add_round(city, 64);
  return located(std::move(city));
}

void expect_covers(const Grid& grid, const CityModel& city) {
  for (const Point3d& p_city : city.points())
    EXPECT_TRUE(grid.cells.contains(grid.cell_of(grid.rotation.grid_from_city(horizontal(p_city)))));
}

TEST(Align, FollowsTheStreets) {
  Report report;
  const GridAlignment found = align(town(28.0), {}, report);
  EXPECT_EQ(found.grid.rotation.bearing(), found.streets.bearing);
  EXPECT_DOUBLE_EQ(found.streets.bearing.degrees(), 28.0);
  EXPECT_TRUE(report.problems().empty());
}

TEST(Align, GivesEveryPointACell) {
  Report report;
  for (const double bearing_deg : {0.0, 28.0, -44.0})
    for (const double edge_m : {7.3, 50.0, 1000.0}) {
      const LocatedCity city = town(bearing_deg);
      const Grid grid = align(city, {.cell_edge_m = edge_m}, report).grid;
      EXPECT_EQ(grid.cell_edge_m, exact_cell_edge_m(edge_m));
      expect_covers(grid, city.city);
    }
}

TEST(Align, HasNoMoreCellsThanItNeeds) {
  Report report;
  CityModel city;
  add_extruded(city, {{-50, 10}, {100, 10}, {100, 49}, {-50, 49}}, 10.0);
  const Grid grid = align(located(std::move(city)), {.cell_edge_m = 50.0}, report).grid;
  // What lies on a border belongs to the cell to its east: x = 100 needs the column from 100 to 150
  EXPECT_EQ(grid.cells, (CellRange{-1, 0, 3, 1}));
}

TEST(Align, ReportsACityWithoutADirection) {
  Report report;
  const GridAlignment found = align(round_town(), {}, report);
  EXPECT_EQ(found.grid.rotation.bearing(), Angle());
  EXPECT_LT(found.streets.strength, least_alignment_strength);
  ASSERT_EQ(report.problems().size(), 1u);
  EXPECT_EQ(report.problems()[0].code, ProblemCode::no_dominant_direction);
  EXPECT_THAT(report.problems()[0].detail, HasSubstr("is below 0.1"));
}

TEST(Align, DoesAsItIsTold) {
  Report report;
  GridSettings north{.align = AlignMode::none};
  EXPECT_EQ(align(town(28.0), north, report).grid.rotation.bearing(), Angle());
  EXPECT_GT(align(town(28.0), north, report).streets.strength, 0.9) << "found all the same";
  GridSettings fixed{.neighborhood = 5, .block_edge = 16, .align = AlignMode::fixed, .fixed_bearing = Angle::degrees(12.0)};
  const Grid grid = align(round_town(), fixed, report).grid;
  EXPECT_EQ(grid.rotation.bearing(), Angle::degrees(12.0));
  EXPECT_EQ(grid.neighborhood, 5);
  EXPECT_EQ(grid.block_edge, 16);
  EXPECT_TRUE(report.problems().empty()) << "nobody asked for the streets";
}

TEST(Align, RefusesAGridThatAStrayBuildingBlowsUp) {
  LocatedCity city = town(0.0);
  add_extruded(city.city, rectangle({500e3, 400e3}, Angle()), 10.0);
  Report report;
  const std::string refusal = scenes::refusal_of<InputError>([&] { (void)align(city, {.cell_edge_m = 50.0}, report); });
  EXPECT_THAT(refusal, HasSubstr("km by"));
  EXPECT_THAT(refusal, HasSubstr("--cell"));
}

TEST(GridOver, CoversARectangleAtAnyBearing) {
  Box2d box_city;
  box_city.add({-94.5, -64.5});
  box_city.add({94.5, 64.5});
  EXPECT_EQ(grid_over(box_city, {.cell_edge_m = 50.0}).cells, (CellRange{-2, -2, 2, 2}));
  const Grid turned = grid_over(box_city, {.align = AlignMode::fixed, .fixed_bearing = Angle::degrees(30.0)});
  for (const Point2d corner_city : {box_city.low, box_city.high, {-94.5, 64.5}, {94.5, -64.5}})
    EXPECT_TRUE(turned.cells.contains(turned.cell_of(turned.rotation.grid_from_city(corner_city))));
}

/// What is said of a city; empty when nothing is.
std::string doubt(CityModel city, double cell_edge_m = 150.0) {
  LocatedCity located;
  located.city = std::move(city);
  Report report;
  GridSettings settings;
  settings.cell_edge_m = cell_edge_m;
  (void)align(located, settings, report);
  EXPECT_LE(report.count(ProblemCode::nearly_empty_grid), 1U);
  for (const Problem& p : report.problems())
    if (p.code == ProblemCode::nearly_empty_grid) return p.detail;
  return "";
}

/// Rectangles, `step` apart, in rows of ten.
CityModel scattered(int count, double step) {
  CityModel city;
  for (int k = 0; k < count; ++k) add_extruded(city, rectangle({step * (k % 10), step * (k / 10)}, Angle()), 10.0);
  return city;
}

TEST(GridDoubt, IsNoneAboutTownsAndScatteredHouses) {
  EXPECT_EQ(doubt(scattered(100, 50)), "");
  EXPECT_EQ(doubt(scattered(50, 1000)), "") << "50 houses on 9 km by 4 km";
  EXPECT_EQ(doubt(scattered(1, 50)), "");
}

TEST(GridDoubt, IsThatAFewBuildingsLieFarAway) {
  CityModel city = scattered(200, 50);
  add_extruded(city, rectangle({7000, 7000}, Angle()), 10.0);
  EXPECT_THAT(doubt(std::move(city)), AllOf(HasSubstr("without 1 of 201 buildings, such as building 200"), HasSubstr("0.4")));
}

TEST(GridDoubt, IsThatThereAreNearlyNoBuildings) {
  CityModel pair;
  add_extruded(pair, rectangle({0, 0}, Angle()), 10.0);
  add_extruded(pair, rectangle({6000, 6000}, Angle()), 10.0);
  const std::string coarse = doubt(pair), fine = doubt(pair, 20.0);
  EXPECT_THAT(coarse, HasSubstr("for 2 buildings: are all of them where they should be"));
  EXPECT_THAT(fine, HasSubstr("for 2 buildings")) << "the size of the cells makes no difference";
  CityModel huge;
  add_extruded(huge, rectangle({0, 0}, Angle(), 300.0), 10.0);
  EXPECT_THAT(doubt(std::move(huge)), HasSubstr("for 1 building"));
}

TEST(GridDoubt, IsThatInputsLieApartWithNothingBetween) {
  LocatedCity located;
  located.sources = {"a.gml", "b.gml", "c.gml"};
  for (std::uint32_t n = 0; n < 3; ++n) {
    const Point2d corner = n == 2 ? Point2d{30e3, 40e3} : Point2d{600.0 * n, 0.0};
    CityModel town;
    for (int k = 0; k < 100; ++k)
      add_extruded(town, rectangle(corner + Point2d{50.0 * (k % 10), 50.0 * (k / 10)}, Angle()), 10.0);
    town.set_source(n);
    located.city.append(std::move(town));
  }
  Report report;
  (void)align(located, {}, report);
  ASSERT_EQ(report.count(ProblemCode::nearly_empty_grid), 1U);
  EXPECT_THAT(report.problems().back().detail, testing::AllOf(HasSubstr("c.gml"), HasSubstr("b.gml"), HasSubstr("49 km apart"),
                                                              HasSubstr("99 % of"), HasSubstr("packed on its own")));
}

/// Two files of places that are 150 km apart. Returns the refusal.
std::string refusal_of_two_places(double cell_edge_m) {
  LocatedCity located;
  located.sources = {"a.gml", "b.gml"};
  for (std::uint32_t n = 0; n < 2; ++n) {
    CityModel town;
    for (int k = 0; k < 20; ++k) add_extruded(town, rectangle({90e3 * n + 50.0 * k, 120e3 * n}, Angle()), 10.0);
    town.set_source(n);
    located.city.append(std::move(town));
  }
  GridSettings settings;
  settings.align = AlignMode::none;
  settings.cell_edge_m = cell_edge_m;
  Report report;
  return scenes::refusal_of<InputError>([&] { (void)align(located, settings, report); });
}

TEST(GridDoubt, TwoPlacesOnAMillionCellsAreRefused) {
  EXPECT_THAT(refusal_of_two_places(100.0),
              testing::AllOf(HasSubstr("a.gml"), HasSubstr("b.gml"), HasSubstr("149 km apart with nothing between"),
                             HasSubstr("Give the files of one place")));
  EXPECT_EQ(refusal_of_two_places(1000.0), "no refusal") << "a grid of few cells is doubted alone";
}

constexpr double huge_m = 1e300;

/// Eight by six cells of 10 m, from (−20, −20) to (60, 40) in the grid frame.
Grid grid_turned_by(double bearing_deg) {
  Grid grid;
  grid.rotation = GridRotation(Angle::degrees(bearing_deg));
  grid.cell_edge_m = 10.0;
  grid.cells = {-2, -2, 6, 4};
  return grid;
}

Area::Line outline(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

std::set<Cell> cells_of(const Area& area, const Grid& grid) {
  const AreaCells met = cells_met_by(area, grid);
  return {met.cells.begin(), met.cells.end()};
}

std::set<Cell> range(const CellRange& cells) {
  std::set<Cell> result;
  for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n) result.insert(cells.cell_at(n));
  return result;
}

TEST(AreaCells, ARectangleMeetsTheCellsThatItTouches) {
  const Grid grid = grid_turned_by(0.0);
  EXPECT_EQ(cells_of(area_of(Box2d{{1, 1}, {9, 9}}), grid), range({0, 0, 1, 1}));
  EXPECT_EQ(cells_of(area_of(Box2d{{1, 1}, {11, 29}}), grid), range({0, 0, 2, 3}));
  // What lies on a border belongs to the cell to its east or north
  EXPECT_EQ(cells_of(area_of(Box2d{{0, 0}, {10, 10}}), grid), range({0, 0, 2, 2}));
}

TEST(AreaCells, ARectangleOverAllMeetsAllAndNothingBeyond) {
  for (const double bearing_deg : {0.0, 33.0, -45.0}) {
    const Grid grid = grid_turned_by(bearing_deg);
    EXPECT_EQ(cells_of(area_of(Box2d{{-1000, -1000}, {1000, 1000}}), grid), range(grid.cells));
    EXPECT_EQ(cells_of(area_of(Box2d{{-huge_m, -huge_m}, {huge_m, huge_m}}), grid), range(grid.cells));
  }
}

TEST(AreaCells, AreInTheOrderOfTheGrid) {
  EXPECT_THAT(cells_met_by({{{15, 5}, {5, 15}, {5, 5}, {6, 6}}, {}, {}}, grid_turned_by(0.0)).cells,
              ElementsAre(Cell{0, 0}, Cell{1, 0}, Cell{0, 1}));
}

TEST(AreaCells, ACellWithinAHoleIsNotMet) {
  const Grid grid = grid_turned_by(0.0);
  const Area::Polygon ring{outline(-15, -15, 45, 35), outline(5, 5, 35, 25)};
  std::set<Cell> expected = range({-2, -2, 5, 4});
  for (const Cell inside : range({1, 1, 3, 2})) expected.erase(inside);
  EXPECT_EQ(cells_of({{}, {}, {ring}}, grid), expected);
  // Another polygon fills the hole
  EXPECT_EQ(cells_of({{}, {}, {ring, {outline(12, 12, 28, 18)}}}, grid), range({-2, -2, 5, 4}));
}

TEST(AreaCells, PointsMeetTheirCells) {
  const Grid grid = grid_turned_by(0.0);
  EXPECT_EQ(cells_of({{{10, 10}, {-20, -20}, {59.9, 39.9}}, {}, {}}, grid), (std::set<Cell>{{1, 1}, {-2, -2}, {5, 3}}));
}

TEST(AreaCells, TheEastAndNorthOfTheGridBelongToNoCell) {
  const Grid grid = grid_turned_by(0.0);
  const AreaCells met = cells_met_by({{{60, 0}, {0, 40}, {-huge_m, huge_m}}, {}, {}}, grid);
  EXPECT_THAT(met.cells, IsEmpty());
  EXPECT_EQ(met.shapes_outside_of_grid, 3U);
}

TEST(AreaCells, ALineMeetsTheCellsThatItRunsThrough) {
  const Grid grid = grid_turned_by(0.0);
  EXPECT_EQ(cells_of({{}, {{{5, 5}, {5, 25}, {25, 25}}}, {}}, grid), (std::set<Cell>{{0, 0}, {0, 1}, {0, 2}, {1, 2}, {2, 2}}));
  EXPECT_EQ(cells_of({{}, {{{-500, 1}, {500, 1}}}, {}}, grid), range({-2, 0, 6, 1}));
  EXPECT_EQ(cells_of({{}, {{{2, 6}, {14, 18}}}, {}}, grid), (std::set<Cell>{{0, 0}, {0, 1}, {1, 1}}));
  // A line does not close
  EXPECT_FALSE(cells_of({{}, {{{5, 5}, {5, 35}, {35, 35}}}, {}}, grid).contains({1, 1}));
}

TEST(AreaCells, CountsShapesThatMeetNothing) {
  const Area area{{{5, 5}, {100, 100}}, {{{-100, 0}, {-100, 5}}}, {{outline(1, 1, 2, 2)}, {outline(70, 0, 80, 10)}, {}}};
  EXPECT_EQ(cells_met_by(area, grid_turned_by(0.0)).shapes_outside_of_grid, 4U);
}

/// An independent judge: whether a polygon winds around a point, by the angles at the point.
bool winds_around(const Area::Line& ring, Point2d p) {
  double turn = 0.0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point2d a = ring[k] - p, b = ring[(k + 1) % ring.size()] - p;
    turn += std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
  }
  return std::abs(turn) > 1.0;
}

/// Whether the square of a cell, larger by a margin on each side, holds a point.
bool holds(const Grid& grid, Cell cell, Point2d p_grid, double margin_m) {
  const auto [low, high] = grid.square_of(cell);
  return low.x - margin_m <= p_grid.x && p_grid.x <= high.x + margin_m && low.y - margin_m <= p_grid.y &&
         p_grid.y <= high.y + margin_m;
}

/// On turned grids: the cells of all samples within a triangle are met, and each cell that is met has a sample in or beside it.
TEST(AreaCells, ATriangleMeetsTheCellsOfItsSamples) {
  constexpr double step_m = 0.5, margin_m = 3.0 * step_m;
  std::mt19937 random(7);
  for (const double bearing_deg : {0.0, 20.0, -33.0, 45.0})
    for (int n = 0; n < 5; ++n) {
      const auto place = [&random] { return static_cast<double>(random() % 600) / 10.0 - 20.0; };
      const Area::Line triangle{{place(), place()}, {place(), place()}, {place(), place()}};
      const Grid grid = grid_turned_by(bearing_deg);
      const std::set<Cell> met = cells_of({{}, {}, {{triangle}}}, grid);
      std::vector<Point2d> samples;
      for (double x = -40.0; x < 80.0; x += step_m)
        for (double y = -40.0; y < 80.0; y += step_m)
          if (winds_around(triangle, {x, y})) samples.push_back(grid.rotation.grid_from_city(Point2d{x, y}));
      for (const Point2d& p_grid : samples) {
        const Cell cell = grid.cell_of(p_grid);
        EXPECT_TRUE(!grid.cells.contains(cell) || met.contains(cell));
      }
      // A triangle may be thinner than the step at its corners
      for (const Point2d& corner : triangle) samples.push_back(grid.rotation.grid_from_city(corner));
      for (std::size_t k = 0; k < 3; ++k)
        for (double t = 0.0; t < 1.0; t += 0.005)
          samples.push_back(grid.rotation.grid_from_city(triangle[k] + t * (triangle[(k + 1) % 3] - triangle[k])));
      for (const Cell cell : met)
        EXPECT_TRUE(std::ranges::any_of(samples, [&](Point2d p) { return holds(grid, cell, p, margin_m); }));
    }
}

}  // namespace
}  // namespace farlod::align
