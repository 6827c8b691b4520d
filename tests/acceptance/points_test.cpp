// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <ostream>

#include "farlod/error.hpp"
#include "tests/acceptance/packed_town.hpp"
#include "tests/acceptance/work_folder.hpp"
#include "tests/analytic/oracles.hpp"
#include "tests/analytic/tolerance.hpp"

namespace farlod::acceptance {
namespace {

using testing::HasSubstr;

/// In the middle of a crossing of two streets, with the far city on all sides.
const Point2d crossing = p_projected({-60.0, 0.0});

/// The town is at 9° E, 49.6525° N; what is asked is a field in the north of it.
TEST_F(PackedTown, ColumnsOfLongitudesAndLatitudesAreDegrees) {
  folder.write("stations.csv", "station,lon,lat\nA,9.0,49.655\n");
  folder.write("same.geojson",
               R"({"type":"Feature","properties":{"station":"A"},"geometry":{"type":"Point","coordinates":[9.0,49.655]}})");
  folder.must("farlod-svf a.farlod -o o.csv --points stations.csv");
  folder.must("farlod-svf a.farlod -o same.csv --points same.geojson");
  for (const char* column : {"x_m", "y_m", "svf"})
    EXPECT_EQ(table("o.csv").number(0, column), table("same.csv").number(0, column));
}

TEST_F(PackedTown, APlaceInDegreesIsTakenForOneAndToldWhereItFits) {
  const Outcome outcome = folder.run("farlod-svf a.farlod -o o.csv --at 9.0,49.655");
  EXPECT_THAT(outcome.out + outcome.err, HasSubstr("9, 49.655 was taken for longitude and latitude (WGS 84)."));
  EXPECT_NEAR(table("o.csv").number(0, "x_m"), 500000.0, 1.0);
}

TEST_F(PackedTown, APlaceFarFromTheCityIsRefused) {
  const auto refusal = [&](const std::string& place) {
    const Outcome outcome = folder.run("farlod-svf a.farlod -o o.csv --at " + place);
    EXPECT_EQ(outcome.exit_code, 3) << place;
    return outcome.err;
  };
  EXPECT_THAT(refusal("49.655,9.0"), HasSubstr("give the longitude before the latitude"));
  EXPECT_THAT(refusal("4,52"), HasSubstr("lies more than 100 km from the city"));
  EXPECT_THAT(refusal("5500000,500000"), HasSubstr("they are of that CRS, or longitude and latitude"));
  folder.write("swapped.csv", "lon,lat\n49.655,9.0\n");
  const Outcome outcome = folder.run("farlod-svf a.farlod -o o.csv --points swapped.csv");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("49.655, 9 lies more than 100 km"), HasSubstr("give the longitude before the latitude")));
}

TEST(TwoBlocks, APointNextToThemButOutsideOfTheGridHasHorizons) {
  const WorkFolder folder;
  add_packed_town(folder, "two_blocks", {{"low", {}, 20.0, 10.0}, {"high", {60.0, 0.0}, 20.0, 40.0}}, "--cell 10");
  // The grid ends within one cell of the outermost wall; this point is 12 m away from it
  const std::string place = text_of(p_projected({-22.0, 3.0}));
  const Outcome outcome = folder.run("farlod-svf a.farlod -o o.csv --at " + place);
  EXPECT_THAT(outcome.out, testing::HasSubstr("lies outside of the grid of cells, which lies from 499984, 5499954 to 500078"));
  EXPECT_THAT(outcome.out, testing::Not(testing::HasSubstr("around the grid")));
  folder.must("farlod-svf a.farlod -o exact.csv --engine exact --rays 20000 --at " + place);
  const double svf = CsvTable(folder.text_of("o.csv")).number(0, "svf"), of_azimuths_and_rays = 0.002;
  EXPECT_NEAR(svf, CsvTable(folder.text_of("exact.csv")).number(0, "svf"), of_azimuths_and_rays);
  EXPECT_LT(svf, 1.0 - of_azimuths_and_rays);
}

