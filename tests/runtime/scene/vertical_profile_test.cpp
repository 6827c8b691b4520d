// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/vertical_profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"

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

TEST(VerticalProfile, HasTheHeightsOfGroundAndRoof) {
  const VerticalProfile empty, house({floor_at(0.9F, 4), ground_at(1.0F), roof_at(7.0F, 4)}),
      without_ground({floor_at(0.0F, 4), roof_at(7.0F, 4)}), bridge({ground_at(0.0F), floor_at(5.0F, 4), roof_at(6.0F, 4)});
  EXPECT_EQ(std::pair(empty.ground_m(), empty.highest_m()), (std::pair<std::optional<float>, std::optional<float>>{}));
  EXPECT_EQ(std::pair(house.ground_m(), house.highest_m()), std::pair(std::optional(1.0F), std::optional(7.0F)));
  EXPECT_EQ(std::pair(without_ground.ground_m(), without_ground.highest_m()),
            std::pair(std::optional<float>(), std::optional(7.0F)));
  EXPECT_EQ(bridge.ground_m(), 0.0F);
}

/// Heights of which something holds, and others of which it does not.
struct Column {
  const char* name;
  std::vector<VerticalProfile::Crossing> crossings;
  std::vector<float> yes, no;
};

TEST(VerticalProfile, SaysWhatIsInsideABuilding) {
  const Column columns[] = {
      {"nothing", {}, {}, {0.0F}},
      {"a house", {floor_at(0.9F, 4), ground_at(1.0F), roof_at(7.0F, 4)}, {2.5F}, {0.5F, 7.5F}},
      {"the ground encloses nothing", {ground_at(1.0F)}, {}, {0.5F}},
      {"a bridge", {ground_at(0.0F), floor_at(5.0F, 4), roof_at(6.0F, 4)}, {5.5F}, {1.5F, 6.5F}},
      // Counted together, there would be two surfaces above, as under a bridge
      {"two buildings", {floor_at(0, 4), floor_at(0, 9), roof_at(6, 4), roof_at(8, 9)}, {3.0F, 7.0F}, {9.0F}},
      {"two parts", {floor_at(0, 4, 0), floor_at(0, 4, 1), roof_at(6, 4, 0), roof_at(8, 4, 1)}, {3.0F, 7.0F}, {}},
      {"an edge of two triangles", {floor_at(0, 4), floor_at(0, 4), roof_at(6, 4), roof_at(6.00005F, 4)}, {3.0F}, {7.0F}},
      // Millimetres apart, but looking up and down: two surfaces above, hence outside
      {"a thin slab", {floor_at(5.0F, 4), roof_at(5.0003F, 4)}, {}, {3.0F}},
      {"floors within a building", {floor_at(0, 4), floor_at(3, 4), roof_at(3.2F, 4), roof_at(6, 4)}, {1.0F, 5.0F}, {}}};
  for (const auto& [name, crossings, yes, no] : columns) {
    for (const float m : yes) EXPECT_TRUE(VerticalProfile(crossings).is_inside_building(m)) << name << ", " << m;
    for (const float m : no) EXPECT_FALSE(VerticalProfile(crossings).is_inside_building(m)) << name << ", " << m;
  }
}

TEST(VerticalProfile, SaysWhatIsBuried) {
  const Column columns[] = {
      {"below floor and ground, and inside", {floor_at(0.9F, 4), ground_at(1.0F), roof_at(7, 4)}, {0.5F, 2.5F}, {7.5F}},
      {"on the ground", {ground_at(1.0F)}, {}, {1.0F}},
      {"nobody knows where the ground is", {floor_at(0.0F, 4)}, {}, {-1.0F}},
      // The foundation's lid is the floor once more, as a part of its own
      {"on a foundation", {ground_at(0), floor_at(3, 4), roof_at(3, 4, 1), roof_at(9, 4)}, {1.5F, 5.0F}, {9.5F}},
      {"a floor on the ground", {ground_at(34.58F), floor_at(34.627F, 4), roof_at(41.7F, 4)}, {34.59F}, {}},
      {"a floor above the ground", {ground_at(34.58F), floor_at(34.65F, 4), roof_at(41.7F, 4)}, {}, {34.59F}}};
  for (const auto& [name, crossings, yes, no] : columns) {
    for (const float m : yes) EXPECT_TRUE(VerticalProfile(crossings).is_buried(m)) << name << ", " << m;
    for (const float m : no) EXPECT_FALSE(VerticalProfile(crossings).is_buried(m)) << name << ", " << m;
  }
}

