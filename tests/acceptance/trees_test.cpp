// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "tests/acceptance/csv_table.hpp"
#include "tests/acceptance/packed_town.hpp"
#include "tests/acceptance/real_city.hpp"
#include "tests/acceptance/street_trees.hpp"

namespace farlod::acceptance {
namespace {

using testing::HasSubstr;

TEST_F(PackedTown, TreesAreCounted) {
  folder.write("trees.csv", street_trees());
  const Outcome outcome = folder.run("farlod-pack town.geojson --trees trees.csv -o b.farlod --summary b.json --report r.json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Crowns: 20 of trees, 0 of cells of a canopy"));
  EXPECT_EQ(folder.json_of("b.json").at("crowns"), (nlohmann::json{{"of_trees", 20}, {"of_canopy", 0}}));
  EXPECT_TRUE(folder.json_of("r.json").empty());
  EXPECT_TRUE(folder.has("b.farlod/crowns.bin"));
  EXPECT_FALSE(folder.has("a.farlod/crowns.bin"));
}

TEST_F(PackedTown, TreesThatStandElsewhereAreCountedWithTheirFile) {
  folder.write("trees.csv", street_trees() + "20,,5509000,509000,9.5,6\n21,,5509000,509100,9.5,6\n");
  const Outcome outcome = folder.run("farlod-pack town.geojson --trees trees.csv -o b.farlod --report r.json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Crowns: 20 of trees"));
  EXPECT_THAT(outcome.out, HasSubstr("1 × 210 tree_outside_of_grid: trees stand outside of the grid"));
  EXPECT_THAT(outcome.out, HasSubstr("trees.csv: 2 of 22 trees stand outside of the grid"));
}

TEST_F(PackedTown, TreesWithoutAPlaceOnItsMapAreTreesInTheReport) {
  folder.write("trees.csv", "lon,lat,height,crown_diameter\n9.0001,49.65,9,6\n139.76,35.68,9,6\n");
  const Outcome outcome = folder.run("farlod-pack town.geojson --trees trees.csv -o b.farlod --report r.json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("trees.csv: 1 of 2 trees, of which the first is at 139.76, 35.68, have no place in"));
  const nlohmann::json problem = folder.json_of("r.json").at(0);
  EXPECT_EQ(problem.at("code"), 210);
  EXPECT_TRUE(problem.at("position").is_null()) << "it has none in the CRS of the package";
  EXPECT_NEAR(problem.at("lon_lat").at(0).get<double>(), 139.76, 1e-4);
}

TEST_F(PackedTown, TreesAreWhatIsPackedToo) {
  folder.write("trees.csv", street_trees());
  folder.must("farlod-pack town.geojson --trees trees.csv -o b.farlod --quiet");
  for (const char* shard : {"--shard 1/2", "--shard 0/2", "--merge"})
    folder.must(std::string("farlod-pack town.geojson --trees trees.csv -o c.farlod --quiet ") + shard);
  for (const char* file : {"manifest.json", "crowns.bin", "blocks/0_0/tiles.bin"})
    EXPECT_EQ(folder.text_of(std::string("c.farlod/") + file), folder.text_of(std::string("b.farlod/") + file)) << file;
}

TEST_F(PackedTown, StrictTakesNoTreesThatLackSizes) {
  folder.write("trees.csv", "lon,lat\n9.0001,49.65\n");
  const Outcome outcome = folder.run("farlod-pack town.geojson --trees trees.csv -o b.farlod --strict --quiet");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("--strict"));
}

/// Cells with a height above 0 in the two rasters of Gothenburg.
constexpr std::size_t ga_cells = 672, gvc_cells = 9321;

/// Real trees. Beside them no city may be there: then they stand in a flat one.
class RealTrees : public RealCity {
 protected:
  /// A level square of some kilometres.
  [[nodiscard]] std::string square(const std::string& crs, Point2d middle, double half_m) const {
    std::ostringstream text;
    text.precision(12);
    text << "ncols 2\nnrows 2\nxllcorner " << middle.x - 2.0 * half_m << "\nyllcorner " << middle.y - 2.0 * half_m
         << "\ncellsize " << 2.0 * half_m << "\n7 7\n7 7\n";
    folder.write("square.asc", text.str());
    return "--terrain square.asc --crs " + crs + " --area " + box_text(middle, 60.0);
  }
  static std::string box_text(Point2d middle, double half_m) {
    std::ostringstream text;
    text.precision(12);
    text << middle.x - half_m << ',' << middle.y - half_m << ',' << middle.x + half_m << ',' << middle.y + half_m;
    return text.str();
  }
  [[nodiscard]] static std::size_t trees_of(const PackedCity& city) { return city.summary.at("crowns").at("of_trees"); }
  [[nodiscard]] static std::size_t cells_of(const PackedCity& city) { return city.summary.at("crowns").at("of_canopy"); }
};