TEST_F(PackedTown, AtStandsAboveTheGroundUnlessItHasAHeight) {
  folder.must("farlod-svf a.farlod -o o.csv --at " + text_of(crossing));
  EXPECT_EQ(table("o.csv").number(0, "z_m"), 1.5);
  EXPECT_EQ(table("o.csv").number(0, "height_above_ground_m"), 1.5);
  folder.must("farlod-svf a.farlod -o o.csv --height 3 --at " + text_of(crossing));
  EXPECT_EQ(table("o.csv").number(0, "z_m"), 3.0);
  folder.must("farlod-svf a.farlod -o o.csv --at " + text_of(Point3d{crossing.x, crossing.y, 12.0}));
  EXPECT_EQ(table("o.csv").number(0, "z_m"), 12.0);
  EXPECT_EQ(table("o.csv").number(0, "height_above_ground_m"), 12.0);
}

TEST_F(PackedTown, HeightsOfATableCountFromWhereTheCrsCounts) {
  folder.write("ground.asc", "ncols 2\nnrows 2\nxllcorner 499000\nyllcorner 5499000\ncellsize 1000\n100.0 100.0\n100.0 100.0\n");
  folder.must("farlod-pack town.geojson -o high.farlod --terrain ground.asc");
  folder.must("farlod-svf high.farlod -o o.csv --at " + text_of(crossing));
  EXPECT_EQ(table("o.csv").number(0, "z_m"), 101.5);
  EXPECT_EQ(table("o.csv").number(0, "height_above_ground_m"), 1.5);
  folder.must("farlod-svf high.farlod -o o.csv --at " + text_of(Point3d{crossing.x, crossing.y, 112.0}));
  EXPECT_EQ(table("o.csv").number(0, "height_above_ground_m"), 12.0);
}

TEST_F(PackedTown, TheHigherTheMoreSky) {
  const double low = svf_at(text_of(Point3d{crossing.x, crossing.y, 1.5}), "--engine exact");
  const double high = svf_at(text_of(Point3d{crossing.x, crossing.y, 15.0}), "--engine exact");
  EXPECT_LT(low, high);
  EXPECT_EQ(svf_at(text_of(Point3d{crossing.x, crossing.y, tower_height_m + 1.0}), "--engine exact"), 1.0);
}

TEST_F(PackedTown, InsideABuildingThereIsNoAnswer) {
  const Point2d inside = p_projected(small_town().front().centre);
  folder.write("p.csv", "x,y\n" + text_of(inside) + "\n" + text_of(p_projected({-60.0, 0.0})) + "\n");
  folder.must("farlod-svf a.farlod -o o.csv --summary s.json --points p.csv");
  EXPECT_EQ(table("o.csv").text(0, "svf"), "");
  EXPECT_EQ(table("o.csv").text(0, "height_above_ground_m"), "");
  EXPECT_NE(table("o.csv").text(1, "svf"), "");
  EXPECT_EQ(folder.json_of("s.json").at("nodata"), 1);
}

/// The terminal counted them, and nothing else.
TEST_F(PackedTown, PointsWithoutAnAnswerAreToldWithTheReason) {
  const Point2d inside = p_projected(small_town().front().centre);
  std::string text =
      "id,x,y,z\nhall," + text_of(inside) + ",\ncellar," + text_of(crossing) + ",-3\nstreet," + text_of(crossing) + ",2\n";
  folder.write("p.csv", text);
  const Outcome few = folder.run("farlod-svf a.farlod -o o.csv --points p.csv");
  EXPECT_THAT(few.out, HasSubstr("2 of 3 points have no answer: hall at "));
  EXPECT_THAT(few.out, testing::ContainsRegex("\\(inside a building, whose top is [0-9.]+ m above the ground\\); cellar at "));
  EXPECT_THAT(few.out, HasSubstr("(its height of -3.00 m is below the ground, which is at 0.00 m)."));
  for (int n = 0; n < 6; ++n) text += "more" + std::to_string(n) + "," + text_of(inside) + ",\n";
  folder.write("p.csv", text);
  const Outcome many = folder.run("farlod-svf a.farlod -o o.csv --points p.csv");
  EXPECT_THAT(many.out, HasSubstr("8 of 9 points have no answer: hall at "));
  EXPECT_THAT(many.out, testing::ContainsRegex("more2 at [^;]*; and 3 more\\."));
}

TEST_F(PackedTown, OnTheSurfaceAReceiverStandsOnTheRoof) {
  const Block tower = tower_of(small_town());
  folder.must("farlod-svf a.farlod -o o.csv --engine exact --on-surface --at " + text_of(p_projected(tower.centre)));
  EXPECT_EQ(table("o.csv").number(0, "z_m"), tower_height_m + 1.5);
  EXPECT_EQ(table("o.csv").number(0, "height_above_ground_m"), tower_height_m + 1.5);
  EXPECT_EQ(table("o.csv").number(0, "svf"), 1.0);
}

