// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/building_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "farlod/pack.hpp"
#include "tests/scenes/footprints_text.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

const Point2d corner{550'000.0, 5'500'000.0};

Box2d box_at(double x, double y, double edge_m) { return {corner + Point2d{x, y}, corner + Point2d{x + edge_m, y + edge_m}}; }

/// Two buildings, in cells of 20 m that are turned against the CRS, so that borders of cells cut them.
Package two_buildings(const scenes::TemporaryFolder& folder) {
  scenes::FootprintsText text;
  text.add(scenes::building("A", 12.0), box_at(10.0, 10.0, 40.0)).add(scenes::building("B", 12.0), box_at(62.0, 62.0, 4.0));
  (void)folder.write("a.geojson", text.text());
  PackSettings settings;
  settings.inputs = {folder.file("a.geojson")};
  settings.output = folder.file("a.farlod");
  settings.cell_edge_m = 20.0;
  settings.align = AlignMode::fixed;
  settings.fixed_bearing = Angle::degrees(25.0);
  Report report;
  (void)pack(settings, report);
  return Package(settings.output);
}

/// From 10 m west and south of the corner to 90 m east and north of it.
RasterPlan plan_of(double step_m) {
  const auto pixels = static_cast<std::size_t>(100.0 / step_m);
  return {corner + Point2d{-10.0, 90.0}, step_m, pixels, pixels};
}

TEST(BuildingPlan, IsThatOfTheBuildingAlone) {
  const scenes::TemporaryFolder folder;
  const Package package = two_buildings(folder);
  const RasterPlan plan = plan_of(2.0);
  const std::vector<bool> is_a = plan_of_building(package, "A", plan);
  ASSERT_EQ(is_a.size(), plan.columns * plan.rows);
  for (std::size_t n = 0; n < is_a.size(); ++n) {
    const Point2d p = plan.centre_m(n % plan.columns, n / plan.columns) - corner;
    EXPECT_EQ(is_a[n], 10.0 < p.x && p.x < 50.0 && 10.0 < p.y && p.y < 50.0) << p.x << ' ' << p.y;
  }
}

TEST(BuildingPlan, OneThatCoversNoMiddleHasThePixelOfItsCorners) {
  const scenes::TemporaryFolder folder;
  const std::vector<bool> is_b = plan_of_building(two_buildings(folder), "B", plan_of(20.0));
  EXPECT_EQ(std::ranges::count(is_b, true), 1);
  EXPECT_TRUE(is_b[5 + 3]) << "62 m east of the corner is in the fourth column, 62 m north of it in the second row";
}

TEST(BuildingPlan, IsEmptyBeyondTheMap) {
  const scenes::TemporaryFolder folder;
  RasterPlan plan = plan_of(2.0);
  plan.north_west_m.x += 1000.0;
  const std::vector<bool> is_a = plan_of_building(two_buildings(folder), "A", plan);
  EXPECT_EQ(std::ranges::count(is_a, true), 0);
}

}  // namespace
}  // namespace farlod
