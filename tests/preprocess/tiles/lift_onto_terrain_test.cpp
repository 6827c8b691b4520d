// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tiles/lift_onto_terrain.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "city/height_limits.hpp"

namespace farlod::tiles {
namespace {

/// A city of posts: a wall from x = 10 to 20 between two heights.
struct Posts {
  LocatedCity located;
  Report report;

  Posts() {
    located.georeference.origin_m = {1000.0, 2000.0};
    located.sources = {"town.geojson"};
  }
  void add(const std::string& id, HeightReference height_reference, double base_m, double top_m) {
    located.city.begin_building(id, height_reference);
    located.city.begin_facet(SurfaceKind::wall, 0);
    located.city.add_ring(std::vector<Point3d>{{10, 0, base_m}, {20, 0, base_m}, {20, 0, top_m}, {10, 0, top_m}});
  }
  /// The ground rises by 1 m in 10 m to the east.
  void lift(double ground_at_zero_m) {
    lift_onto_terrain(
        located, [=](Point2d p) { return std::optional(ground_at_zero_m + p.x / 10.0); }, report);
  }
  [[nodiscard]] std::pair<double, double> base_and_top_m(std::size_t n) const {
    const auto points = located.city.points_of(located.city.buildings()[n]);
    return {points[0].z, points[2].z};
  }
};

using Heights = std::pair<double, double>;

TEST(LiftOntoTerrain, MovesEachBuildingAsItsHeightsCount) {
  Posts posts;
  posts.add("surveyed", HeightReference::elevation, 50, 60);
  posts.add("house", HeightReference::on_ground, 0, 9);
  posts.add("skyway", HeightReference::on_ground, 4, 9);
  posts.add("hall", HeightReference::down_to_ground, 119, 120);
  posts.lift(100);
  EXPECT_EQ(posts.base_and_top_m(0), Heights(50, 60));
  EXPECT_EQ(posts.base_and_top_m(1), Heights(101, 110));
  EXPECT_EQ(posts.base_and_top_m(2), Heights(105, 110));
  EXPECT_EQ(posts.base_and_top_m(3), Heights(101, 120));
  EXPECT_TRUE(posts.report.problems().empty());
}

TEST(LiftOntoTerrain, ReachesDownFromHighRoofsToo) {
  Posts posts;
  posts.add("tower", HeightReference::down_to_ground, 219, 220);
  posts.lift(0);
  EXPECT_EQ(posts.base_and_top_m(0), Heights(1, 220));
}

TEST(LiftOntoTerrain, LeavesOutRoofsThatLieBelowTheGround) {
  Posts posts;
  posts.add("hall", HeightReference::down_to_ground, 119, 120);
  posts.add("cellar", HeightReference::down_to_ground, 89, 90);
  posts.add("house", HeightReference::on_ground, 0, 9);
  posts.lift(100);
  ASSERT_EQ(posts.located.city.buildings().size(), 2U);
  EXPECT_EQ(posts.located.city.buildings()[1].id, "house");
  EXPECT_EQ(posts.base_and_top_m(1), Heights(101, 110));
  EXPECT_EQ(posts.located.city.points().size(), 8U);
  ASSERT_EQ(posts.report.problems().size(), 1U);
  const Problem& problem = posts.report.problems()[0];
  EXPECT_EQ(problem.code, ProblemCode::height_not_positive);
  EXPECT_EQ(problem.place, "cellar");
  EXPECT_EQ(problem.source, "town.geojson");
  EXPECT_EQ(problem.position, (Point3d{1010, 2000, 89}));
  EXPECT_EQ(problem.detail, "its roof is at 90 m, the ground there at 101 m");
}

TEST(LiftOntoTerrain, LeavesOutRoofsHigherThanAnyBuilding) {
  Posts posts;
  posts.add("kite", HeightReference::down_to_ground, 0, 1.0 + highest_building_m);
  posts.add("record", HeightReference::down_to_ground, 0, 2.0 + highest_building_m);
  posts.lift(1.0 - 10.0 / 10.0);  // the ground at x = 10 is at 1 m
  ASSERT_EQ(posts.located.city.buildings().size(), 1U);
  EXPECT_EQ(posts.located.city.buildings()[0].id, "kite");
  EXPECT_EQ(posts.report.count(ProblemCode::absurd_height), 1U);
}

TEST(LiftOntoTerrain, KnowsNoFootWhereTheGroundIsUnknown) {
  Posts posts;
  posts.add("house", HeightReference::on_ground, 0, 9);
  posts.add("hall", HeightReference::down_to_ground, 119, 120);
  lift_onto_terrain(
      posts.located, [](Point2d) { return std::optional<double>(); }, posts.report);
  ASSERT_EQ(posts.located.city.buildings().size(), 1U);
  EXPECT_EQ(posts.base_and_top_m(0), Heights(0, 9));
  EXPECT_EQ(posts.report.count(ProblemCode::no_height), 1U);
}

}  // namespace
}  // namespace farlod::tiles