TEST_F(PackedTown, AReceiverOnTheVerySurfaceDoesNotSeeTheSurface) {
  const std::string roof = text_of(p_projected(tower_of(small_town()).centre));
  EXPECT_EQ(svf_at(roof, "--engine exact --on-surface --height 0"), 1.0);
  // A hand above the ground differs from the ground by what stands less than a hand above the horizon
  const double tolerance = sampling_error(default_rays, 4.0);
  EXPECT_NEAR(svf_at(text_of(crossing), "--height 0"), svf_at(text_of(crossing), "--height 0.1"), tolerance);
}

TEST_F(PackedTown, PointsOfATableAreThoseOfAt) {
  const Point2d street = p_projected({30.0, 0.0});
  folder.write("p.csv", "id,x,y,z\nfirst," + text_of(crossing) + ",\nsecond," + text_of(street) + ",20\n");
  folder.must("farlod-svf a.farlod -o o.csv --points p.csv");
  const CsvTable answers = table("o.csv");
  ASSERT_EQ(answers.size(), 2U);
  EXPECT_EQ(answers.header(), (std::vector<std::string>{"id", "x_m", "y_m", "z_m", "height_above_ground_m", "svf"}));
  EXPECT_EQ(answers.text(0, "id"), "first");
  EXPECT_EQ(answers.text(1, "id"), "second");
  EXPECT_EQ(answers.number(0, "svf"), svf_at(text_of(crossing)));
  EXPECT_EQ(answers.number(1, "svf"), svf_at(text_of(Point3d{street.x, street.y, 20.0})));
}

#ifdef FARLOD_WITH_GDAL
TEST_F(PackedTown, PointsInDegreesAreProjected) {
  // On the central meridian the easting is 500 km sharp, and 0.001° of latitude are 111.2 m (times UTM's 0.9996) at 50° north
  folder.write("p.csv", "lon,lat\n9,49.65\n9,49.651\n");
  folder.must("farlod-svf a.farlod -o o.csv --points p.csv --points-crs EPSG:4326 --engine exact");
  const CsvTable answers = table("o.csv");
  ASSERT_EQ(answers.size(), 2U);
  for (std::size_t n = 0; n < 2; ++n) {
    EXPECT_EQ(answers.number(n, "x_m"), 500000.0);
    // Rays come in steps, so that the millimetre to which the table rounds a place does not show
    EXPECT_EQ(answers.number(n, "svf"), svf_at(answers.text(n, "x_m") + "," + answers.text(n, "y_m"), "--engine exact"));
  }
  const double millimetre = 0.001;
  EXPECT_NEAR(answers.number(1, "y_m") - answers.number(0, "y_m"), 111.23 * 0.9996, 10.0 * millimetre);
}

TEST_F(PackedTown, PointsOfAVectorFileAreInItsOwnCrsAndKeepTheirFields) {
  folder.write("p.geojson", R"({"type": "FeatureCollection", "features": [
    {"type": "Feature", "properties": {"name": "south", "svf": 0.7}, "geometry": {"type": "Point", "coordinates": [9, 49.65]}},
    {"type": "Feature", "properties": {"name": "high"}, "geometry": {"type": "Point", "coordinates": [9, 49.651, 40.5]}},
    {"type": "Feature", "properties": {"name": "path"}, "geometry": {"type": "LineString", "coordinates": [[9, 49], [9, 50]]}}]})");
  const Outcome outcome = folder.run("farlod-svf a.farlod -o o.csv --points p.geojson");
  ASSERT_EQ(outcome.exit_code, exit_done) << outcome.err;
  EXPECT_NE(outcome.out.find("1 feature of p.geojson is no point and was skipped.\n"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("The field \"svf\" of the points comes back as \"svf_input\""), std::string::npos) << outcome.out;
  const CsvTable answers = table("o.csv");
  ASSERT_EQ(answers.size(), 2U);
  EXPECT_EQ(answers.header(),
            (std::vector<std::string>{"id", "name", "svf_input", "x_m", "y_m", "z_m", "height_above_ground_m", "svf"}));
  EXPECT_EQ(answers.text(0, "name"), "south");
  EXPECT_EQ(answers.text(0, "svf_input"), "0.7");
  EXPECT_EQ(answers.text(1, "svf_input"), "");
  EXPECT_EQ(answers.number(1, "z_m"), 40.5);
  folder.write("p.csv", "lon,lat,z\n9,49.65,\n9,49.651,40.5\n");
  folder.must("farlod-svf a.farlod -o of_table.csv --points p.csv --points-crs EPSG:4326");
  for (std::size_t n = 0; n < 2; ++n)
    for (const char* column : {"x_m", "y_m", "svf"}) EXPECT_EQ(answers.text(n, column), table("of_table.csv").text(n, column));
}