// Vertical profiles of packed cities, at places where geometry is at its most awkward. Ground at 0, and no height needs rounding.

constexpr double cell_m = 16.0;
constexpr auto edge = static_cast<float>(cell_m);

class PackedLocator {
 public:
  explicit PackedLocator(const CityModel& city, Assign assign = Assign::clip)
      : grid_(scenes::grid_covering(city, {}, cell_m, 1)), package_(packed(city, assign)) {}

  [[nodiscard]] VerticalProfile at(double x_grid, double y_grid) const {
    const Cell cell = grid_.cell_of({x_grid, y_grid});
    const Point2d corner = grid_.corner_of(cell);
    return at(cell, static_cast<float>(x_grid - corner.x), static_cast<float>(y_grid - corner.y));
  }
  [[nodiscard]] VerticalProfile at(Cell cell, float x_cell, float y_cell) const {
    return PointLocator(package_, cell).at(x_cell, y_cell);
  }
  [[nodiscard]] const Grid& grid() const { return grid_; }

 private:
  PackageReader packed(const CityModel& city, Assign assign) const {
    scenes::pack_city(city, grid_, folder_.path() / "city.farlod", scenes::box_maps(1, 1), assign);
    return PackageReader(folder_.path() / "city.farlod");
  }
  scenes::TemporaryFolder folder_;
  Grid grid_;
  PackageReader package_;
};

void expect_house(const VerticalProfile& profile, float roof_m, const char* where) {
  EXPECT_EQ(profile.ground_m(), 0.0F) << where;
  EXPECT_EQ(profile.highest_m(), roof_m) << where;
  EXPECT_TRUE(profile.is_inside_building(0.5F * roof_m)) << where;
  EXPECT_FALSE(profile.is_inside_building(roof_m + 0.5F)) << where;
}

void expect_street(const VerticalProfile& profile, const char* where) {
  EXPECT_EQ(profile.ground_m(), 0.0F) << where;
  EXPECT_EQ(profile.highest_m(), 0.0F) << where;
  EXPECT_FALSE(profile.is_inside_building(1.5F)) << where;
}

/// A house of three by three cells' corners: every border and corner of cell (1, 1) runs through it.
CityModel house_over_borders() {
  scenes::SceneBuilder builder;
  builder.add_box({{4.0, 4.0}, {44.0, 44.0}}, 0.0, 8.0);
  return builder.city();
}

TEST(LocatorPlaces, InAndBesideAHouse) {
  const PackedLocator locator(house_over_borders());
  expect_house(locator.at(5.0, 7.25), 8.0F, "near the wall");
  expect_house(locator.at(24.5, 29.75), 8.0F, "in the middle");
  expect_street(locator.at(2.0, 24.0), "west of it");
  expect_street(locator.at(46.5, 45.0), "north-east of it");
}

TEST(LocatorPlaces, OnTheEdgesBetweenTheTrianglesOfARoof) {
  const PackedLocator locator(house_over_borders());
  // Both diagonals of the roof, and of each of its pieces: one of the two is an edge
  for (double t = 0.25; t < 40.0; t += 0.25) {
    expect_house(locator.at(4.0 + t, 4.0 + t), 8.0F, "rising diagonal");
    expect_house(locator.at(4.0 + t, 44.0 - t), 8.0F, "falling diagonal");
  }
}

TEST(LocatorPlaces, OnTheBordersOfTheGrid) {
  const PackedLocator locator(house_over_borders());
  for (const double border : {16.0, 32.0})
    for (double t = 4.25; t < 44.0; t += 0.25) {
      expect_house(locator.at(border, t), 8.0F, "a border from south to north");
      expect_house(locator.at(t, border), 8.0F, "a border from west to east");
    }
}