struct Place {
  std::string name, file, crs;
  Point2d middle;
  std::size_t trees;
  std::map<int, std::size_t> problems;
};

void PrintTo(const Place& place, std::ostream* out) { *out << place.file; }

class Inventories : public RealTrees, public testing::WithParamInterface<Place> {};

TEST_P(Inventories, ArePacked) {
  const Place& place = GetParam();
  needs({place.file});
  if (IsSkipped()) return;
  // The CRS of the square is not for the trees, which say their own
  const PackedCity city = pack(square(place.crs, place.middle, 5000.0) + " --cell 500 --trees " + data(place.file));
  EXPECT_EQ(trees_of(city), place.trees);
  EXPECT_EQ(city.problems, place.problems);
}

INSTANTIATE_TEST_SUITE_P(
    Trees, Inventories,
    testing::Values(
        Place{"Tokyo", "trees/inv_tokyo/trees.geojson", "EPSG:32654", {387900.0, 3949400.0}, 1107, {}},
        Place{"Honmoku", "trees/inv_honmoku/trees.geojson", "EPSG:32654", {378600.0, 3920500.0}, 3584, {{120, 1}}},
        Place{"Catonsville", "trees/inv_osm/trees.geojson", "EPSG:32618", {348900.0, 4348900.0}, 301, {{120, 1}}},
        Place{"Fitzroy", "trees/inv_fitzroy/trees.csv", "EPSG:32755", {322300.0, 5812800.0}, 1200, {{120, 1}}},
        Place{"Berlin", "trees/berlin_lidar/tree_positions_parameterized.geojson", "EPSG:25833", {396900.0, 5819500.0}, 288, {}}),
    [](const auto& test) { return test.param.name; });

TEST_F(RealTrees, OfBerlinStandBetweenItsBuildings) {
  const std::string folder_name = "trees/berlin_lidar/", buildings = folder_name + "lod2_buildings_berlin_test_area.gml",
                    points = folder_name + "tree_positions_parameterized.geojson",
                    outlines = folder_name + "crowns_convex_hull_parameterized.geojson";
  needs({buildings, points, outlines});
  if (IsSkipped()) return;
  PackedCity city = pack(data(buildings) + " --trees " + data(points));
  EXPECT_EQ(city.count("buildings"), 17U);
  EXPECT_EQ(trees_of(city) + city.told_counts[210], 288U);
  folder.must("farlod-pack " + data(buildings) + " --trees " + data(outlines) + " -o b.farlod --summary b.json --quiet");
  const nlohmann::json other = folder.json_of("b.json");
  EXPECT_NEAR(other.at("crowns").at("of_trees").get<double>(), static_cast<double>(trees_of(city)), 6.0)
      << "centroids of outlines are other places than those of stems";
  expect_sound_map();
}

TEST_F(RealTrees, OfGothenburgAreCellsOfItsCanopy) {
  const std::string ga = "trees/goteborg_ga/", dsm = ga + "DSM_GA.tif", dem = ga + "DEM_GA.tif", cdsm = ga + "CDSM_GA.tif";
  needs({dsm, dem, cdsm});
  if (IsSkipped()) return;
  const PackedCity surface = pack(data(dsm) + " --canopy " + data(cdsm));
  EXPECT_EQ(cells_of(surface), ga_cells);
  EXPECT_TRUE(surface.problems.empty());
  expect_sound_map();
  folder.must("farlod-pack --terrain " + data(dem) + " --canopy " + data(cdsm) +
              " --trunk-ratio 0.5 -o b.farlod --summary b.json");
  EXPECT_EQ(folder.json_of("b.json").at("crowns").at("of_canopy"), ga_cells);
}