TEST_F(PackedTown, TheCrsThatTheUserNamesWins) {
  // GeoJSON is in degrees by its standard, and often in something else in fact
  folder.write("p.geojson", R"({"type": "Point", "coordinates": [)" + text_of(crossing) + "]}");
  const Outcome outcome = folder.run("farlod-svf a.farlod -o o.csv --points p.geojson --points-crs EPSG:25832 --engine exact");
  ASSERT_EQ(outcome.exit_code, exit_done) << outcome.err;
  EXPECT_NE(outcome.out.find("EPSG:25832 (--points-crs)"), std::string::npos) << outcome.out;
  EXPECT_EQ(table("o.csv").number(0, "svf"), svf_at(text_of(crossing), "--engine exact"));
}
#endif

TEST_F(PackedTown, APointWithANormalIsAReceiverOnASurface) {
  folder.must("farlod-svf a.farlod -o walls.csv --surfaces walls --spacing 20 --engine exact");
  // The table has the names of a table of points. Its answers come back beside the new ones
  folder.must("farlod-svf a.farlod -o o.csv --points walls.csv --engine exact");
  const CsvTable answers = table("o.csv");
  ASSERT_EQ(answers.size(), table("walls.csv").size());
  std::size_t compared = 0;
  for (std::size_t n = 0; n < answers.size(); ++n) {
    EXPECT_EQ(answers.text(n, "azimuth_deg"), table("walls.csv").text(n, "azimuth_deg"));
    if (answers.text(n, "svf").empty() || answers.text(n, "svf_input").empty()) continue;
    const double few_rays = 3.0 / static_cast<double>(default_rays);  // places and normals were rounded to three digits
    EXPECT_NEAR(answers.number(n, "svf"), answers.number(n, "svf_input"), few_rays + 2.0 * half_of_last_digit) << n;
    ++compared;
  }
  EXPECT_GT(compared, answers.size() / 2);
}

TEST(LonelyShed, APointInTheOpenSeesTheSkyOfItsTilt) {
  const WorkFolder folder;
  add_packed_town(folder, "shed", {{"shed", {}, 1.0, 0.5}});
  std::string points = "x,y,azimuth,tilt\n";
  const std::vector<double> tilts_deg{0.0, 30.0, 60.0, 90.0, 120.0, 180.0};
  for (std::size_t n = 0; n < tilts_deg.size(); ++n)
    points += text_of(p_projected({-50.0, 7.0 * static_cast<double>(n)})) + "," + std::to_string(70 * n) + "," +
              std::to_string(tilts_deg[n]) + "\n";
  folder.write("points.csv", points);
  for (const std::string engine : {"auto", "horizon", "rays", "exact"}) {
    SCOPED_TRACE(engine);
    folder.must("farlod-svf a.farlod -o o.csv --points points.csv --rays 20000 --engine " + engine + " --summary s.json");
    ASSERT_EQ(folder.json_of("s.json").at("receivers"), tilts_deg.size());
    const CsvTable answers(folder.text_of("o.csv"));
    for (std::size_t n = 0; n < tilts_deg.size(); ++n)
      EXPECT_NEAR(answers.number(n, "svf"), oracles::tilted_cos(Angle::degrees(tilts_deg[n]).radians()), 0.001) << tilts_deg[n];
  }
}

TEST_F(PackedTown, MoreRaysComeCloserToTheTruth) {
  const double fine = svf_at(text_of(crossing), "--engine exact --rays 100000");
  // The edge of the sky between roofs is shorter than twice the circle's circumference here
  const double border = 4.0 * std::numbers::pi;
  for (const std::size_t rays : {100U, 1000U, 10000U}) {
    const double svf = svf_at(text_of(crossing), "--engine exact --rays " + std::to_string(rays));
    EXPECT_NEAR(svf, fine, sampling_error(rays, border) + sampling_error(100000, border)) << rays;
    const double free_rays = svf * static_cast<double>(rays);
    EXPECT_NEAR(free_rays, std::round(free_rays), half_of_last_digit * static_cast<double>(rays)) << rays;
  }
}

