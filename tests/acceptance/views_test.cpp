// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "farlod/error.hpp"
#include "tests/acceptance/packed_town.hpp"
#include "tests/scenes/footprints_text.hpp"

// What farlod-svf says of what fills the view: its columns and bands, and what it refuses.

namespace farlod::acceptance {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::IsSupersetOf;
using testing::Not;

const std::string at_crossing = " --rays 500 --at " + text_of(p_projected({-60.0, 0.0})) + " ";

/// The sum of the columns of a view in the first row: those that begin with "view_" and end so.
double sum_of_view(const CsvTable& row, const std::vector<std::string>& classes, const std::string& ending) {
  double sum = 0.0;
  for (const std::string& what : classes) sum += row.number(0, "view_" + what + ending);
  return sum;
}

const std::vector<std::string> by_quarters{"sky", "ground", "roof", "wall_n", "wall_e", "wall_s", "wall_w", "crown", "other"};
const std::vector<std::string> by_eighths{"sky",    "ground",  "roof",   "wall_n",  "wall_ne", "wall_e", "wall_se",
                                          "wall_s", "wall_sw", "wall_w", "wall_nw", "crown",   "other"};
/// Sums of so many values of a table, which are rounded.
double rounding_of(const std::vector<std::string>& classes) { return static_cast<double>(classes.size()) * half_of_last_digit; }

TEST_F(PackedTown, ViewsByEightAzimuthsAddUp) {
  folder.must("farlod-svf a.farlod -o o.csv --quantity view_factors,view_factors_below --wall-sectors 8" + at_crossing);
  const CsvTable row = table("o.csv");
  EXPECT_EQ(row.header().size(), 6U + 13U + 12U);
  EXPECT_NEAR(sum_of_view(row, by_eighths, ""), 1.0, rounding_of(by_eighths));
  EXPECT_THAT(row.header(), IsSupersetOf({"view_wall_nw_below", "view_ground_below"}));
  EXPECT_NEAR(row.number(0, "view_sky"), row.number(0, "svf"), 3.0 * half_of_last_digit);
}

TEST_F(PackedTown, ViewsAroundAPlaceAddUp) {
  folder.must("farlod-svf a.farlod -o o.csv --quantity view_cube,view_sphere,view_eye --eye-field 45 --height 1.6" + at_crossing);
  const CsvTable row = table("o.csv");
  EXPECT_EQ(row.header().size(), 6U + 8U * 9U);
  for (const char* ending : {"_up", "_down", "_north", "_east", "_south", "_west", "_sphere", "_eye"})
    EXPECT_NEAR(sum_of_view(row, by_quarters, ending), 1.0, rounding_of(by_quarters)) << ending;
  EXPECT_NEAR(row.number(0, "view_sky_up"), row.number(0, "svf"), 3.0 * half_of_last_digit);
  EXPECT_EQ(row.number(0, "view_sky_down"), 0.0);
  EXPECT_GT(row.number(0, "view_wall_n_south") + row.number(0, "view_wall_n_up"), 0.0);
}

TEST_F(PackedTown, ViewsBySolidAngleAreOfTheSolidAngle) {
  const std::string quantities = "--quantity view_factors,view_factors_below,view_sphere";
  folder.must("farlod-svf a.farlod -o o.csv --sky solid " + quantities + at_crossing);
  const CsvTable solid = table("o.csv");
  folder.must("farlod-svf a.farlod -o o.csv " + quantities + ",svf_solid" + at_crossing);
  const CsvTable cosine = table("o.csv");
  EXPECT_NEAR(sum_of_view(solid, by_quarters, ""), 1.0, rounding_of(by_quarters));
  EXPECT_NEAR(solid.number(0, "view_sky"), cosine.number(0, "svf_solid"), 0.01);
  EXPECT_LT(solid.number(0, "view_sky"), cosine.number(0, "view_sky") - 0.02);
  EXPECT_NEAR(2.0 * solid.number(0, "view_sky_sphere"), solid.number(0, "view_sky"), 3.0 * half_of_last_digit);
  EXPECT_NEAR(solid.number(0, "view_sky_sphere"), cosine.number(0, "view_sky_sphere"), 3.0 * half_of_last_digit);
}

/// Horizons and hours of sunshine have no weight.
TEST_F(PackedTown, HorizonsAreTheSameBesideSolidAngles) {
  const std::string quantities = "--horizons 8 --sun 2026-06-21 --quantity horizon_distance,shadow_patches" + at_crossing;
  folder.must("farlod-svf a.farlod -o o.csv " + quantities);
  const CsvTable cosine = table("o.csv");
  folder.must("farlod-svf a.farlod -o o.csv --sky solid " + quantities);
  const CsvTable solid = table("o.csv");
  EXPECT_NE(solid.number(0, "svf_solid"), cosine.number(0, "svf"));
  for (const char* column : {"horizon_000", "horizon_135", "horizon_270", "distance_270", "sunlit_h", "shadow_1"})
    EXPECT_EQ(solid.text(0, column), cosine.text(0, column)) << column;
}

TEST_F(PackedTown, ViewsAreBandsOfARaster) {
  folder.must("farlod-svf a.farlod -o o.tif --grid 20 --rays 100 --quantity view_eye,view_factors --wall-sectors 8");
  EXPECT_THAT(band_names(folder.path("o.tif")),
              AllOf(Contains("view_wall_ne"), Contains("view_wall_ne_eye"), Not(Contains("view_sky_up"))));
}

/// Roofs and walls that face a tower see it; its own flat roof and its walls do not.
TEST_F(PackedTown, ABuildingIsSeenFromSurfacesOfOthers) {
  const std::string tower = tower_of(small_town()).id;
  folder.must("farlod-svf a.farlod -o o.csv --surfaces all --spacing 12 --quantity view_building --sees " + tower);
  const CsvTable surfaces = table("o.csv");
  std::size_t own = 0, seeing = 0;
  for (std::size_t n = 0; n < surfaces.size(); ++n) {
    const bool is_own = surfaces.text(n, "building") == tower;
    own += is_own ? 1 : 0;
    seeing += surfaces.number(n, "sees_building") == 1.0 ? 1 : 0;
    EXPECT_EQ(surfaces.number(n, "view_building") > 0.0, surfaces.number(n, "sees_building") == 1.0) << n;
    if (is_own) {
      EXPECT_EQ(surfaces.number(n, "sees_building"), 0.0) << n;
    }
  }
  EXPECT_GT(own, 0U);
  EXPECT_GT(seeing, own);
  EXPECT_LT(seeing, surfaces.size() - own);
}

TEST_F(PackedTown, ABuildingIsBandsOfARaster) {
  folder.must("farlod-svf a.farlod -o o.tif --grid 20 --rays 100 --quantity view_building --sees " + small_town().front().id);
  EXPECT_THAT(band_names(folder.path("o.tif")), ElementsAre("svf", "view_building", "sees_building"));
}

TEST_F(PackedTown, ABuildingIsMarkedInPicturesOfItsViewAlone) {
  const std::string colour_of_landmark = "#d55e00";
  const std::string run = "farlod-svf a.farlod -o o.tif --grid 20 --rays 100 --preview o.svg --sees " + small_town().front().id;
  folder.must(run + " --quantity svf,view_building");
  EXPECT_THAT(folder.colours_of("o.svg"), Contains(colour_of_landmark));
  folder.must(run + " --quantity view_building,svf");
  EXPECT_THAT(folder.colours_of("o.svg"), Not(Contains(colour_of_landmark)));
}

TEST_F(PackedTown, ABuildingThatThereIsNotIsRefusedByOneThatThereIs) {
  const std::string id = small_town().front().id, near = id + "x";
  for (const std::string& run : std::vector<std::string>{"-o o.csv" + at_crossing, "-o o.tif --grid 20",
                                                         "-o o.tif --grid 20 --dry-run", "-o o.csv --surfaces all"}) {
    const Outcome refused = folder.run("farlod-svf a.farlod --quantity view_building --sees " + near + " " + run);
    EXPECT_EQ(refused.exit_code, exit_usage) << run;
    EXPECT_EQ(refused.err, "farlod-svf: the package has no building \"" + near + "\"; did you mean " + id + "?\n") << run;
  }
}

TEST_F(PackedTown, ViewsThatDoNotFitAreRefused) {
  const auto refused = [&](const std::string& arguments, const std::vector<std::string>& said) {
    expect_refusal(folder.run("farlod-svf a.farlod -o o.csv " + arguments), exit_usage, said);
  };
  refused("--at 1,2 --sky solid --quantity view_cube", {"--quantity", "--sky solid", "view_sphere"});
  refused("--at 1,2 --quantity view_building", {"--quantity", "--sees"});
  refused("--at 1,2 --sees b1", {"--sees", "view_building"});
  refused("--at 1,2 --quantity view_building --sees b1 --wall-sectors 8", {"--wall-sectors", "view_factors"});
  refused("--at 1,2 --wall-sectors 8", {"--wall-sectors", "view_factors"});
  refused("--at 1,2 --quantity view_factors --eye-field 20", {"--eye-field", "view_eye"});
  for (const std::string word : {"view_cube", "view_sphere", "view_eye"})
    refused("--surfaces all --quantity " + word, {"--quantity", word, "--points instead of --surfaces"});
}

}  // namespace
}  // namespace farlod::acceptance