TEST_F(RealTrees, OfGothenburgsParkMayHaveTrunksOfAnotherPlace) {
  const std::string gvc = "trees/goteborg_gvc/", dsm = gvc + "DSM_GVC_1m.tif", cdsm = gvc + "CDSM_GVC_1m.tif",
                    elsewhere = "trees/goteborg_ga/CDSM_GA.tif";
  needs({dsm, cdsm, elsewhere});
  if (IsSkipped()) return;
  const PackedCity city = pack(data(dsm) + " --canopy " + data(cdsm));
  EXPECT_EQ(cells_of(city), gvc_cells);
  const Outcome outcome =
      folder.run("farlod-pack " + data(dsm) + " --canopy " + data(cdsm) + " --trunk " + data(elsewhere) + " -o b.farlod");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("has another extent or resolution"));
  EXPECT_THAT(outcome.out, HasSubstr(std::to_string(gvc_cells) + " cells have crowns, and no height"));
}

/// A hedge 400 m long, 4 m wide and 6 m high, to the north of a receiver.
class Hedge : public RealTrees {};

TEST_F(Hedge, OfAPlantCoverHidesWhatAnEndlessOneHides) {
  const Point2d eye{400000.0, 5500000.0};
  folder.write("hedge.city.json",
               R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[400000,5500000,0]},
    "metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/25832"},"CityObjects":{"hedge":{"type":"PlantCover",
    "attributes":{"averageHeight":6},"geometry":[{"type":"MultiSurface","lod":"1","boundaries":[[[0,1,2,3]]]}]}},
    "vertices":[[-200,5,7],[200,5,7],[200,9,7],[-200,9,7]]})");
  const PackedCity city = pack(square("EPSG:25832", eye, 1000.0) + " --align none --trees hedge.city.json");
  EXPECT_EQ(trees_of(city), 404U * 4U) << "squares of 0.99 m: area and outline are those of a strip 3.96 m wide";
  folder.must("farlod-svf a.farlod -o o.csv --at 400000,5500000 --height 1 --quantity svf_total --transmissivity 0.1");
  // An endless wall that rises to β above the eye hides (1 − cos β)/2 of the sky; the hedge 0.9 of that. What is missing behind
  // its ends is less than 1e-5, and the terrain is level
  const double cosine = 1.0 / std::sqrt(2.0), expected = 1.0 - 0.9 * 0.5 * (1.0 - cosine);
  // The share of azimuths that a crown may be wrong by, and the ends of squares that are merged far away
  constexpr double tolerance = 5e-4;
  EXPECT_NEAR(CsvTable(folder.text_of("o.csv")).number(0, "svf_total"), expected, tolerance);
}

class ManyTrees : public RealTrees {};

TEST_F(ManyTrees, AreReadInLittleMemory) {
  constexpr int rows = 1000;
  const Point2d corner{400000.0, 5500000.0}, middle = corner + Point2d{5000.0, 5000.0};
  std::ofstream table(folder.path("trees.csv"));
  table << "x,y,height,crown,h_trunk,species\n";
  // In an order that jumps from one end of the city to the other
  for (int n = 0; n < rows * rows; ++n) {
    const int place = static_cast<int>((static_cast<long long>(n) * 611'953) % (rows * rows));
    table << static_cast<int>(corner.x) + 10 * (place % rows) << ".5," << static_cast<int>(corner.y) + 10 * (place / rows)
          << ".5," << 5 + place % 17 << ".5,6,2,Tilia cordata\n";
  }
  table.close();
  const PackedCity city = pack(square("EPSG:25832", middle, 5500.0) + " --trees trees.csv");
  EXPECT_EQ(trees_of(city), std::size_t{rows} * rows);
  // Some 21: trees and crowns lie on disk, where they take 90 and more
  if (city.held_mib) {
    EXPECT_LT(*city.held_mib, 60.0);
  }
  // PackEstimate promises a factor of two
  const nlohmann::json& estimate = city.summary.at("estimate");
  const double package_mib = city.summary.at("package_bytes").get<double>() / 1048576.0;
  EXPECT_GT(estimate.at("package_mib"), package_mib / 2.0);
  EXPECT_LT(estimate.at("package_mib"), package_mib * 2.0);
  if (city.held_mib) {
    EXPECT_GT(estimate.at("memory_mib"), *city.held_mib / 2.0);
  }
}

}  // namespace
}  // namespace farlod::acceptance
