// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>
#include <cstddef>
#include <ios>
#include <sstream>
#include <string>
#include <vector>

#include "tests/acceptance/packed_town.hpp"

// farlod-info --cells, and --zones, as users type it

namespace farlod::acceptance {
namespace {

/// The town has 36 square blocks, each apart from the others.
TEST_F(PackedTown, TableOfCellsHasTheAreasOfTheBlocks) {
  folder.write("cells.csv", "what was there before");
  folder.must("farlod-info a.farlod --cells cells.csv --json > facts.json");
  const nlohmann::json grid = folder.json_of("facts.json").at("grid");
  const CsvTable cells = table("cells.csv");
  double plan_m2 = 0.0, walls_m2 = 0.0, cells_m2 = 0.0, windward_m2 = 0.0;
  for (std::size_t n = 0; n < cells.size(); ++n) {
    plan_m2 += cells.number(n, "building_plan_area_m2");
    walls_m2 += cells.number(n, "wall_area_m2");
    cells_m2 += cells.number(n, "area_m2");
    windward_m2 += cells.number(n, "area_m2") * cells.number(n, "lambda_f_090");
  }
  double expected_walls_m2 = 0.0;
  for (const Block& b : small_town()) expected_walls_m2 += 4.0 * b.edge_m * b.height_m;
  // Corners are written in whole millimetres, and shares with six digits
  EXPECT_NEAR(plan_m2, 36.0 * town_edge_m * town_edge_m, 1.0);
  EXPECT_NEAR(walls_m2, expected_walls_m2, 5.0);
  // A square of whichever turn shows the wind between one and √2 sides
  EXPECT_GT(windward_m2, 0.25 * expected_walls_m2 - 5.0);
  EXPECT_LT(windward_m2, 0.25 * std::sqrt(2.0) * expected_walls_m2 + 5.0);
  EXPECT_NEAR(cells_m2, grid.at("cell_count").get<double>() * std::pow(grid.at("cell_m").get<double>(), 2),
              0.01 * static_cast<double>(cells.size()));
}

#ifdef FARLOD_WITH_GDAL
TEST_F(PackedTown, TablesOfCellsAreTheSameInEachFormat) {
  folder.must("farlod-info a.farlod --cells cells.csv --quiet");
  const CsvTable cells = table("cells.csv");
  for (const char* name : {"cells.gpkg", "cells.geojson", "cells.fgb", "cells.nc"}) {
    folder.must("farlod-info a.farlod --quiet --cells " + std::string(name));
    EXPECT_TRUE(folder.has(name));
  }
  const nlohmann::json features = folder.json_of("cells.geojson").at("features");
  ASSERT_EQ(features.size(), cells.size());
  for (std::size_t n = 0; n < cells.size(); ++n) {
    const nlohmann::json& ring = features[n].at("geometry").at("coordinates")[0];
    EXPECT_EQ(ring.size(), 5U);
    EXPECT_EQ(ring.front(), ring.back());
    EXPECT_EQ(features[n].at("properties").at("lambda_p").get<double>(), cells.number(n, "lambda_p"));
    EXPECT_EQ(features[n].at("properties").at("lambda_f_022").get<double>(), cells.number(n, "lambda_f_022"));
  }
}

/// Two halves of a large square around the town, of which the eastern one has a hole at a corner of no block, and comes in two
/// parts.
class ZonesOfTown : public PackedTown {
 protected:
  ZonesOfTown() {
    const Point2d m = town_middle;
    const auto ring = [&](double west, double south, double east, double north) {
      return text_of_ring(
          {m + Point2d{west, south}, m + Point2d{east, south}, m + Point2d{east, north}, m + Point2d{west, north}});
    };
    folder.write("zones.geojson",
                 std::string(R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":")") + town_crs +
                     R"("}},"features":[{"type":"Feature","properties":{"name":"west","lambda_p":7},"geometry":)" +
                     R"({"type":"Polygon","coordinates":[)" + ring(-600, -600, 3.5, 600) +
                     R"(]}},{"type":"Feature","properties":{"name":"east","lambda_p":8},"geometry":)" +
                     R"({"type":"MultiPolygon","coordinates":[[)" + ring(3.5, -600, 600, 0) + "],[" + ring(3.5, 0, 600, 600) +
                     "," + ring(400, 400, 500, 500) + "]]}}]}");
  }
  static std::string text_of_ring(const std::vector<Point2d>& corners) {
    std::ostringstream text;
    text << std::fixed << "[";
    for (const Point2d p : corners) text << "[" << p.x << "," << p.y << "],";
    text << "[" << corners[0].x << "," << corners[0].y << "]]";
    return text.str();
  }
};

TEST_F(ZonesOfTown, HaveTheSumsOfTheCellsAndTheirFields) {
  folder.must("farlod-info a.farlod --cells cells.csv --quiet");
  folder.must("farlod-info a.farlod --cells zones.csv --zones zones.geojson --quiet");
  const CsvTable cells = table("cells.csv"), zones = table("zones.csv");
  ASSERT_EQ(zones.size(), 2U);
  for (const char* column : {"building_plan_area_m2", "roof_area_m2", "wall_area_m2", "building_volume_m3"}) {
    double of_cells = 0.0;
    for (std::size_t n = 0; n < cells.size(); ++n) of_cells += cells.number(n, column);
    EXPECT_NEAR(zones.number(0, column) + zones.number(1, column), of_cells, 0.001 * static_cast<double>(cells.size() + 2))
        << column;
    EXPECT_GT(zones.number(0, column), 0.4 * of_cells) << column;
  }
  EXPECT_EQ(zones.header()[0], "zone");
  const std::string of_cells = folder.run("farlod-info a.farlod --cells cells.csv").out;
  EXPECT_THAT(of_cells, testing::EndsWith("\ncells.csv: " + std::to_string(cells.size()) + " rows\n"));
  EXPECT_THAT(folder.run("farlod-info a.farlod --cells zones.csv --zones zones.geojson").out,
              testing::EndsWith("\nzones.csv: 2 rows\n"));
  EXPECT_EQ(zones.text(1, "zone"), "2");
  EXPECT_EQ(zones.text(1, "name"), "east");
  EXPECT_EQ(zones.text(1, "lambda_p_input"), "8") << "the file has a field that is called like a column";
  EXPECT_LT(zones.number(1, "lambda_p"), 1.0);
  EXPECT_NEAR(zones.number(1, "area_m2"), 596.5 * 1200.0 - 100.0 * 100.0, 0.01);
  EXPECT_NEAR(zones.number(0, "x_m"), town_middle.x - 298.25, 0.001);
  // A square of 100 m less, 450 − 301.75 m from the middle of the whole
  EXPECT_NEAR(zones.number(1, "x_m"), town_middle.x + 301.75 - 148.25 * 10000.0 / (596.5 * 1200.0 - 10000.0), 0.001);
}

TEST_F(ZonesOfTown, AreTheSameInEachFormat) {
  folder.must("farlod-info a.farlod --cells sky.csv --zones zones.geojson --svf 20 --quiet");
  for (std::size_t row = 0; row < 2; ++row) {
    EXPECT_GT(table("sky.csv").number(row, "svf_ground"), 0.3);
    EXPECT_LT(table("sky.csv").number(row, "svf_walls"), table("sky.csv").number(row, "svf_roofs"));
  }
  for (const char* name : {"zones.gpkg", "out.geojson", "zones.fgb", "zones.nc"})
    folder.must("farlod-info a.farlod --quiet --zones zones.geojson --cells " + std::string(name));
  const nlohmann::json features = folder.json_of("out.geojson").at("features");
  ASSERT_EQ(features.size(), 2U);
  EXPECT_EQ(features[0].at("geometry").at("type"), "MultiPolygon");
  EXPECT_EQ(features[0].at("properties").at("name"), "west");
  const nlohmann::json& parts = features[1].at("geometry").at("coordinates");
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].size(), 1U);
  EXPECT_EQ(parts[1].size(), 2U) << "the second part has a hole";
  // What was written is read again; rows of a FlatGeobuf are in the order of its index
  folder.must("farlod-info a.farlod --quiet --cells one.csv --zones zones.gpkg");
  folder.must("farlod-info a.farlod --quiet --cells two.csv --zones zones.fgb --zones-layer zones");
  EXPECT_EQ(table("one.csv").sums_by({"name"}, "wall_area_m2"), table("two.csv").sums_by({"name"}, "wall_area_m2"));
}
#endif

}  // namespace
}  // namespace farlod::acceptance
