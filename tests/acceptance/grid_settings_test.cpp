// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "tests/acceptance/packed_town.hpp"
#include "tests/analytic/tolerance.hpp"

namespace farlod::acceptance {
namespace {

/// A ray in a thousand may pass on the other side of an edge when the scene's corners round otherwise.
constexpr double one_ray = 1.0 / static_cast<double>(default_rays) + half_of_last_digit;

std::vector<std::string> places() {
  std::vector<std::string> result;
  for (const Point2d p : {Point2d{-60.0, 0.0}, {0.0, 0.0}, {30.0, -60.0}, {120.0, 95.0}})
    result.push_back(text_of(p_projected(p)));
  return result;
}

TEST_F(PackedTown, BuildingsAssignedWholeAreTheSameCity) {
  folder.must("farlod-pack town.geojson -o whole.farlod --assign whole --summary s.json");
  for (const std::string& place : places())
    EXPECT_NEAR(svf_at(place, "--engine exact", "whole.farlod"), svf_at(place, "--engine exact"), one_ray) << place;
  // Uncut, the town has fewer pieces
  folder.must("farlod-pack town.geojson -o clip.farlod --assign clip --summary c.json");
  EXPECT_LT(folder.json_of("s.json").at("triangles"), folder.json_of("c.json").at("triangles"));
  EXPECT_EQ(folder.json_of("s.json").at("polygons"), folder.json_of("c.json").at("polygons"));
}

TEST_F(PackedTown, BuildingsAssignedWholeGiveAlmostTheSameMap) {
  folder.must("farlod-pack town.geojson -o whole.farlod --assign whole");
  folder.must("farlod-svf whole.farlod -o whole.asc --grid 5 --verify 200 --summary whole.json");
  folder.must("farlod-svf a.farlod -o clip.asc --grid 5 --verify 200 --summary clip.json");
  const RasterFile whole = raster("whole.asc"), clip = raster("clip.asc");
  ASSERT_EQ(whole.values.size(), clip.values.size());
  for (std::size_t n = 0; n < clip.values.size(); ++n) {
    ASSERT_EQ(whole.values[n].has_value(), clip.values[n].has_value()) << n;
    // Each is within the paper's error of the truth
    if (clip.values[n]) {
      EXPECT_NEAR(*whole.values[n], *clip.values[n], 2.0 * paper_error) << n;
    }
  }
  for (const char* summary : {"whole.json", "clip.json"})
    EXPECT_LT(folder.json_of(summary).at("verify").at("max_abs_error"), paper_error) << summary;
}

TEST_F(PackedTown, TurningTheGridChangesNoAnswer) {
  const std::pair<std::string, double> turns[]{{"none", 0.0}, {"33.5", 33.5}, {"-70", -70.0}};
  for (const auto& [align, rotation_deg] : turns) {
    folder.must("farlod-pack town.geojson -o turned.farlod --force --summary s.json --align " + align);
    EXPECT_NEAR(folder.json_of("s.json").at("grid_rotation_deg"), rotation_deg, 1e-9);
    for (const std::string& place : places())
      EXPECT_NEAR(svf_at(place, "--engine exact", "turned.farlod"), svf_at(place, "--engine exact"), 2.0 * one_ray)
          << align << ' ' << place;
  }
}

TEST_F(PackedTown, AnotherCrsIsTheSameTownElsewhereOnPaper) {
  folder.must("farlod-pack town.geojson -o zone33.farlod --out-crs EPSG:25833 --summary s.json");
  // Town and streets are turned by the meridian convergence of zone 33 at 9° E: atan(tan(6°) · sin(49.65°)), the town's latitude
  const double convergence_deg =
      Angle::radians(std::atan(std::tan(Angle::degrees(6.0).radians()) * std::sin(Angle::degrees(49.652).radians()))).degrees();
  const double hundredth = 0.01;  // what the streets' direction is found to
  EXPECT_NEAR(folder.json_of("s.json").at("grid_rotation_deg"), town_bearing.degrees() + convergence_deg, hundredth);
#ifdef FARLOD_WITH_GDAL
  folder.must("farlod-svf zone33.farlod -o o.tif --grid 4");
  EXPECT_EQ(raster("o.tif").epsg, 25833);
  folder.write("p.csv", "lon,lat\n9,49.652\n9,49.6527\n");
  folder.must("farlod-svf zone33.farlod -o zone33.csv --points p.csv --points-crs EPSG:4326 --engine exact");
  folder.must("farlod-svf a.farlod -o zone32.csv --points p.csv --points-crs EPSG:4326 --engine exact");
  // Twelve degrees of longitude hold the scale to 0.2 %, heights do not scale along: the horizon's tangent is off by as much
  const double border = 4.0 * std::numbers::pi, scale_error = 0.002;
  for (std::size_t n = 0; n < 2; ++n)
    EXPECT_NEAR(table("zone33.csv").number(n, "svf"), table("zone32.csv").number(n, "svf"),
                2.0 * sampling_error(default_rays, border) + scale_error);
#endif
}

TEST_F(PackedTown, CellsAndNeighborhoodsAreAsAsked) {
  folder.must("farlod-pack town.geojson -o b.farlod --cell 20 --neighborhood 5 --summary s.json");
  const nlohmann::json summary = folder.json_of("s.json");
  EXPECT_EQ(summary.at("cell_m"), 20.0);
  EXPECT_EQ(summary.at("neighborhood"), 5);
  // The town is 336 m from the first wall to the last: 17 or 18 cells of 20 m each way
  EXPECT_GE(summary.at("cells"), 17 * 17);
  EXPECT_LE(summary.at("cells"), 18 * 18);
}

TEST(MeshWithAnOrigin, LiesWhereTheOriginSays) {
  const WorkFolder folder;
  folder.write("box.obj", box_obj());
  folder.must("farlod-pack box.obj --crs EPSG:32632 --origin 1000,2000,30 -o a.farlod");
  folder.must("farlod-svf a.farlod -o o.csv --surfaces roofs");
  const CsvTable points(folder.text_of("o.csv"));
  for (std::size_t n = 0; n < points.size(); ++n) {
    EXPECT_GT(points.number(n, "x_m"), 501000.0);
    EXPECT_LT(points.number(n, "x_m"), 501020.0);
    EXPECT_GT(points.number(n, "y_m"), 5502000.0);
    EXPECT_LT(points.number(n, "y_m"), 5502020.0);
    EXPECT_EQ(points.number(n, "z_m"), 40.01);
  }
}

}  // namespace
}  // namespace farlod::acceptance
