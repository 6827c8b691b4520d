// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "farlod/error.hpp"
#include "tests/preprocess/pipeline/packing.hpp"

namespace farlod::pipeline::test {
namespace {

/// Two footprints of 7 m by 11 m in UTM 32N, which know the elevations of their roofs.
constexpr const char* footprints = R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"id":"hall","roof":262.0},"geometry":{"type":"Polygon","coordinates":
 [[[8.4,49],[8.4001,49],[8.4001,49.0001],[8.4,49.0001],[8.4,49]]]}},
{"type":"Feature","properties":{"id":"cellar","roof":248.0},"geometry":{"type":"Polygon","coordinates":
 [[[8.401,49],[8.4011,49],[8.4011,49.0001],[8.401,49.0001],[8.401,49]]]}}]})";

/// An ESRI ASCII grid of 3 × 3 pixels of 1 km, 250 m high, around them.
constexpr const char* plain_name =
    "ncols 3\nnrows 3\nxllcorner 455000\nyllcorner 5426000\ncellsize 1000\n"
    "250 250 250\n250 250 250\n250 250 250\n";

struct RoofPacking : Packing {
  RoofPacking() {
    settings.inputs = {write("town.geojson", footprints)};
    settings.ingest.footprints.roof_field = "roof";
  }
  void run_on_plain() {
    settings.terrain = write("dem.asc", plain_name);
    settings.georeference.crs = "EPSG:32632";  // of the terrain
    run();
  }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder.path() / name, std::ios::binary) << text;
    return folder.path() / name;
  }
};

TEST(RoofElevations, ReachDownToTheTerrain) {
  RoofPacking p;
  p.run_on_plain();
  EXPECT_EQ(p.result.manifest.height_origin_m, 250.0);
  const PackageReader package(p.settings.output);
  EXPECT_EQ(ids_in(package), std::set<std::string>{"hall"});
  float top_m = 0.0F;
  const CellRange& cells = package.grid().cells;
  for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n)
    for (const Point3f& v : package.tile(cells.cell_at(n)).mesh.vertices) top_m = std::max(top_m, v.z);
  EXPECT_EQ(top_m, 12.0F);
}

TEST(RoofElevations, BelowTheTerrainAreOnTheMap) {
  RoofPacking p;
  p.run_on_plain();
  ASSERT_EQ(p.report.count(ProblemCode::height_not_positive), 1U);
  const Problem& problem = p.report.problems()[0];
  EXPECT_EQ(problem.place, "cellar");
  // There and back between degrees and metres: PROJ promises a tenth of a millimetre, which is 1e-9 of a degree
  constexpr double projection_error_deg = 1e-9;
  EXPECT_NEAR(problem.lon_lat_deg.value().x, 8.401, projection_error_deg);
  EXPECT_NEAR(problem.lon_lat_deg.value().y, 49.0, projection_error_deg);
}

TEST(RoofElevations, NeedAGround) {
  RoofPacking p;
  try {
    p.run();
    FAIL() << "an InputError was due";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("--terrain"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("--base-field"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(p.stages_told().contains("tiles"));
}

}  // namespace
}  // namespace farlod::pipeline::test
