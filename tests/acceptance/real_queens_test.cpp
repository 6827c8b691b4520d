// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/acceptance/real_city.hpp"

namespace farlod::acceptance {
namespace {

TEST_F(RealCity, Queens) {
  const std::string file = "nyc_queens/queens_da4.obj";
  needs({file});
  if (IsSkipped()) return;
  PackedCity city = pack(data(file) + " --crs EPSG:32118 --origin 312420.625,52705.512");
  EXPECT_EQ(city.count("buildings"), 16665U);
  // All triangles of the file but the 140 that have two corners at one place
  EXPECT_EQ(city.problems[101], 140U);
  EXPECT_EQ(city.count("facets") + city.problems[101], 401110U);
  // They are pieces of 142,949 planar faces when what is flat to the eye is joined; we join only what the rounding of
  // coordinates to millimetres explains, and so have some more
  EXPECT_GE(city.count("polygons"), 142949U);
  EXPECT_LT(city.count("polygons"), 142949U + 142949U / 10U);
  // Some 62: what lies on disk is not held
  if (city.held_mib) {
    EXPECT_LT(*city.held_mib, 120.0);
  }
  expect_sound_map();
}

}  // namespace
}  // namespace farlod::acceptance
