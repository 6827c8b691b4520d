// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "align/align.hpp"

#include <gmock/gmock.h>

#include "farlod/error.hpp"
#include "tests/preprocess/align/extruded_town.hpp"

namespace farlod::align {
namespace {

using testing::HasSubstr;

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
  try {
    (void)align(city, {.cell_edge_m = 50.0}, report);
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("km by"));
    EXPECT_THAT(error.what(), HasSubstr("--cell"));
  }
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

}  // namespace
}  // namespace farlod::align
