// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "receivers/point_receivers.hpp"

#include <gmock/gmock.h>

#include <numeric>

#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"

namespace farlod {
namespace {

using testing::ElementsAre;

constexpr double cell_m = 16.0;
/// Heights above the package's origin are below 64 m; a column rounds them twice on the way up its ray and once to the sum, the
/// disk once, in slopes once for each coordinate.
constexpr float rounding_m = 8 * 64.0F * std::numeric_limits<float>::epsilon();

/// A slope that rises from 100 m at the west to 107.75 m at the east, a metre every four; with and without a house.
class Slope : public testing::Test {
 protected:
  Slope() : slope_(packed(false)), with_house_(packed(true)) {}

  static double ground_at(double x) { return 100.0 + 0.25 * x; }

  PackageReader packed(bool with_house) const {
    scenes::SceneBuilder builder;
    // Two low kerbs tell where the ground is
    for (const double x : {0.0, 31.0}) {
      const double low = ground_at(x);
      builder.add_polygon({{x, 0.0, low}, {x, 31.0, low}, {x, 31.0, low + 0.001}, {x, 0.0, low + 0.001}});
    }
    if (with_house) builder.add_box({{18.0, 10.0}, {24.0, 16.0}}, 103.0, 115.0);
    const Grid grid = scenes::grid_covering(builder.city(), {}, cell_m, 1, 4);
    const auto folder = folder_.path() / (with_house ? "house.farlod" : "slope.farlod");
    scenes::pack_city(builder.city(), grid, folder, scenes::box_maps(1, 1));
    return PackageReader(folder);
  }

  /// All receivers at some places, by their index; heights absolute.
  static std::map<std::size_t, double> heights_of(const PackageReader& package, const std::vector<PlaceOfReceiver>& places,
                                                  HeightAbove above, float height_m) {
    std::map<std::size_t, double> heights;
    for (const auto& [cell, chosen] : places_by_cell(package, places))
      for (const Receiver& r : receivers_at(package, cell, places, chosen, above, height_m).receivers) {
        EXPECT_EQ(package.grid().corner_of(cell).x + r.p_cell.x, places[r.index].p_projected.x);
        EXPECT_EQ(package.grid().corner_of(cell).y + r.p_cell.y, places[r.index].p_projected.y);
        heights[r.index] = r.p_cell.z + package.manifest().height_origin_m;
      }
    return heights;
  }

  scenes::TemporaryFolder folder_;
  PackageReader slope_, with_house_;
};

TEST_F(Slope, PlacesComeByCellInTheirOrder) {
  const std::vector<PlaceOfReceiver> places{{{20, 3}, {}}, {{3, 3}, {}}, {{-5, 3}, {}}, {{17, 4}, {}}, {{3, 20}, {}}};
  const auto by_cell = places_by_cell(slope_, places);
  ASSERT_EQ(by_cell.size(), 4U);
  EXPECT_EQ(by_cell[0].first, (Cell{-1, 0}));
  EXPECT_THAT(by_cell[1].second, ElementsAre(1U));
  EXPECT_THAT(by_cell[2].second, ElementsAre(4U));
  EXPECT_EQ(by_cell[3].first, (Cell{1, 0}));
  EXPECT_THAT(by_cell[3].second, ElementsAre(0U, 3U));
}

TEST_F(Slope, ReceiversStandOnTheGround) {
  const std::vector<PlaceOfReceiver> places{{{4, 3}, {}}, {{12, 25}, {}}, {{16, 8}, {}}, {{28, 16}, {}}};
  const auto heights = heights_of(slope_, places, HeightAbove::ground, 1.5F);
  ASSERT_EQ(heights.size(), places.size());
  for (const auto& [n, height] : heights) EXPECT_NEAR(height, ground_at(places[n].p_projected.x) + 1.5, rounding_m);
}

TEST_F(Slope, AnAbsoluteHeightIsTaken) {
  const std::vector<PlaceOfReceiver> places{{{4, 3}, 123.25}, {{-40, 3}, 123.25}};
  const auto heights = heights_of(with_house_, places, HeightAbove::ground, 1.5F);
  EXPECT_EQ(heights.at(0), 123.25);
  EXPECT_EQ(heights.at(1), 123.25);
}

TEST_F(Slope, InsideAHouseIsNowhere) {
  const std::vector<PlaceOfReceiver> places{{{20, 12}, {}}, {{20, 12}, 110.0}, {{20, 12}, 116.0}, {{17, 12}, {}}};
  const auto heights = heights_of(with_house_, places, HeightAbove::ground, 1.5F);
  EXPECT_FALSE(heights.contains(0));
  EXPECT_FALSE(heights.contains(1));
  EXPECT_TRUE(heights.contains(2)) << "above the roof";
  EXPECT_TRUE(heights.contains(3)) << "beside the wall";
}

TEST_F(Slope, OnTheSurfaceIsOnTheRoof) {
  const std::vector<PlaceOfReceiver> places{{{20, 12}, {}}};
  EXPECT_NEAR(heights_of(with_house_, places, HeightAbove::highest_surface, 0.5F).at(0), 115.5, rounding_m);
}

TEST_F(Slope, OutsideOfTheGridTheGroundIsThatOfItsBorder) {
  const std::vector<PlaceOfReceiver> inside{{{0.0, 5}, {}}}, outside{{{-300, 5}, {}}, {{-1, 5}, {}}};
  const double at_border = heights_of(slope_, inside, HeightAbove::ground, 1.5F).at(0);
  EXPECT_NEAR(at_border, 101.5, rounding_m);
  for (const auto& [n, height] : heights_of(slope_, outside, HeightAbove::ground, 1.5F)) EXPECT_EQ(height, at_border) << n;
  EXPECT_EQ(heights_of(slope_, outside, HeightAbove::ground, 1.5F).size(), outside.size());
}

TEST(PointReceivers, OutsideOfTheGridNobodyStandsInAHouse) {
  scenes::SceneBuilder builder;
  // Its west and south walls stand on the grid's border, behind which the receivers are
  builder.add_box({{0.0, 0.0}, {12.0, 12.0}}, 0.0, 8.0);
  const scenes::TemporaryFolder folder;
  const Grid grid = scenes::grid_covering(builder.city(), {}, cell_m, 1, 4);
  scenes::pack_city(builder.city(), grid, folder.path() / "edge.farlod", scenes::box_maps(1, 1));
  const PackageReader package(folder.path() / "edge.farlod");
  const std::vector<PlaceOfReceiver> places{{{-100.0, 8.0}, {}}, {{8.0, -100.0}, {}}, {{-100.0, 8.0}, 4.0}};
  std::size_t count = 0;
  for (const auto& [cell, chosen] : places_by_cell(package, places))
    count += receivers_at(package, cell, places, chosen, HeightAbove::ground, 1.5F).receivers.size();
  EXPECT_EQ(count, places.size());
}

}  // namespace
}  // namespace farlod
