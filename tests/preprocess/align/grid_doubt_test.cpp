// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "align/grid_doubt.hpp"

#include <gmock/gmock.h>

#include "align/align.hpp"
#include "extruded_town.hpp"

namespace farlod::align {
namespace {

using testing::AllOf;
using testing::HasSubstr;

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

}  // namespace
}  // namespace farlod::align
