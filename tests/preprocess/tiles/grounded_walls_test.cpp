// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tiles/grounded_walls.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/preprocess/tiles/borders.hpp"
#include "tiles/ground.hpp"

namespace farlod::tiles {
namespace {

using test::Face;

const GroundHeightAt level_ground = [](Point2d) { return 0.0; };

/// A wall above the x axis, or above a line that is turned from it.
Face wall(double x0, double x1, double low_m, double high_m) {
  return {{x0, 0, low_m}, {x1, 0, low_m}, {x1, 0, high_m}, {x0, 0, high_m}};
}
const Face gable{{0, 0, 0}, {10, 0, 0}, {10, 0, 6}, {5, 0, 9}, {0, 0, 6}};

/// The heights of a wall's borders by place in the plan; which end it begins at means nothing.
double lower_at(const WallProfile& wall, double x) { return wall.lower_m(norm(Point2d{x, 0.0} - wall.begin)); }
double upper_at(const WallProfile& wall, double x) { return wall.upper_m(norm(Point2d{x, 0.0} - wall.begin)); }

GroundedWalls walls_of(const std::vector<Face>& faces, const GroundHeightAt& ground = level_ground) {
  std::vector<WallProfile> walls;
  for (const Face& face : faces) {
    auto profile = wall_profile(face);
    EXPECT_TRUE(profile);
    if (profile) walls.push_back(std::move(*profile));
  }
  return {std::move(walls), ground};
}

Segment3d level_segment(double x0, double x1, double z) { return {{x0, 0, z}, {x1, 0, z}}; }

TEST(WallProfile, OfARectangle) {
  const auto profile = wall_profile(wall(2, 12, 1, 7));
  ASSERT_TRUE(profile);
  EXPECT_EQ(profile->length_m, 10.0);
  for (const double x : {2.0, 5.0, 12.0}) {
    EXPECT_EQ(lower_at(*profile, x), 1.0);
    EXPECT_EQ(upper_at(*profile, x), 7.0);
  }
}

TEST(WallProfile, OfAGable) {
  for (Face face : {gable, Face(gable.rbegin(), gable.rend())}) {
    const auto profile = wall_profile(face);
    ASSERT_TRUE(profile);
    for (const double x : {0.0, 1.0, 5.0, 8.0, 10.0}) {
      EXPECT_NEAR(lower_at(*profile, x), 0.0, 1e-12);
      EXPECT_NEAR(upper_at(*profile, x), 9.0 - 0.6 * std::abs(x - 5.0), 1e-12);
    }
  }
}

TEST(WallProfile, DoesNotDependOnTheFirstPointOfTheRing) {
  Face face = gable;
  for (std::size_t turn = 0; turn < gable.size(); ++turn) {
    std::rotate(face.begin(), face.begin() + 1, face.end());
    const auto profile = wall_profile(face);
    ASSERT_TRUE(profile);
    for (const double x : {0.5, 3.0, 9.0}) EXPECT_NEAR(upper_at(*profile, x), 9.0 - 0.6 * std::abs(x - 5.0), 1e-12);
  }
}

TEST(WallProfile, OfAWallWithADoorStepsUpBelow) {
  const auto profile =
      wall_profile(Face{{0, 0, 0}, {4, 0, 0}, {4, 0, 2}, {6, 0, 2}, {6, 0, 0}, {10, 0, 0}, {10, 0, 5}, {0, 0, 5}});
  ASSERT_TRUE(profile);
  EXPECT_EQ(lower_at(*profile, 2), 0.0);
  EXPECT_EQ(lower_at(*profile, 5), 2.0);
  EXPECT_EQ(lower_at(*profile, 4), 2.0) << "at a step, the higher one";
}

TEST(WallProfile, OfSteppedGablesStepsAbove) {
  const auto profile =
      wall_profile(Face{{0, 0, 0}, {10, 0, 0}, {10, 0, 4}, {7, 0, 4}, {7, 0, 8}, {3, 0, 8}, {3, 0, 4}, {0, 0, 4}});
  ASSERT_TRUE(profile);
  EXPECT_EQ(upper_at(*profile, 5), 8.0);
  EXPECT_EQ(upper_at(*profile, 1), 4.0);
  EXPECT_EQ(upper_at(*profile, 3), 4.0) << "at a step, the lower one";
}

TEST(WallProfile, OfNothingElse) {
  EXPECT_FALSE(wall_profile(Face{{0, 0, 0}, {10, 0, 0}, {10, 1, 5}, {0, 1, 5}})) << "it leans";
  EXPECT_FALSE(wall_profile(Face{{0, 0, 5}, {10, 0, 5}, {10, 8, 5}, {0, 8, 5}})) << "a roof";
  EXPECT_FALSE(wall_profile(Face{{3, 3, 0}, {3, 3, 5}, {3, 3, 9}})) << "a line";
  EXPECT_FALSE(wall_profile(Face{{0, 0, 0}, {10, 0, 0}})) << "no facet";
  // A C: upright lines meet it twice
  EXPECT_FALSE(wall_profile(Face{{0, 0, 0}, {10, 0, 0}, {10, 0, 2}, {3, 0, 2}, {3, 0, 6}, {10, 0, 6}, {10, 0, 8}, {0, 0, 8}}));
}

TEST(GroundedWalls, ARectangularWallClosesItsUpperBorderAndAllBelow) {
  const GroundedWalls walls = walls_of({wall(0, 10, 0, 6)});
  EXPECT_TRUE(walls.close_below(level_segment(0, 10, 6)));
  EXPECT_TRUE(walls.close_below(level_segment(10, 0, 6)));
  EXPECT_TRUE(walls.close_below(level_segment(3, 4, 6)));
  EXPECT_TRUE(walls.close_below(level_segment(3, 4, 2)));
  EXPECT_FALSE(walls.close_below(level_segment(0, 10, 6.1)));
  EXPECT_FALSE(walls.close_below({{0, 0, 6}, {10, 0, 6.1}}));
  EXPECT_FALSE(walls.close_below(level_segment(0, 11, 6))) << "it reaches beyond the wall";
  EXPECT_FALSE(walls.close_below({{0, 0, 6}, {0, 8, 6}})) << "it leaves the wall";
  EXPECT_FALSE(walls.close_below({{0, 1, 6}, {10, 1, 6}})) << "it lies beside the wall";
}

TEST(GroundedWalls, AGableClosesItsSlopesAndNoTieAboveThem) {
  const GroundedWalls walls = walls_of({gable});
  EXPECT_TRUE(walls.close_below({{0, 0, 6}, {5, 0, 9}}));
  EXPECT_TRUE(walls.close_below({{5, 0, 9}, {10, 0, 6}}));
  EXPECT_TRUE(walls.close_below(level_segment(0, 10, 6)));
  EXPECT_FALSE(walls.close_below(level_segment(0, 10, 8)));
  // Both ends lie on the wall, the middle does not
  const GroundedWalls notched = walls_of({{{0, 0, 0}, {10, 0, 0}, {10, 0, 9}, {5, 0, 4}, {0, 0, 9}}});
  EXPECT_FALSE(notched.close_below(level_segment(0, 10, 9)));
  EXPECT_TRUE(notched.close_below({{0, 0, 9}, {5, 0, 4}}));
}

TEST(GroundedWalls, AWallOnAWallIsGrounded) {
  const Face lower = wall(0, 10, 0, 3), middle = wall(2, 9, 3, 6), upper = wall(4, 8, 6, 9);
  for (const auto& faces : {std::vector<Face>{lower, middle, upper}, {upper, middle, lower}, {middle, upper, lower}})
    EXPECT_TRUE(walls_of(faces).close_below(level_segment(4, 8, 9)));
  EXPECT_FALSE(walls_of({lower, upper}).close_below(level_segment(4, 8, 9))) << "there is a gap between them";
  EXPECT_FALSE(walls_of({middle, upper}).close_below(level_segment(4, 8, 9))) << "the lowest one floats";
}

TEST(GroundedWalls, AWallMayStandOnSeveral) {
  EXPECT_TRUE(walls_of({wall(0, 5, 0, 3), wall(5, 10, 0, 3), wall(0, 10, 3, 6)}).close_below(level_segment(0, 10, 6)));
  EXPECT_FALSE(walls_of({wall(0, 4, 0, 3), wall(6, 10, 0, 3), wall(0, 10, 3, 6)}).close_below(level_segment(0, 10, 6)))
      << "between them it can be seen under";
}

TEST(GroundedWalls, AWallAboveASoffitIsNot) {
  const GroundedWalls walls = walls_of({wall(0, 10, 3, 6)});
  EXPECT_FALSE(walls.close_below(level_segment(0, 10, 6)));
  // A wall with a door is seen through
  const GroundedWalls door =
      walls_of({{{0, 0, 0}, {4, 0, 0}, {4, 0, 2}, {6, 0, 2}, {6, 0, 0}, {10, 0, 0}, {10, 0, 5}, {0, 0, 5}}});
  EXPECT_FALSE(door.close_below(level_segment(0, 10, 5)));
}

TEST(GroundedWalls, FollowTheGround) {
  const GroundHeightAt slope = [](Point2d p) { return 0.2 * p.x; };
  EXPECT_TRUE(walls_of({{{0, 0, 0}, {10, 0, 2}, {10, 0, 6}, {0, 0, 6}}}, slope).close_below(level_segment(0, 10, 6)));
  EXPECT_TRUE(walls_of({wall(0, 10, 0, 6)}, slope).close_below(level_segment(0, 10, 6))) << "dug in";
  EXPECT_FALSE(walls_of({wall(0, 10, 2, 6)}, slope).close_below(level_segment(0, 10, 6)));
  EXPECT_TRUE(walls_of({wall(0, 10, 0.9 * ground_contact_m, 6)}).close_below(level_segment(0, 10, 6)));
  // A hollow as wide as the ground is asked
  const GroundHeightAt hollow = [](Point2d p) { return std::abs(p.x - 5.3) < 0.6 * ground_sampling_step_m ? -1.0 : 0.0; };
  EXPECT_FALSE(walls_of({wall(0, 10, 0, 6)}, hollow).close_below(level_segment(0, 10, 6)));
}

// The whole tile stage

TEST(GroundedWalls, OfAHouseWithAProjectingFloorKeepTheEdgesAboveThemGrounded) {
  test::SmallTown town;
  // The upper floor projects by 2 m to the south; the north wall reaches the ground, the side walls do so in part
  town.add("house", {{{10, 8, 6}, {20, 8, 6}, {20, 20, 6}, {10, 20, 6}},
                     {{10, 8, 3}, {10, 10, 3}, {20, 10, 3}, {20, 8, 3}},
                     {{10, 10, 0}, {20, 10, 0}, {20, 10, 3}, {10, 10, 3}},
                     {{10, 8, 3}, {20, 8, 3}, {20, 8, 6}, {10, 8, 6}},
                     {{20, 20, 0}, {10, 20, 0}, {10, 20, 6}, {20, 20, 6}},
                     {{20, 10, 0}, {20, 20, 0}, {20, 20, 6}, {20, 8, 6}, {20, 8, 3}, {20, 10, 3}},
                     {{10, 20, 0}, {10, 10, 0}, {10, 10, 3}, {10, 8, 3}, {10, 8, 6}, {10, 20, 6}}});
  const TileSet tiles = town.tiles();
  // The wall below the soffit hides all that is below its upper border
  EXPECT_EQ(test::edges_of(tiles, EdgeRole::grounded), test::as_set({{{10, 20, 6}, {20, 20, 6}}, {{10, 10, 3}, {20, 10, 3}}}));
  EXPECT_EQ(test::edges_of(tiles, EdgeRole::overhang),
            test::as_set({{{10, 8, 6}, {20, 8, 6}}, {{10, 8, 6}, {10, 20, 6}}, {{20, 8, 6}, {20, 20, 6}}}));
  EXPECT_EQ(test::edges_of(tiles, EdgeRole::underside),
            test::as_set({{{10, 8, 3}, {20, 8, 3}}, {{10, 8, 3}, {10, 10, 3}}, {{20, 8, 3}, {20, 10, 3}}}));
}

TEST(GroundedWalls, OfAnOpenShellKeepThreeEdgesOfItsRoofGrounded) {
  test::SmallTown town;
  auto shell = test::box(10, 10, 20, 20, 0, 5);
  shell.erase(shell.begin() + 1);  // the south wall
  town.add("shell", shell);
  const TileSet tiles = town.tiles();
  EXPECT_EQ(test::edges_of(tiles, EdgeRole::grounded).size(), 3U);
  const std::vector<Segment3d> front{{{10, 10, 5}, {20, 10, 5}}};
  EXPECT_EQ(test::edges_of(tiles, EdgeRole::overhang), front);
  EXPECT_EQ(test::edges_of(tiles, EdgeRole::underside), front);
}

}  // namespace
}  // namespace farlod::tiles