TEST_F(PackedTown, SolidAngleIsAnotherQuantityUnderAnotherName) {
  const double cosine = svf_at(text_of(crossing));
  folder.must("farlod-svf a.farlod -o o.csv --sky solid --at " + text_of(crossing));
  EXPECT_EQ(table("o.csv").header().back(), "svf_solid");
  // A horizon at the elevation e leaves 1 − sin e of the solid angle, but 1 − sin² e of the view factor
  EXPECT_LT(table("o.csv").number(0, "svf_solid"), cosine);
}

TEST_F(PackedTown, FiguresOnTheTerminalHaveTheirUnits) {
  const Outcome map = folder.run("farlod-svf a.farlod -o o.tif --grid 10 --quantity sunlit,hidden --sun 2026-06-21");
  EXPECT_THAT(map.out, testing::ContainsRegex("sunlit_h: min [0-9.]+, mean [0-9.]+, max [0-9.]+ h\n"));
  EXPECT_THAT(map.out, testing::ContainsRegex("hidden_near: min [0-9.]+, mean [0-9.]+, max [0-9.]+\n")) << "a share has none";
  const Outcome place = folder.run("farlod-svf a.farlod -o o.csv --quantity sunlit --sun 2026-06-21 --at " + text_of(crossing));
  EXPECT_THAT(place.out, testing::ContainsRegex("svf: 0\\.[0-9]+\nsunlit_h: [0-9.]+ h\n")) << "of one place, one number";
}

/// What stands between two fences, in the order of the page.
std::vector<std::string> fenced_blocks(const std::filesystem::path& page) {
  std::ifstream file(page);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  std::vector<std::string> blocks;
  bool inside = false;
  for (const std::string& line : lines_of(text)) {
    if (line == "```") {
      inside = !inside;
      if (inside) blocks.emplace_back();
    } else if (inside) {
      blocks.back() += line + "\n";
    }
  }
  return blocks;
}

bool is_command(const std::string& block) {
  return block.starts_with("build/bin/") || block.starts_with("awk ") || block.starts_with("gzip ");
}

struct Tutorial {
  const char* page;
  std::size_t commands;
  std::vector<const char*> tables;  ///< that its commands write, and that it shows
};
void PrintTo(const Tutorial& tutorial, std::ostream* out) { *out << tutorial.page; }

class Tutorials : public testing::TestWithParam<Tutorial> {};

TEST_P(Tutorials, SayWhatTheProgramsSay) {
  const WorkFolder folder;
  folder.must(std::string("ln -s '") + FARLOD_SOURCE_DIR + "/datasets' datasets && mkdir build && ln -s '" + FARLOD_BIN_DIR +
              "' build/bin");
  std::string said;
  std::size_t commands = 0;
  for (const std::string& block : fenced_blocks(std::filesystem::path(FARLOD_SOURCE_DIR) / "docs/tutorials" / GetParam().page)) {
    if (is_command(block)) {
      const Outcome outcome = folder.run(block);
      ASSERT_EQ(outcome.exit_code, 0) << block << outcome.err;
      said = outcome.out;
      for (const char* table : GetParam().tables) said += folder.text_of(table);
      ++commands;
      continue;
    }
    for (const std::string& line : lines_of(block)) EXPECT_THAT(said, testing::HasSubstr(line));
  }
  EXPECT_EQ(commands, GetParam().commands);
}

INSTANTIATE_TEST_SUITE_P(
    All, Tutorials,
    testing::Values(Tutorial{"city_files.md", 6, {}}, Tutorial{"is_my_city_right.md", 2, {}}, Tutorial{"trees.md", 10, {}},
                    Tutorial{"jobs.md", 35, {}}, Tutorial{"solar_register.md", 4, {}}, Tutorial{"urban_form.md", 5, {}},
                    Tutorial{"facades.md", 3, {"facades.csv", "facades.surfaces.csv", "facades.buildings.csv"}}));

}  // namespace
}  // namespace farlod::acceptance
