// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/vertical_profile.hpp"

#include <gtest/gtest.h>

// What a profile concludes from the surfaces that it crosses.

namespace farlod {
namespace {

constexpr std::uint32_t ground = package::no_building;
constexpr VerticalProfile::Crossing ground_at(float height_m) { return {height_m, ground, 0, true}; }
constexpr VerticalProfile::Crossing floor_at(float height_m, std::uint32_t building, std::uint16_t part = 0) {
  return {height_m, building, part, false};
}
constexpr VerticalProfile::Crossing roof_at(float height_m, std::uint32_t building, std::uint16_t part = 0) {
  return {height_m, building, part, true};
}

TEST(VerticalProfile, NothingHasNoHeights) {
  const VerticalProfile empty;
  EXPECT_EQ(empty.ground_m(), std::nullopt);
  EXPECT_EQ(empty.highest_m(), std::nullopt);
  EXPECT_FALSE(empty.is_inside_building(0.0F));
}

TEST(VerticalProfile, AHouseStandsOnTheGround) {
  const VerticalProfile house({floor_at(0.9F, 4), ground_at(1.0F), roof_at(7.0F, 4)});
  EXPECT_EQ(house.ground_m(), 1.0F);
  EXPECT_EQ(house.highest_m(), 7.0F);
  EXPECT_TRUE(house.is_inside_building(2.5F));
  EXPECT_FALSE(house.is_inside_building(7.5F));
  EXPECT_FALSE(house.is_inside_building(0.5F));
}

TEST(VerticalProfile, WithoutGroundThereIsNoGroundHeight) {
  const VerticalProfile house({floor_at(0.0F, 4), roof_at(7.0F, 4)});
  EXPECT_EQ(house.ground_m(), std::nullopt);
  EXPECT_EQ(house.highest_m(), 7.0F);
}

TEST(VerticalProfile, TheGroundEnclosesNothing) { EXPECT_FALSE(VerticalProfile({ground_at(1.0F)}).is_inside_building(0.5F)); }

TEST(VerticalProfile, BelowTheGroundAndInsideAreBuried) {
  const VerticalProfile house({floor_at(0.9F, 4), ground_at(1.0F), roof_at(7.0F, 4)});
  EXPECT_TRUE(house.is_buried(0.5F)) << "below floor and ground";
  EXPECT_TRUE(house.is_buried(2.5F));
  EXPECT_FALSE(house.is_buried(7.5F));
  EXPECT_FALSE(VerticalProfile({ground_at(1.0F)}).is_buried(1.0F)) << "on the ground";
  EXPECT_FALSE(VerticalProfile({floor_at(0.0F, 4)}).is_buried(-1.0F)) << "nobody knows where the ground is";
}

TEST(VerticalProfile, BelowAFloorOnAFoundationIsBuried) {
  // The foundation's lid is the floor once more, as a part of its own
  const VerticalProfile house({ground_at(0.0F), floor_at(3.0F, 4), roof_at(3.0F, 4, 1), roof_at(9.0F, 4)});
  EXPECT_TRUE(house.is_buried(1.5F));
  EXPECT_TRUE(house.is_buried(5.0F));
  EXPECT_FALSE(house.is_buried(9.5F));
}

TEST(VerticalProfile, BetweenTheGroundAndAFloorThatStandsOnItIsBuried) {
  const VerticalProfile house({ground_at(34.58F), floor_at(34.627F, 4), roof_at(41.7F, 4)});
  EXPECT_TRUE(house.is_buried(34.59F));
  const VerticalProfile slab({ground_at(34.58F), floor_at(34.65F, 4), roof_at(41.7F, 4)});
  EXPECT_FALSE(slab.is_buried(34.59F)) << "it does not stand on the ground";
}

TEST(VerticalProfile, UnderABridgeIsOutside) {
  const VerticalProfile bridge({ground_at(0.0F), floor_at(5.0F, 4), roof_at(6.0F, 4)});
  EXPECT_FALSE(bridge.is_inside_building(1.5F));
  EXPECT_TRUE(bridge.is_inside_building(5.5F));
  EXPECT_FALSE(bridge.is_inside_building(6.5F));
  EXPECT_EQ(bridge.ground_m(), 0.0F);
}

TEST(VerticalProfile, OverlappingBuildingsAreCountedApart) {
  // Counted together, there would be two surfaces above, as under a bridge
  const VerticalProfile two({floor_at(0.0F, 4), floor_at(0.0F, 9), roof_at(6.0F, 4), roof_at(8.0F, 9)});
  EXPECT_TRUE(two.is_inside_building(3.0F));
  EXPECT_TRUE(two.is_inside_building(7.0F));
  EXPECT_FALSE(two.is_inside_building(9.0F));
}

TEST(VerticalProfile, OverlappingPartsOfABuildingAreCountedApart) {
  const VerticalProfile two({floor_at(0.0F, 4, 0), floor_at(0.0F, 4, 1), roof_at(6.0F, 4, 0), roof_at(8.0F, 4, 1)});
  EXPECT_TRUE(two.is_inside_building(3.0F));
  EXPECT_TRUE(two.is_inside_building(7.0F));
}

TEST(VerticalProfile, AnEdgeThatTwoTrianglesShareIsOneSurface) {
  const VerticalProfile edge({floor_at(0.0F, 4), floor_at(0.0F, 4), roof_at(6.0F, 4), roof_at(6.00005F, 4)});
  EXPECT_TRUE(edge.is_inside_building(3.0F));
  EXPECT_FALSE(edge.is_inside_building(7.0F));
}

TEST(VerticalProfile, AThinSlabIsTwoSurfaces) {
  // Millimetres apart, but looking up and down: two surfaces above, hence outside
  const VerticalProfile slab({floor_at(5.0F, 4), roof_at(5.0003F, 4)});
  EXPECT_FALSE(slab.is_inside_building(3.0F));
}

TEST(VerticalProfile, FloorsWithinABuildingDoNotMatter) {
  const VerticalProfile storeys({floor_at(0.0F, 4), floor_at(3.0F, 4), roof_at(3.2F, 4), roof_at(6.0F, 4)});
  EXPECT_TRUE(storeys.is_inside_building(1.0F));
  EXPECT_TRUE(storeys.is_inside_building(5.0F));
}

}  // namespace
}  // namespace farlod
