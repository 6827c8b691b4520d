// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>

#include "base/frame.hpp"
#include "farlod/box.hpp"
#include "tests/acceptance/packed_town.hpp"

namespace farlod::acceptance {
namespace {

constexpr double pixel_m = 4.0;

TEST_F(PackedTown, TheDefaultMapIsTheBoxOfTheBuildingsAndFiftyMetres) {
  Box2d box;
  for (const Block& b : small_town())
    for (const Point2d corner : {Point2d{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
      box.add(p_projected(b.centre + b.edge_m * corner));
  folder.must("farlod-svf a.farlod -o o.asc --grid 4 --summary s.json");
  const RasterFile map = raster("o.asc");
  const double width_m = pixel_m * static_cast<double>(map.columns), height_m = pixel_m * static_cast<double>(map.rows);
  const double about_m = pixel_m + 0.001;  // corners are written in whole millimetres
  EXPECT_NEAR(map.north_west.x, box.low.x - 50.0 - 0.5 * pixel_m, 0.5 * about_m);
  EXPECT_NEAR(map.north_west.y, box.high.y + 50.0 + 0.5 * pixel_m, 0.5 * about_m);
  EXPECT_NEAR(width_m, box.high.x - box.low.x + 100.0 + pixel_m, about_m);
  EXPECT_NEAR(height_m, box.high.y - box.low.y + 100.0 + pixel_m, about_m);
  // Parts of it lie beyond the grid, which is turned: only buildings have no answers
  const auto summary = folder.json_of("s.json");
  EXPECT_GT(summary.at("receivers_outside_of_grid"), 100);
  for (std::size_t n = 0; n < map.values.size(); ++n) {
    if (map.values[n]) continue;
    const Point2d p_town = GridRotation(town_bearing).grid_from_city(map.centre_of(n) - town_middle);
    EXPECT_LE(std::max(std::abs(p_town.x), std::abs(p_town.y)), town_half_m);
  }
  folder.must("farlod-svf a.farlod -o city.asc --grid 4 --bbox city");
  EXPECT_TRUE(folder.text_of("city.asc") == folder.text_of("o.asc"));
  const nlohmann::json info = nlohmann::json::parse(folder.run("farlod-info a.farlod --json").out);
  const auto& tells = info.at("buildings_m");
  EXPECT_NEAR(norm(Point2d{tells[0], tells[1]} - box.low) + norm(Point2d{tells[2], tells[3]} - box.high), 0.0, 0.004);
}

TEST_F(PackedTown, PixelsBeyondTheGridAreAnsweredAsPointsAre) {
  folder.must("farlod-svf a.farlod -o o.asc --grid 16 --bbox grid");
  const RasterFile map = raster("o.asc");
  std::string points = "x,y\n";
  for (std::size_t n = 0; n < map.values.size(); ++n) points += text_of(map.centre_of(n)) + "\n";
  folder.write("p.csv", points);
  folder.must("farlod-svf a.farlod -o p_out.csv --points p.csv --engine exact");
  folder.must("farlod-svf a.farlod -o exact.asc --grid 16 --bbox grid --engine exact");
  const RasterFile exact = raster("exact.asc");
  const CsvTable answers(folder.text_of("p_out.csv"));
  std::size_t equal = 0, beyond = 0;
  for (std::size_t n = 0; n < map.values.size(); ++n) {
    ASSERT_EQ(map.values[n].has_value(), exact.values[n].has_value());
    if (!map.values[n]) continue;
    EXPECT_NEAR(*map.values[n], *exact.values[n], 0.01);
    EXPECT_NEAR(*exact.values[n], answers.number(n, "svf"), 1e-6);
    const Point2d p_town = GridRotation(town_bearing).grid_from_city(map.centre_of(n) - town_middle);
    if (std::max(std::abs(p_town.x), std::abs(p_town.y)) < town_half_m + 150.0) continue;
    ++beyond;
    equal += *map.values[n] == *exact.values[n] ? 1U : 0U;
  }
  EXPECT_GT(beyond, 0U);
  EXPECT_EQ(equal, beyond) << "beyond the grid, rays are traced against the whole city by all engines";
}

}  // namespace
}  // namespace farlod::acceptance
