// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>

#include "farlod/error.hpp"
#include "results/output_format.hpp"
#include "tests/acceptance/packed_town.hpp"

// --bounds and --max-error, as users ask for them.

namespace farlod::acceptance {
namespace {

using nlohmann::json;

class ErrorControl : public PackedTown {
 protected:
  [[nodiscard]] json summary_of(const std::string& command) const {
    folder.must(command + " --quiet --summary s.json");
    return folder.json_of("s.json");
  }
};

#ifdef FARLOD_WITH_GDAL
TEST_F(ErrorControl, BoundsAreTwoMoreBandsAroundTheExactValue) {
  folder.must("farlod-svf a.farlod -o a.tif --grid 20 --bounds --engine rays");
  folder.must("farlod-svf a.farlod -o exact.tif --grid 20 --bounds --engine exact");
  ASSERT_THAT(band_names(folder.path("a.tif")), testing::ElementsAre("svf", "svf_low", "svf_high"));
  const RasterFile svf = raster("a.tif"), exact = raster("exact.tif");
  const RasterFile low = read_raster(folder.path("a.tif"), 2), high = read_raster(folder.path("a.tif"), 3);
  std::size_t answers = 0;
  for (std::size_t n = 0; n < svf.values.size(); ++n) {
    ASSERT_EQ(svf.values[n].has_value(), low.values[n].has_value());
    ASSERT_EQ(svf.values[n].has_value(), high.values[n].has_value());
    if (!svf.values[n]) continue;
    ++answers;
    EXPECT_LE(*low.values[n], *svf.values[n]);
    EXPECT_LE(*svf.values[n], *high.values[n]);
    EXPECT_LE(*low.values[n], *exact.values[n]);
    EXPECT_LE(*exact.values[n], *high.values[n]);
  }
  EXPECT_GT(answers, 100U);
}

TEST_F(ErrorControl, BoundsOfHorizonsHoldTheTrueValueWhateverTheAzimuths) {
  folder.must("farlod-svf a.farlod -o exact.tif --grid 20 --bounds --engine exact");
  const RasterFile exact = raster("exact.tif");
  for (const std::string azimuths : {"8", "60", "320", "1000"}) {
    folder.must("farlod-svf a.farlod -o a.tif --grid 20 --bounds --azimuths " + azimuths);
    const RasterFile svf = raster("a.tif"), low = read_raster(folder.path("a.tif"), 2),
                     high = read_raster(folder.path("a.tif"), 3);
    for (std::size_t n = 0; n < svf.values.size(); ++n) {
      if (!svf.values[n]) continue;
      EXPECT_LE(*low.values[n], *svf.values[n]);
      EXPECT_LE(*svf.values[n], *high.values[n]);
      EXPECT_LE(*low.values[n], *exact.values[n]) << n << ", " << azimuths;
      EXPECT_LE(*exact.values[n], *high.values[n]) << n << ", " << azimuths;
    }
  }
}

TEST_F(ErrorControl, WithoutBoundsARasterHasOneBand) {
  folder.must("farlod-svf a.farlod -o a.tif --grid 40");
  EXPECT_THAT(band_names(folder.path("a.tif")), testing::ElementsAre("svf"));
}
#endif

TEST_F(ErrorControl, BoundsAreTwoMoreColumns) {
  folder.must("farlod-svf a.farlod -o a.csv --surfaces all --spacing 10 --bounds");
  const CsvTable receivers = table("a.csv");
  EXPECT_THAT(receivers.header(), testing::Contains("svf_low"));
  EXPECT_THAT(receivers.header(), testing::Contains("svf_high"));
  double width_sum = 0.0, width_max = 0.0, count = 0.0;
  for (std::size_t row = 0; row < receivers.size(); ++row) {
    EXPECT_EQ(receivers.text(row, "svf").empty(), receivers.text(row, "svf_low").empty());
    if (receivers.text(row, "svf").empty()) continue;
    EXPECT_LE(receivers.number(row, "svf_low"), receivers.number(row, "svf"));
    EXPECT_LE(receivers.number(row, "svf"), receivers.number(row, "svf_high"));
    const double width = receivers.number(row, "svf_high") - receivers.number(row, "svf_low");
    width_sum += width;
    width_max = std::max(width_max, width);
    count += 1.0;
  }
  EXPECT_GT(width_sum, 0.0);
  const json bounds = summary_of("farlod-svf a.farlod -o a.csv --surfaces all --spacing 10 --bounds").at("bounds");
  EXPECT_NEAR(bounds.at("mean_width"), width_sum / count, 2.0 * half_of_last_digit);
  EXPECT_NEAR(bounds.at("max_width"), width_max, 2.0 * half_of_last_digit);
}

TEST_F(ErrorControl, TheExactEngineIsCertain) {
  const json s = summary_of("farlod-svf a.farlod -o a.csv --at " + text_of(p_projected({0.0, 0.0})) + " --bounds --engine exact");
  EXPECT_EQ(s.at("bounds").at("max_width"), 0.0);
}

TEST_F(ErrorControl, ErrorsThatAreAskedForAreKept) {
  const std::string places = " --surfaces all --spacing 12";
  folder.must("farlod-svf a.farlod -o exact.csv --bounds --engine exact --rays 1" + places);
  const CsvTable exact = table("exact.csv");
  std::size_t decided_before = 0;
  for (const double max_error : {0.02, 0.005, 0.001, 0.0002}) {
    const json s = summary_of("farlod-svf a.farlod -o a.csv --max-error " + std::to_string(max_error) + places);
    const CsvTable answers = table("a.csv");
    for (std::size_t row = 0; row < answers.size(); ++row) {
      if (answers.text(row, "svf").empty()) continue;
      EXPECT_NEAR(answers.number(row, "svf"), exact.number(row, "svf"), max_error + 2.0 * half_of_last_digit) << row;
    }
    EXPECT_GE(s.at("max_error").at("rays_traced_exactly"), decided_before);
    EXPECT_EQ(s.at("max_error").at("far_share"), max_error);
    decided_before = s.at("max_error").at("rays_traced_exactly");
  }
  EXPECT_GT(decided_before, 0U);
}

TEST_F(ErrorControl, HoweverLargeAnErrorIsAllowed) {
  for (const std::string quantity : {"svf", "svf_total"}) {
    const json s =
        summary_of("farlod-svf a.farlod -o a.csv --surfaces roofs --spacing 12 --bounds --max-error 1 --quantity " + quantity);
    EXPECT_GE(s.at("azimuths"), 8);
    EXPECT_EQ(s.at("max_error").at("rays_traced_exactly"), 0);
  }
}

TEST_F(ErrorControl, WhatTheMapLeavesOpenIsTraced) {
  // So small an error that the map's own certainty is never enough where anything is open at all
  const json s = summary_of("farlod-svf a.farlod -o a.csv --surfaces walls --spacing 6 --bounds --max-error 0.002");
  EXPECT_GT(s.at("max_error").at("rays_traced_exactly"), 0);
  EXPECT_LE(s.at("bounds").at("max_width"), 2.0 * s.at("max_error").at("far_share").get<double>());
}

TEST_F(ErrorControl, ThePackageChoosesItsGrid) {
  const json s = summary_of("farlod-pack town.geojson -o b.farlod --max-error 0.02");
  const json& chosen = s.at("chosen");
  EXPECT_TRUE(chosen.at("keeps_error"));
  EXPECT_LE(chosen.at("expected").at("max_error"), 0.01);
  EXPECT_LE(chosen.at("measured").at("max_error"), 0.01);
  EXPECT_GT(chosen.at("measured").at("receivers"), 50);
  const json svf = summary_of("farlod-svf b.farlod -o b.csv --surfaces all --spacing 12 --max-error 0.02 --verify 100");
  EXPECT_LE(svf.at("verify").at("max_abs_error"), 0.02);
}

TEST_F(ErrorControl, WhatTheUserFixesIsNotChosen) {
  const json s = summary_of("farlod-pack town.geojson -o b.farlod --max-error 0.02 --cell 40 --neighborhood 5");
  EXPECT_EQ(s.at("cell_m"), 40.0);
  EXPECT_EQ(s.at("neighborhood"), 5);
}

TEST_F(ErrorControl, BoxMapsKnowNoErrors) {
  folder.must("farlod-pack town.geojson -o box.farlod --far-map box");
  for (const char* option : {"--bounds", "--max-error 0.01"})
    expect_refusal(folder.run(std::string("farlod-svf box.farlod -o o.csv --surfaces roofs ") + option), exit_unusable_input,
                   {"box.farlod", "--far-map horizon"});
  expect_refusal(folder.run("farlod-pack town.geojson -o c.farlod --far-map box --max-error 0.01"), exit_usage, {"--max-error"});
}

TEST_F(ErrorControl, FormatsWithoutRoomForBoundsAreRefused) {
  for (const OutputFormat& format : output_formats()) {
    if (format.holds_bounds) continue;
    const std::string ending(format.endings[0]);
    const bool is_table = format.holds_tables();
    const std::string with_room =
        endings_where([&](const OutputFormat& f) { return f.holds_bounds && (is_table ? f.holds_tables() : f.holds_rasters()); });
    expect_refusal(folder.run("farlod-svf a.farlod -o o" + ending + (is_table ? " --surfaces all" : " --grid 20") + " --bounds"),
                   exit_usage, {"--bounds", "ends in " + ending, with_room});
  }
}

TEST_F(ErrorControl, ImpossibleWishesAreRefused) {
  expect_refusal(folder.run("farlod-svf a.farlod -o o.csv --surfaces all --azimuths 7 --max-error 0.01"), exit_usage,
                 {"--max-error", "at least 8 azimuths"});
  expect_refusal(folder.run("farlod-svf a.farlod -o o.csv --surfaces all --azimuths 4 --bounds"), exit_usage,
                 {"--bounds", "at least 8 azimuths"});
  expect_refusal(
      folder.run("farlod-svf a.farlod -o o.csv --surfaces all --engine rays --quantity svf_total --rays 100 --max-error 0.01"),
      exit_usage, {"--max-error", "100 rays", "leave the numbers", "at least"});
  expect_refusal(folder.run("farlod-svf a.farlod -o o.csv --surfaces all --max-error nan"), exit_usage, {"--max-error"});
}

}  // namespace
}  // namespace farlod::acceptance
