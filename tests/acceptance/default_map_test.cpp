// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <map>

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
  folder.must("farlod-svf a.farlod -o o.asc --grid 4");
  const RasterFile map = raster("o.asc");
  const double width_m = pixel_m * static_cast<double>(map.columns), height_m = pixel_m * static_cast<double>(map.rows);
  const double about_m = pixel_m + 0.001;  // corners are written in whole millimetres
  EXPECT_NEAR(map.north_west.x, box.low.x - 50.0 - 0.5 * pixel_m, 0.5 * about_m);
  EXPECT_NEAR(map.north_west.y, box.high.y + 50.0 + 0.5 * pixel_m, 0.5 * about_m);
  EXPECT_NEAR(width_m, box.high.x - box.low.x + 100.0 + pixel_m, about_m);
  EXPECT_NEAR(height_m, box.high.y - box.low.y + 100.0 + pixel_m, about_m);
  folder.must("farlod-svf a.farlod -o city.asc --grid 4 --bbox city");
  EXPECT_TRUE(folder.text_of("city.asc") == folder.text_of("o.asc"));
  const nlohmann::json info = nlohmann::json::parse(folder.run("farlod-info a.farlod --json").out);
  const auto& tells = info.at("buildings_m");
  EXPECT_NEAR(norm(Point2d{tells[0], tells[1]} - box.low) + norm(Point2d{tells[2], tells[3]} - box.high), 0.0, 0.004);
}

TEST_F(PackedTown, TheDefaultMapHasTheValuesOfTheWholeGrid) {
  folder.must("farlod-svf a.farlod -o city.asc --grid 4");
  folder.must("farlod-svf a.farlod -o grid.asc --grid 4 --bbox grid");
  const RasterFile city = raster("city.asc"), grid = raster("grid.asc");
  EXPECT_GT(grid.values.size(), city.values.size());
  std::map<std::pair<long, long>, std::optional<float>> of_grid;
  const auto place_of = [](const RasterFile& map, std::size_t n) {
    const Point2d centre = map.centre_of(n);
    return std::pair(std::lround(centre.x / 0.1), std::lround(centre.y / 0.1));
  };
  for (std::size_t n = 0; n < grid.values.size(); ++n) of_grid[place_of(grid, n)] = grid.values[n];
  std::size_t compared = 0;
  for (std::size_t n = 0; n < city.values.size(); ++n) {
    const auto found = of_grid.find(place_of(city, n));
    if (found == of_grid.end()) continue;
    EXPECT_EQ(city.values[n], found->second) << n;
    ++compared;
  }
  EXPECT_GT(compared, city.values.size() / 2);
}

TEST_F(PackedTown, ADefaultMapIsVerifiedWhereItIs) {
  const auto& [west, south, east, north] =
      nlohmann::json::parse(folder.run("farlod-info a.farlod --json").out).at("city_m").get<std::array<double, 4>>();
  folder.must("farlod-svf a.farlod -o o.asc --grid 4 --verify 300 --verify-map errors.csv");
  const CsvTable verified = table("errors.csv");
  ASSERT_EQ(verified.size(), 300);
  for (std::size_t n = 0; n < verified.size(); ++n) {
    const double x_m = verified.number(n, "x_m"), y_m = verified.number(n, "y_m");
    EXPECT_TRUE(x_m > west - pixel_m && x_m < east + pixel_m && y_m > south - pixel_m && y_m < north + pixel_m)
        << x_m << ' ' << y_m;
  }
}

TEST_F(PackedTown, PixelsBeyondTheGridAreAnsweredAsPointsAre) {
  folder.must("farlod-svf a.farlod -o o.asc --grid 16 --bbox grid --summary s.json");
  EXPECT_GT(folder.json_of("s.json").at("receivers_outside_of_grid"), 10);
  folder.must("farlod-svf a.farlod -o exact.asc --grid 16 --bbox grid --engine exact --rays 20000");
  const RasterFile map = raster("o.asc"), exact = raster("exact.asc");
  std::string points = "x,y\n";
  for (std::size_t n = 0; n < map.values.size(); ++n) points += text_of(map.centre_of(n)) + "\n";
  folder.write("p.csv", points);
  folder.must("farlod-svf a.farlod -o p_out.csv --points p.csv --bounds");
  const CsvTable answers(folder.text_of("p_out.csv"));
  std::size_t beyond = 0;
  for (std::size_t n = 0; n < map.values.size(); ++n) {
    ASSERT_EQ(map.values[n].has_value(), exact.values[n].has_value());
    if (!map.values[n]) continue;
    EXPECT_NEAR(*map.values[n], *exact.values[n], 0.004);
    EXPECT_NEAR(*map.values[n], answers.number(n, "svf"), 0.001) << "bounds hold estimates";
    const double of_rays = 0.002;
    EXPECT_LE(answers.number(n, "svf_low"), *exact.values[n] + of_rays);
    EXPECT_GE(answers.number(n, "svf_high"), *exact.values[n] - of_rays);
    const Point2d p_town = GridRotation(town_bearing).grid_from_city(map.centre_of(n) - town_middle);
    beyond += std::max(std::abs(p_town.x), std::abs(p_town.y)) > town_half_m + 150.0 ? 1U : 0U;
  }
  EXPECT_GT(beyond, 0U);
}

}  // namespace
}  // namespace farlod::acceptance