TEST(LocatorPlaces, OnTheFarSideOfACellWhereFloatsRoundOntoTheBorder) {
  const PackedLocator locator(house_over_borders());
  for (const float last : {std::nextafter(edge, 0.0F), edge})
    for (float t = 0.0F; t <= edge; t += 0.25F) {
      expect_house(locator.at({1, 1}, last, t), 8.0F, "east side");
      expect_house(locator.at({1, 1}, t, last), 8.0F, "north side");
    }
}

/// A building around a court: its roof and floor have a hole.
CityModel house_with_court() {
  CityModel city;
  city.begin_building("court");
  std::uint32_t surface = 0;
  const auto ring = [](double low, double high, double z) {
    return std::vector<Point3d>{{low, low, z}, {high, low, z}, {high, high, z}, {low, high, z}};
  };
  const auto walls = [&](double low, double high) {
    const std::vector<Point3d> base = ring(low, high, 0.0), top = ring(low, high, 8.0);
    for (std::size_t n = 0; n < 4; ++n) {
      city.begin_facet(SurfaceKind::wall, surface++);
      city.add_ring(std::vector<Point3d>{base[n], base[(n + 1) % 4], top[(n + 1) % 4], top[n]});
    }
  };
  for (const auto& [kind, z] : {std::pair(SurfaceKind::floor, 0.0), std::pair(SurfaceKind::roof, 8.0)}) {
    city.begin_facet(kind, surface++);
    city.add_ring(ring(4.0, 44.0, z));
    city.add_ring(ring(14.0, 34.0, z));
  }
  walls(4.0, 44.0);
  walls(14.0, 34.0);
  return city;
}

TEST(LocatorPlaces, ACourtIsOutside) {
  const PackedLocator locator(house_with_court());
  expect_street(locator.at(24.0, 24.0), "in the court");
  expect_street(locator.at(16.0, 16.0), "in the court, where cells meet");
  expect_house(locator.at(9.0, 24.0), 8.0F, "in the west wing");
  expect_house(locator.at(24.0, 39.0), 8.0F, "in the north wing");
}

TEST(LocatorPlaces, UnderABridge) {
  scenes::SceneBuilder builder;
  builder.add_box({{2.0, 2.0}, {8.0, 14.0}}, 0.0, 12.0);
  builder.add_box({{40.0, 2.0}, {46.0, 14.0}}, 0.0, 12.0);
  builder.add_box({{8.0, 6.0}, {40.0, 10.0}}, 6.0, 8.0);
  const PackedLocator locator(builder.city());
  for (const double x : {12.0, 16.0, 24.0, 31.5}) {
    const VerticalProfile profile = locator.at(x, 8.0);
    EXPECT_EQ(profile.ground_m(), 0.0F) << "the bridge does not stand on the ground";
    EXPECT_EQ(profile.highest_m(), 8.0F);
    EXPECT_FALSE(profile.is_inside_building(1.5F)) << x;
    EXPECT_TRUE(profile.is_inside_building(7.0F)) << x;
    EXPECT_FALSE(profile.is_inside_building(9.0F)) << x;
  }
}

TEST(LocatorPlaces, WhereHousesOverlap) {
  scenes::SceneBuilder builder;
  builder.add_box({{2.0, 2.0}, {20.0, 14.0}}, 0.0, 8.0);
  builder.add_box({{10.0, 2.0}, {30.0, 14.0}}, 0.0, 12.0);
  const PackedLocator locator(builder.city());
  for (const double x : {11.0, 16.0, 19.0}) expect_house(locator.at(x, 8.0), 12.0F, "in both");
  expect_house(locator.at(5.0, 8.0), 8.0F, "in the first");
  expect_house(locator.at(25.0, 8.0), 12.0F, "in the second");
}

TEST(LocatorPlaces, BuildingsAssignedWholeReachIntoTheirNeighbors) {
  const PackedLocator locator(house_over_borders(), Assign::whole);
  // The house belongs to cell (1, 1); these places lie in others
  for (const auto& [x, y] : {std::pair(5.0, 5.0), std::pair(40.0, 40.0), std::pair(24.0, 5.0), std::pair(16.0, 32.0)})
    expect_house(locator.at(x, y), 8.0F, "beyond the cell of the house");
  expect_street(locator.at(2.0, 24.0), "west of it");
}

}  // namespace
}  // namespace farlod
