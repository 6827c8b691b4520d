// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <map>

#include "farlod/box.hpp"
#include "farlod/error.hpp"
#include "tests/acceptance/packed_town.hpp"
#include "tests/acceptance/street_trees.hpp"

// What farlod-svf computes of the trees of a package.

namespace farlod::acceptance {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// The small town, `a.farlod`, and the same with trees in its streets, `b.farlod`.
class TreeTown : public PackedTown {
 protected:
  TreeTown() {
    folder.write("trees.csv", street_trees());
    folder.must("farlod-pack town.geojson --trees trees.csv -o b.farlod --quiet");
  }
  /// The mean of each column over a part of a street.
  [[nodiscard]] std::map<std::string, double> means_in_street(const std::string& arguments) const {
    Box2d street;
    for (const Point2d p_town : {Point2d{-95.0, -8.0}, {95.0, 8.0}}) street.add(p_projected(p_town));
    const std::string box = text_of(street.low) + "," + text_of(street.high);
    folder.must("farlod-svf b.farlod -o street.tif --grid 2 --bbox " + box + " " + arguments);
    std::map<std::string, double> means;
    int band = 0;
    for (const std::string& column : band_names(folder.path("street.tif"))) {
      double sum = 0.0, count = 0.0;
      for (const auto& value : read_raster(folder.path("street.tif"), ++band).values)
        if (value) sum += *value, count += 1.0;
      EXPECT_GT(count, 100.0);
      means[column] = sum / count;
    }
    return means;
  }
};

const std::string under_trees = text_of(p_projected({-60.0, 4.0}));

TEST_F(TreeTown, HasColumnsOfItsCrowns) {
  folder.must("farlod-svf b.farlod -o o.csv --quantity svf_total,svfaveg,shares --summary s.json --at " + under_trees);
  const CsvTable row = table("o.csv");
  EXPECT_THAT(row.header(), ElementsAre("id", "x_m", "y_m", "z_m", "svf", "svf_total", "svfveg", "svfaveg", "share_sky",
                                        "share_vegetation", "share_building"));
  const auto at = [&](const char* column) { return row.number(0, column); };
  EXPECT_NEAR(at("svf_total"), at("svf") - (1.0 - at("svfveg")) * 0.97, 3.0 * half_of_last_digit);
  EXPECT_NEAR(at("share_sky"), at("svf") + at("svfveg") - 1.0, 3.0 * half_of_last_digit);
  EXPECT_NEAR(at("share_sky") + at("share_vegetation") + at("share_building"), 1.0, 3.0 * half_of_last_digit);
  EXPECT_LT(at("svf_total"), 0.95 * at("svf")) << "it stands beside a tree";
  EXPECT_EQ(folder.json_of("s.json").at("quantities").size(), 6U);
}

TEST_F(TreeTown, HasBoundsOfTheTotalWhereThereAreSomeOfSvf) {
  folder.must(
      "farlod-svf b.farlod -o o.csv --surfaces all --spacing 10 --quantity svf_total --bounds --verify 40 --summary s.json");
  const CsvTable rows = table("o.csv");
  const std::vector<std::string> header = rows.header();
  const auto first = std::ranges::find(header, "svf_total");
  ASSERT_GE(header.end() - first, 4);
  EXPECT_THAT(std::vector(first, first + 4), ElementsAre("svf_total", "svf_total_low", "svf_total_high", "svfveg"));
  double least = 1.0, width = 0.0, count = 0.0;
  for (std::size_t n = 0; n < rows.size(); ++n) {
    if (rows.text(n, "svf_total").empty()) continue;
    const double total = rows.number(n, "svf_total"), low = rows.number(n, "svf_total_low"),
                 high = rows.number(n, "svf_total_high");
    EXPECT_LE(low, total);
    EXPECT_LE(total, high);
    least = std::min(least, total);
    width += high - low;
    count += 1.0;
  }
  const auto summary = folder.json_of("s.json");
  EXPECT_NEAR(summary.at("svf_total").at("min"), least, half_of_last_digit);
  EXPECT_NEAR(summary.at("svf_total_bounds").at("mean_width"), width / count, 2.0 * half_of_last_digit);
  EXPECT_EQ(summary.at("svf_total_verify").at("count"), 40U);
  EXPECT_LT(summary.at("svf_total_verify").at("mean_abs_error"), 0.01);
}

TEST_F(TreeTown, KeepsErrorsThatAreAskedForWithItsCrowns) {
  folder.must(
      "farlod-svf b.farlod -o o.csv --surfaces all --spacing 10 --quantity svf_total --max-error 0.005 --verify 60 --summary "
      "s.json");
  EXPECT_LE(folder.json_of("s.json").at("svf_total_verify").at("max_abs_error"), 0.005);
}

TEST_F(TreeTown, SaysTheTotalAtTheEnd) {
  const Outcome run = folder.run("farlod-svf b.farlod -o o.csv --quantity svf_total --at " + under_trees);
  EXPECT_THAT(run.out, HasSubstr("svf_total: min 0."));
}

TEST_F(TreeTown, HasTheSameSkyViewFactorsAsTheTownWithoutTrees) {
  for (const std::string package : {"a", "b"})
    folder.must("farlod-svf " + package + ".farlod -o " + package + ".tif --grid 8 --quantity directional --horizons 8");
  for (int band = 1; band <= 13; ++band)
    EXPECT_EQ(read_raster(folder.path("a.tif"), band).values, read_raster(folder.path("b.tif"), band).values) << band;
}

TEST_F(TreeTown, IsOpenWhereThereAreNone) {
  folder.must("farlod-svf a.farlod -o o.csv --quantity svf_total,svfaveg,shares --at " + under_trees);
  const CsvTable row = table("o.csv");
  EXPECT_NEAR(row.number(0, "svf_total"), row.number(0, "svf"), half_of_last_digit);
  EXPECT_EQ(row.number(0, "svfveg"), 1.0);
  EXPECT_EQ(row.number(0, "svfaveg"), 1.0);
  EXPECT_EQ(row.number(0, "share_vegetation"), 0.0);
}

TEST_F(TreeTown, HasTheFifteenFilesOfUmepForSolweigAndItsTotal) {
  std::vector<std::string> names{"svf"};
  for (const std::string kind : {"", "veg", "aveg"})
    for (const std::string half : {"N", "E", "S", "W"}) names.push_back("svf" + half + kind);
  names.insert(names.end(), {"svfveg", "svfaveg", "svf_total"});
  const auto band = [&](const std::string& name) {
    return read_raster("/vsizip/" + folder.path("svfs.zip").string() + "/" + name + ".tif");
  };
  for (const std::string package : {"b", "a"}) {
    folder.must("farlod-svf " + package + ".farlod -o svfs.zip --grid 8 --leaf-off");
    const std::string zip = folder.text_of("svfs.zip");
    for (const std::string& name : names)
      EXPECT_EQ(zip.find(name + ".tif") != std::string::npos, package == "b" || name.size() <= 4) << package << ' ' << name;
  }
  folder.must("farlod-svf b.farlod -o svfs.zip --grid 8");
  for (const std::string kind : {"", "veg", "aveg"}) {
    const RasterFile whole = band("svf" + kind), north = band("svfN" + kind), south = band("svfS" + kind);
    for (std::size_t n = 0; n < whole.values.size(); ++n) {
      ASSERT_EQ(whole.values[n].has_value(), north.values[n].has_value());
      if (!whole.values[n]) continue;
      EXPECT_NEAR(0.5 * (*north.values[n] + *south.values[n]), *whole.values[n], 2e-6) << kind;
    }
  }
}

TEST_F(TreeTown, HasNoVegetationInItsHalvesWhereThereAreNoTrees) {
  folder.must("farlod-svf a.farlod -o svfs.zip --grid 8 --quantity svf_total,svfaveg,directional_vegetation");
  for (const std::string name : {"svfveg", "svfaveg", "svfNveg", "svfWaveg"})
    for (const auto& value : read_raster("/vsizip/" + folder.path("svfs.zip").string() + "/" + name + ".tif").values)
      EXPECT_EQ(value.value_or(1.0), 1.0) << name;
}

TEST_F(TreeTown, LetsMoreThroughInWinterAndByOtherRules) {
  const auto in_summer = means_in_street("--quantity svf_total");
  const auto mean_with = [&](const std::string& options) {
    return means_in_street("--quantity svf_total " + options).at("svf_total");
  };
  const double summer = in_summer.at("svf_total"), svf = in_summer.at("svf"), winter = mean_with("--leaf-off"),
               opaque = mean_with("--transmissivity 0"), half = mean_with("--transmissivity 0.5"),
               each = mean_with("--canopy-rule crowns --leaf-off"), beer = mean_with("--canopy-rule beer"),
               thin = mean_with("--canopy-rule beer --extinction 0.1");
  EXPECT_LT(opaque, summer);
  EXPECT_LT(summer, winter);
  EXPECT_NEAR(half, winter, 1e-6);
  EXPECT_LT(each, winter);
  EXPECT_LT(beer, thin);
  EXPECT_LT(winter, svf);
}

TEST_F(TreeTown, IsTheSameToAllEngines) {
  const std::string arguments = "--quantity svf_total,svfaveg --rays 20000 ";
  const auto exact = means_in_street(arguments + "--engine exact"), automatic = means_in_street(arguments + "--engine auto"),
             rays = means_in_street(arguments + "--engine rays");
  for (const char* column : {"svf_total", "svfveg", "svfaveg"}) {
    EXPECT_NEAR(automatic.at(column), exact.at(column), 0.002) << column;
    EXPECT_NEAR(rays.at(column), exact.at(column), 0.002) << column;
  }
}

TEST_F(TreeTown, NamesTheRuleInItsResults) {
  folder.must("farlod-svf b.farlod -o o.nc --grid 8 --quantity svf_total --canopy-rule beer --extinction 0.4 --leaf-off");
  EXPECT_THAT(folder.text_of("o.nc"), HasSubstr("--canopy-rule beer --extinction 0.4 --leaf-off"));
}

TEST_F(TreeTown, ShowsItsCrownsInPicturesOfTheSky) {
  const std::string colour_of_crowns = "#008c64";
  for (const std::string package : {"a", "b"})
    folder.must("farlod-svf " + package + ".farlod -o " + package + ".svg --at " + under_trees);
  EXPECT_THAT(folder.colours_of("b.svg"), testing::Contains(colour_of_crowns));
  EXPECT_THAT(folder.colours_of("a.svg"), testing::Not(testing::Contains(colour_of_crowns)));
}

TEST_F(TreeTown, OptionsThatDoNotFitAreRefused) {
  const auto refused = [&](const std::string& arguments, const std::vector<std::string>& said) {
    expect_refusal(folder.run("farlod-svf b.farlod -o o.csv --at 1,2 " + arguments), exit_usage, said);
  };
  refused("--quantity svf_total --transmissivity 3", {"--transmissivity"});
  refused("--quantity svf_total --canopy-rule beer --transmissivity 0.1", {"--transmissivity", "--extinction"});
  refused("--quantity svf_total --extinction 0.1", {"--extinction", "--canopy-rule beer"});
  refused("--quantity svf_total --canopy-rule often", {"--canopy-rule"});
  refused("--leaf-off", {"nothing of trees", "--quantity svf_total"});
  refused("--sky solid --quantity svf_total", {"--quantity", "--sky solid"});
}

}  // namespace
}  // namespace farlod::acceptance
