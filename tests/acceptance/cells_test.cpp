// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "tests/acceptance/packed_town.hpp"

// farlod-info --cells, as users type it

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
#endif

}  // namespace
}  // namespace farlod::acceptance
