// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/acceptance/real_city.hpp"

namespace farlod::acceptance {
namespace {

TEST_F(RealCity, Manhattan) {
  const std::string file = "manhattan/manhattan.geojson";
  needs({file});
  if (IsSkipped()) return;
  PackedCity city = pack(data(file) + " --height-field height");
  // 1,239 areas, of which one is a car park below the ground, and 10 others do not say their height, but two of these their
  // storeys; the 47 points are no buildings
  EXPECT_EQ(city.count("buildings") + city.problems[107], 1238U);
  EXPECT_EQ(city.problems[107], 8U);
  EXPECT_EQ(city.problems[108], 0U);
  EXPECT_EQ(city.count("polygons"), 15091U + 7U + 6U);
  // The avenues run 29° from true north, which is 28.3° from the grid north of UTM 18N
  EXPECT_NEAR(city.summary.at("grid_rotation_deg"), 28.3, 0.5);
  EXPECT_GT(city.summary.at("alignment_strength"), 0.9);
  expect_sound_map();
}

TEST_F(RealCity, Omiya) {
  const std::string file = "omiya/omiya.geojson";
  needs({file});
  if (IsSkipped()) return;
  PackedCity city = pack(data(file) + " --height-field TAKASA");
  EXPECT_EQ(city.count("buildings"), 10213U);
  // Between a corner and its repetition stands no wall: 88 buildings have 669 such
  EXPECT_EQ(city.problems[103], 88U);
  EXPECT_EQ(city.count("polygons") + city.told_counts[103], 101722U);
  expect_sound_map();
}

TEST_F(RealCity, Tokyo) {
  const std::string file = "tokyo/53392633_bldg_6697_2_op.gml";
  needs({file});
  if (IsSkipped()) return;
  PackedCity city = pack(data(file));
  EXPECT_EQ(city.count("buildings"), 9U);
  // Each building is there three times: 9 outlines in LoD 0, 177 polygons in LoD 1, 897 in LoD 2, of which the last count
  EXPECT_EQ(city.problems[114], 9U);
  EXPECT_EQ(city.told_counts[114], 9U + 177U);
  EXPECT_EQ(city.count("polygons") + city.told_counts[114], 1083U);
  expect_sound_map();
}

TEST_F(RealCity, NorthRhineWestphalia) {
  const std::string south = "nrw/LoD2_32_280_5657_1_NW.gml", north = "nrw/LoD2_32_280_5659_1_NW.gml";
  needs({south, north});
  if (IsSkipped()) return;
  PackedCity city = pack(data(south) + " " + data(north));
  // The 105 parts belong to the 192 buildings, and their polygons count
  EXPECT_EQ(city.count("buildings"), 192U);
  EXPECT_EQ(city.count("polygons"), 2585U);
  EXPECT_EQ(city.problems[403], 70U);
  EXPECT_EQ(city.problems.size(), 1U);
  expect_sound_map();
}

TEST_F(RealCity, Rotterdam) {
  const std::string file = "rotterdam/delfshaven.city.json";
  needs({file});
  if (IsSkipped()) return;
  PackedCity city = pack(data(file));
  EXPECT_EQ(city.count("buildings"), 853U);
  // 633 rings enclose nothing, and the points of 9 more lie on a line
  EXPECT_EQ(city.problems[101], 633U);
  EXPECT_EQ(city.problems[401], 9U);
  EXPECT_EQ(city.count("polygons") + city.problems[101] + city.problems[401], 15482U);
  expect_sound_map();
}

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
