// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <functional>
#include <sstream>

#include "tests/acceptance/packed_town.hpp"
#include "tests/analytic/tolerance.hpp"

namespace farlod::acceptance {
namespace {

constexpr double terrain_step_m = 10.0;
constexpr int terrain_nodes = 101;  // along each edge: 1 km
constexpr double terrain_half_m = 0.5 * terrain_step_m * (terrain_nodes - 1);

/// An ESRI ASCII grid around the town's middle, with pixel centres at whole steps from it. `height_m` gets metres from the
/// middle.
std::string ascii_grid(const std::function<double(Point2d)>& height_m) {
  std::ostringstream text;
  text.precision(10);
  const Point2d corner = town_middle - (terrain_half_m + 0.5 * terrain_step_m) * Point2d{1.0, 1.0};
  text << "ncols " << terrain_nodes << "\nnrows " << terrain_nodes << "\nxllcorner " << corner.x << "\nyllcorner " << corner.y
       << "\ncellsize " << terrain_step_m << "\nNODATA_value -9999\n";
  for (int row = 0; row < terrain_nodes; ++row) {
    for (int column = 0; column < terrain_nodes; ++column)
      text << height_m({-terrain_half_m + column * terrain_step_m, terrain_half_m - row * terrain_step_m}) << ' ';
    text << '\n';
  }
  return text.str();
}

double plane_m(Point2d p) { return 100.0 + 0.1 * p.x + 0.05 * p.y; }

/// Sides as steep as 20° all around, from a single lowest point.
constexpr Angle bowl_side = Angle::degrees(20.0);
double bowl_m(Point2d p) { return 50.0 + norm(p) * tan(bowl_side); }

/// Tables print millimetres, packages keep floats of the height above their lowest whole metre.
constexpr double plane_error_m = 0.0005 + 0.0001;

class Terrain : public testing::Test {
 protected:
  [[nodiscard]] CsvTable answer_at(Point2d p, const std::string& arguments) const {
    folder.must("farlod-svf a.farlod -o at.csv --at " + text_of(p) + " " + arguments);
    return CsvTable(folder.text_of("at.csv"));
  }
  WorkFolder folder;
};

TEST_F(Terrain, ReceiversStandOnIt) {
  folder.write("slope.asc", ascii_grid(plane_m));
  folder.must("farlod-pack --terrain slope.asc --crs EPSG:32632 -o a.farlod");
  for (const Point2d p : {Point2d{}, {100.0, 0.0}, {-123.0, 77.0}, {401.5, -398.25}}) {
    EXPECT_NEAR(answer_at(town_middle + p, "").number(0, "z_m"), plane_m(p) + 1.5, plane_error_m);
    EXPECT_NEAR(answer_at(town_middle + p, "--on-surface").number(0, "z_m"), plane_m(p) + 1.5, plane_error_m);
  }
}

TEST_F(Terrain, AloneItIsACityToo) {
  folder.write("slope.asc", ascii_grid(plane_m));
  folder.must("farlod-pack --terrain slope.asc --crs EPSG:32632 -o a.farlod --summary p.json");
  EXPECT_EQ(folder.json_of("p.json").at("buildings"), 0);
  folder.must("farlod-svf a.farlod -o o.asc --grid 20 --on-surface --summary s.json");
  EXPECT_GT(folder.json_of("s.json").at("receivers"), 2000);
  // A plane hides from a horizontal receiver what lies between it and the horizontal: at most the slope's steepness all around
  const double steepness = std::hypot(0.1, 0.05), hidden = steepness * steepness / (1.0 + steepness * steepness);
  EXPECT_GE(folder.json_of("s.json").at("svf").at("min"), 1.0 - hidden - sampling_error(default_rays, 2.0 * std::numbers::pi));
}

TEST_F(Terrain, AHillHidesTheSky) {
  folder.write("bowl.asc", ascii_grid(bowl_m));
  folder.must("farlod-pack --terrain bowl.asc --crs EPSG:32632 -o a.farlod");
  // From the lowest point the rim stands at the sides' own angle, in all directions
  const double expected = cos(bowl_side) * cos(bowl_side);
  const double border = 2.0 * std::numbers::pi * cos(bowl_side);
  // Standing 1 cm above the ground lowers the rim, 500 m away, by less than a millionth
  const double svf = answer_at(town_middle, "--engine exact --height 0").number(0, "svf");
  EXPECT_NEAR(svf, expected, sampling_error(default_rays, border));
  EXPECT_NEAR(answer_at(town_middle, "--engine rays --height 0").number(0, "svf"), svf, paper_error);
}

TEST_F(Terrain, BuildingsThatKnowOnlyTheirHeightStandOnIt) {
  folder.write("slope.asc", ascii_grid(plane_m));
  folder.write("town.geojson", footprints_geojson(small_town()));
  folder.must("farlod-pack town.geojson --terrain slope.asc -o a.farlod");
  folder.must("farlod-svf a.farlod -o o.csv --surfaces roofs --spacing 30");
  const CsvTable roofs(folder.text_of("o.csv"));
  std::map<std::string, double> roof_m;
  for (std::size_t n = 0; n < roofs.size(); ++n) roof_m[roofs.text(n, "building")] = roofs.number(n, "z_m");
  for (const Block& b : small_town()) {
    double lowest_m = 1e9;
    for (const Point2d corner : {Point2d{-18.0, -18.0}, {18.0, -18.0}, {18.0, 18.0}, {-18.0, 18.0}})
      lowest_m = std::min(lowest_m, plane_m(p_projected(b.centre + corner) - town_middle));
    // Receivers float 1 cm above the roof; corners are off by 0.71 mm at most
    EXPECT_NEAR(roof_m.at(b.id), lowest_m + b.height_m + 0.01, plane_error_m + 0.11 * 0.00071) << b.id;
  }
}

TEST_F(Terrain, BetweenBuildingsReceiversStandOnTheTerrain) {
  folder.write("slope.asc", ascii_grid(plane_m));
  folder.write("town.geojson", footprints_geojson(small_town()));
  folder.must("farlod-pack town.geojson --terrain slope.asc -o a.farlod");
  const Point2d street = p_projected({-60.0, 0.0});
  EXPECT_NEAR(answer_at(street, "").number(0, "z_m"), plane_m(street - town_middle) + 1.5, plane_error_m);
}

}  // namespace
}  // namespace farlod::acceptance
