// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <map>

#include "base/frame.hpp"
#include "farlod/box.hpp"
#include "farlod/error.hpp"
#include "tests/acceptance/packed_town.hpp"

namespace farlod::acceptance {
namespace {

constexpr double pixel_m = 4.0;

Box2d box_of(const std::vector<Block>& town) {
  Box2d box;
  for (const Block& b : town)
    for (const Point2d corner : {Point2d{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
      box.add(p_projected(b.centre + b.edge_m * corner));
  return box;
}

/// The town's box is as wide as high.
TEST_F(PackedTown, TheDefaultMapIsTheBoxOfTheBuildingsAndAThirtiethOfItsSides) {
  const Box2d box = box_of(small_town());
  const double side_m = box.high.x - box.low.x, margin_m = side_m / 30.0;
  folder.must("farlod-svf a.farlod -o o.asc --grid 4");
  const RasterFile map = raster("o.asc");
  const double width_m = pixel_m * static_cast<double>(map.columns), height_m = pixel_m * static_cast<double>(map.rows);
  const double about_m = pixel_m + 0.001;  // corners are written in whole millimetres
  EXPECT_NEAR(map.north_west.x, box.low.x - margin_m - 0.5 * pixel_m, 0.5 * about_m);
  EXPECT_NEAR(map.north_west.y, box.high.y + margin_m + 0.5 * pixel_m, 0.5 * about_m);
  EXPECT_NEAR(width_m, side_m + 2.0 * margin_m + pixel_m, about_m);
  EXPECT_NEAR(height_m, side_m + 2.0 * margin_m + pixel_m, about_m);
  EXPECT_GT(side_m * side_m, 0.8 * width_m * height_m);
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

TEST_F(PackedTown, ALoneHouseHasFiveMetresAround) {
  const Block house{"a", {0.0, 0.0}, 10.0, 6.0};
  folder.write("house.geojson", footprints_geojson({house}));
  folder.must("farlod-pack house.geojson -o house.farlod");
  folder.must("farlod-svf house.farlod -o o.asc --grid 1 --summary s.json");
  const Box2d box = box_of({house});
  const RasterFile map = raster("o.asc");
  EXPECT_NEAR(static_cast<double>(map.columns), box.high.x - box.low.x + 10.0 + 1.0, 1.001);
  EXPECT_GT(folder.json_of("s.json").at("receivers"), 200);
  EXPECT_EQ(folder.json_of("s.json").at("receivers_near_buildings"), folder.json_of("s.json").at("receivers"));
}

/// What the map and the blocks say of the places within 20 m of a block: how many, and their mean.
struct NearBlocks {
  std::size_t count = 0;
  double sum = 0.0;

  NearBlocks(const RasterFile& map, const std::vector<Block>& town) {
    for (std::size_t n = 0; n < map.values.size(); ++n) {
      const Point2d p_town = GridRotation(town_bearing).grid_from_city(map.centre_of(n) - town_middle);
      const auto is_near = [&](const Block& b) {
        const auto off_m = [&](double x, double centre) { return std::max(std::abs(x - centre) - 0.5 * b.edge_m, 0.0); };
        return std::hypot(off_m(p_town.x, b.centre.x), off_m(p_town.y, b.centre.y)) <= 20.0;
      };
      if (!map.values[n] || !std::ranges::any_of(town, is_near)) continue;
      ++count;
      sum += *map.values[n];
    }
  }
};

/// Where a run has the same receivers near buildings, it tells the same of them, to the last bit.
TEST_F(PackedTown, SummariesTellTheMeanWithinTwentyMetresOfBuildings) {
  const auto told_by = [&](const std::string& options) {
    const Outcome run = folder.run("farlod-svf a.farlod -o o.tif --grid 4 --summary s.json " + options);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const nlohmann::json summary = folder.json_of("s.json"), mean = summary.at("svf").at("mean_near_buildings");
    const std::string said = "; mean within 20 m of buildings ";
    const std::size_t place = run.out.find(said);
    EXPECT_EQ(place == std::string::npos, mean.is_null()) << run.out;
    if (!mean.is_null()) {
      EXPECT_NEAR(std::stod(run.out.substr(place + said.size())), mean.get<double>(), 0.5001e-4);
    }
    return std::pair(summary.at("receivers_near_buildings").get<std::size_t>(), mean.dump());
  };
  const auto whole = told_by("--bbox grid --threads 1");
  folder.must("farlod-svf a.farlod -o o.asc --grid 4 --bbox grid");
  const NearBlocks expected(raster("o.asc"), small_town());
  // Corners are written in whole millimetres: a pixel in a thousand may lie on the other side
  EXPECT_NEAR(static_cast<double>(whole.first), static_cast<double>(expected.count), 3.0);
  EXPECT_NEAR(std::stod(whole.second), expected.sum / static_cast<double>(expected.count), 1e-4);
  EXPECT_LT(expected.count, raster("o.asc").values.size() / 2);
  EXPECT_EQ(told_by("--bbox grid --threads 3"), whole);
  for (const char* shard : {"0/2", "1/2"})
    folder.must(std::string("farlod-svf a.farlod -o m.tif --grid 4 --bbox grid --shard ") + shard);
  folder.must("farlod-svf a.farlod -o m.tif --grid 4 --bbox grid --merge --summary m.json");
  EXPECT_EQ(folder.json_of("m.json").at("svf").at("mean_near_buildings").dump(), whole.second);
  EXPECT_EQ(told_by("--on-surface"), std::pair(std::size_t{0}, std::string("null")));
}

TEST_F(PackedTown, WithinTwentyMetresOfBuildingsIsWhatTheirMeanIsAbout) {
  folder.must("farlod-svf a.farlod -o all.asc --grid 4 --summary all.json");
  folder.must("farlod-svf a.farlod -o near.asc --grid 4 --within 20 --summary near.json");
  const nlohmann::json all = folder.json_of("all.json"), near = folder.json_of("near.json");
  EXPECT_EQ(near.at("receivers"), all.at("receivers_near_buildings"));
  EXPECT_EQ(near.at("svf").at("mean"), all.at("svf").at("mean_near_buildings"));
  const RasterFile of_all = raster("all.asc"), of_near = raster("near.asc");
  for (std::size_t n = 0; n < of_near.values.size(); ++n)
    if (of_near.values[n]) {
      ASSERT_EQ(of_near.values[n], of_all.values[n]);
    }
  folder.must("farlod-svf a.farlod -o near.asc --grid 4 --within 3 --summary nearest.json");
  EXPECT_LT(folder.json_of("nearest.json").at("receivers"), near.at("receivers"));
  EXPECT_GT(folder.json_of("nearest.json").at("receivers"), 50);
  expect_refusal(folder.run("farlod-svf a.farlod -o o.csv --within 3 --surfaces all"), exit_usage, {"--within", "--grid"});
}

/// Buildings beyond the box are near, too.
TEST_F(PackedTown, ABoxOfAMapKnowsTheBuildingsAroundIt) {
  const Point2d crossing = p_projected({0.0, 0.0}), low = crossing - Point2d{8.0, 8.0}, high = crossing + Point2d{8.0, 8.0};
  folder.must("farlod-svf a.farlod -o o.asc --grid 1 --summary s.json --bbox " + text_of(low) + "," + text_of(high));
  const NearBlocks expected(raster("o.asc"), small_town());
  EXPECT_GT(expected.count, 100U);
  EXPECT_EQ(folder.json_of("s.json").at("receivers_near_buildings"), expected.count);
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
