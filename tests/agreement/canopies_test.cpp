// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "align/align.hpp"
#include "evaluate/error_budget.hpp"
#include "evaluate/sky_evaluator.hpp"
#include "evaluate/verification.hpp"
#include "georeference/georeference.hpp"
#include "ingest/files/input_search.hpp"
#include "ingest/ingest.hpp"
#include "receivers/point_receivers.hpp"
#include "tests/agreement/random_receivers.hpp"
#include "tests/scenes/generated_town.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/packed_once.hpp"
#include "tests/scenes/planted_crowns.hpp"
#include "tests/scenes/test_data.hpp"
#include "tiles/tiles.hpp"

// Crowns as intervals of slopes above horizons against crowns that are traced, in a town with 100 trees a hectare.

namespace farlod {
namespace {

constexpr double town_m = 500.0, trees_per_ha = 100.0;

PackageReader town_with_trees() {
  const auto pack = [](const std::filesystem::path& folder) {
    CitySettings settings{.size_m = town_m, .lod = 2, .overhangs = true};
    const CityModel city = scenes::generated_town(settings);
    scenes::pack_city(city, scenes::grid_covering(city, Angle::degrees(23.0), 50.0, 3), folder / "town.farlod");
    const auto trees = static_cast<std::size_t>(1e-4 * town_m * town_m * trees_per_ha);
    CrownsOfCity crowns = scenes::random_crowns(PackageReader(folder / "town.farlod"), trees);
    scenes::plant(crowns, folder / "town.farlod");
    return true;
  };
  return PackageReader(scenes::packed_once({"town_with_trees", "", scenes::this_program()}, pack) / "town.farlod");
}

constexpr double square_m_of_ha = 1e4;

/// A city from its file, with as many trees a hectare.
PackageReader real_city_with_trees(const std::filesystem::path& file, const std::filesystem::path& folder) {
  Report report;
  const std::vector inputs{file};
  ingest::IngestSettings settings;
  settings.footprints.height_field = "TAKASA";
  const ingest::FoundInputs found = ingest::find_input_files(inputs, report);
  LocatedCity located = georeference::georeference(ingest::ingest_all(found.files, settings, report), {}, report);
  const Grid grid = align::align(located, {}, report).grid;
  scenes::pack_tiles(tiles::cut_into_tiles(std::move(located), grid, Assign::clip, std::nullopt, report), grid, folder, {});
  const double area_m2 = grid.cell_edge_m * grid.cell_edge_m * static_cast<double>(grid.cells.size());
  CrownsOfCity crowns =
      scenes::random_crowns(PackageReader(folder), static_cast<std::size_t>(area_m2 / square_m_of_ha * trees_per_ha));
  scenes::plant(crowns, folder);
  return PackageReader(folder);
}

/// A value of each receiver for each column, and svf.
using Columns = std::map<std::string, std::vector<double>>;

Columns columns_of_receivers(const PackageReader& package, SkySettings settings, const std::vector<CellReceivers>& receivers) {
  settings.further.svf_total = settings.further.svfaveg = settings.further.sky_shares = settings.further.directional_vegetation =
      true;
  const SkyEvaluator evaluator(package, settings);
  std::size_t count = 0;
  for (const CellReceivers& cell : receivers) count += cell.receivers.size();
  const std::vector<std::string> names = columns_of(settings.further);
  std::vector<float> svf(count), further(count * names.size());
  for (const CellReceivers& cell : receivers) evaluator.evaluate(cell, SkyAnswers(svf, {}, {}, further));
  Columns columns{{"svf", {svf.begin(), svf.end()}}};
  for (std::size_t n = 0; n < further.size(); ++n) columns[names[n % names.size()]].push_back(static_cast<double>(further[n]));
  return columns;
}

std::vector<CellReceivers> in_streets(const PackageReader& package) {
  RandomSky random;
  std::vector<CellReceivers> all;
  for (std::size_t n = 0; n < 300; ++n) {
    all.push_back(random.receiver(package));
    all.back().receivers[0].index = n;
  }
  return all;
}

std::vector<CellReceivers> on_surfaces(const PackageReader& package) {
  std::vector<CellReceivers> all;
  std::size_t index = 0, found = 0;
  for (std::size_t n = 0; n < static_cast<std::size_t>(package.grid().cells.size()); ++n) {
    const Cell cell = package.grid().cells.cell_at(n);
    all.push_back({cell, {}});
    for (const SurfaceReceiver& r : surface_receivers(package, cell, SurfaceChoice::all, 8.0))
      if (!r.is_inside_building && ++found % 20 == 0) all.back().receivers.push_back({index++, r.p_cell, r.normal});
  }
  return all;
}

/// Errors of columns of all crowns.
void expect_small_errors(const Columns& automatic, const Columns& exact, const std::vector<std::string>& columns) {
  for (const std::string& column : columns) {
    const ErrorSummary errors = summarize_errors(automatic.at(column), exact.at(column));
    testing::Test::RecordProperty("max_error_" + column, std::to_string(errors.max_abs_error));
    testing::Test::RecordProperty("mean_error_" + column, std::to_string(errors.mean_abs_error));
    EXPECT_LE(errors.max_abs_error, 0.02) << column;
    EXPECT_LE(errors.mean_abs_error, 0.001) << column;
  }
}

struct Where {
  const char* name;
  std::vector<CellReceivers> (*receivers)(const PackageReader&);
};
void PrintTo(const Where& where, std::ostream* out) { *out << where.name; }

struct Rule {
  const char* name;
  CanopySettings canopy;
};
void PrintTo(const Rule& rule, std::ostream* out) { *out << rule.name; }

class Canopies : public testing::TestWithParam<std::tuple<Where, Rule>> {
 protected:
  [[nodiscard]] SkySettings settings(Engine engine, std::size_t rays = 20000) const {
    SkySettings settings{engine, SkyWeight::cosine, rays};
    settings.further.canopy = std::get<Rule>(GetParam()).canopy;
    return settings;
  }
  [[nodiscard]] std::vector<CellReceivers> receivers(const PackageReader& package) const {
    return std::get<Where>(GetParam()).receivers(package);
  }
};

TEST_P(Canopies, OfHorizonsAreThoseOfRays) {
  const PackageReader package = town_with_trees();
  const std::vector<CellReceivers> places = receivers(package);
  const Columns exact = columns_of_receivers(package, settings(Engine::exact), places),
                automatic = columns_of_receivers(package, settings(Engine::automatic), places);
  ASSERT_GT(exact.at("svf").size(), 250U);
  expect_small_errors(automatic, exact, {"svf_total", "svfveg", "svfNveg", "svfEveg", "svfSveg", "svfWveg"});
  // What crowns hide of solid things is asked of some hundred rays
  for (const char* column : {"svfaveg", "svfNaveg", "svfEaveg", "svfSaveg", "svfWaveg", "share_building", "share_vegetation"})
    EXPECT_LE(summarize_errors(automatic.at(column), exact.at(column)).mean_abs_error, 0.01) << column;
}

TEST_P(Canopies, HideMuchAndKeepToTheirDefinitions) {
  const PackageReader package = town_with_trees();
  for (const Engine engine : {Engine::automatic, Engine::rays, Engine::exact}) {
    const Columns columns = columns_of_receivers(package, settings(engine, 1000), receivers(package));
    double hidden = 0.0;
    for (std::size_t n = 0; n < columns.at("svf").size(); ++n) {
      const auto at = [&](const char* column) { return columns.at(column)[n]; };
      EXPECT_GE(at("svf_total"), 0.0);
      EXPECT_LE(at("svf_total"), at("svf"));
      EXPECT_NEAR(at("share_sky") + at("share_vegetation") + at("share_building"), 1.0, 1e-6);
      EXPECT_NEAR(at("share_sky"), at("svf") + at("svfveg") - 1.0, 1e-6);
      for (const std::string kind : {"veg", "aveg"}) {
        const auto half = [&](const char* name) { return columns.at(name + kind)[n]; };
        EXPECT_NEAR(0.5 * (half("svfN") + half("svfS")), half("svf"), 2e-6);
        EXPECT_NEAR(0.5 * (half("svfE") + half("svfW")), half("svf"), 2e-6);
      }
      hidden += at("svf") - at("share_sky");
    }
    EXPECT_GT(hidden / static_cast<double>(columns.at("svf").size()), 0.05) << "crowns hide too little to tell";
  }
}

constexpr Where everywhere[] = {{"Streets", in_streets}, {"Surfaces", on_surfaces}};

class CanopiesOfOneShare : public testing::TestWithParam<Where> {};

TEST_P(CanopiesOfOneShare, LetItThroughByTheRuleOfUmep) {
  const PackageReader package = town_with_trees();
  SkySettings settings{Engine::automatic, SkyWeight::cosine, 20000};
  settings.further.canopy = {CanopyRule::once, Season::leaf_on, 0.2};
  const Columns columns = columns_of_receivers(package, settings, GetParam().receivers(package));
  for (std::size_t n = 0; n < columns.at("svf").size(); ++n)
    EXPECT_NEAR(columns.at("svf_total")[n], columns.at("svf")[n] - (1.0 - columns.at("svfveg")[n]) * 0.8, 2e-5);
}

INSTANTIATE_TEST_SUITE_P(Town, CanopiesOfOneShare, testing::ValuesIn(everywhere),
                         [](const auto& where) { return std::string(where.param.name); });

INSTANTIATE_TEST_SUITE_P(
    Town, Canopies,
    testing::Combine(testing::ValuesIn(everywhere),
                     testing::Values(Rule{"Umep", {}}, Rule{"UmepLeafOff", {CanopyRule::once, Season::leaf_off}},
                                     Rule{"Crowns", {CanopyRule::each}}, Rule{"Beer", {CanopyRule::beer, Season::leaf_off}})),
    [](const auto& test) { return std::string(std::get<0>(test.param).name) + std::get<1>(test.param).name; });

/// What the samples themselves may do: the laws of docs/stages/evaluate.md, "How sure".
constexpr std::size_t many_azimuths = 2048, many_rays = 20000;
double error_of_samples() { return azimuth_error(many_azimuths) + sampling_error(many_rays); }

/// Where bounds hold the exact values of as many rays, how wide they are on average.
double width_of_bounds(const PackageReader& package, SkySettings settings, const std::vector<CellReceivers>& places) {
  settings.rays = many_rays;
  settings.engine = Engine::exact;
  const Columns exact = columns_of_receivers(package, settings, places);
  settings.engine = Engine::automatic;
  settings.azimuths = many_azimuths;
  settings.further.svf_total_bounds = true;
  const Columns bounded = columns_of_receivers(package, settings, places);
  double width = 0.0;
  for (std::size_t n = 0; n < exact.at("svf_total").size(); ++n) {
    const auto at = [&](const char* column) { return bounded.at(column)[n]; };
    EXPECT_LE(at("svf_total_low") - error_of_samples(), exact.at("svf_total")[n]) << n;
    EXPECT_GE(at("svf_total_high") + error_of_samples(), exact.at("svf_total")[n]) << n;
    EXPECT_LE(at("svf_total_low"), at("svf_total"));
    EXPECT_LE(at("svf_total"), at("svf_total_high"));
    width += at("svf_total_high") - at("svf_total_low");
  }
  width /= static_cast<double>(exact.at("svf_total").size());
  testing::Test::RecordProperty("mean_width", std::to_string(width));
  return width;
}

TEST_P(Canopies, LieWithinTheirBounds) {
  const PackageReader package = town_with_trees();
  EXPECT_LE(width_of_bounds(package, settings(Engine::automatic), receivers(package)), 0.01);
}

TEST_P(Canopies, KeepAnErrorThatIsAllowed) {
  constexpr double allowed = 0.005, of_samples = 0.75 * allowed, of_far = allowed - of_samples;
  const PackageReader package = town_with_trees();
  const std::vector<CellReceivers> places = receivers(package);
  const Columns exact = columns_of_receivers(package, settings(Engine::exact, many_rays), places);
  SkySettings with_error = settings(Engine::automatic, rays_for_sampling_error(of_samples));
  with_error.azimuths = azimuths_for_error(of_samples);
  with_error.allowed_error = of_far;
  with_error.further.svf_total_bounds = true;
  const Columns kept = columns_of_receivers(package, with_error, places);
  const ErrorSummary errors = summarize_errors(kept.at("svf_total"), exact.at("svf_total"));
  RecordProperty("max_error", std::to_string(errors.max_abs_error));
  EXPECT_LE(errors.max_abs_error, allowed);
  for (std::size_t n = 0; n < places.size() && n < kept.at("svf").size(); ++n) {
    EXPECT_LE(kept.at("svf_total_high")[n] - kept.at("svf_total_low")[n], 2.0 * of_far + 1e-6) << n;
    EXPECT_LE(kept.at("svf_total")[n], kept.at("svf")[n]);
  }
}

class CanopiesOfRealCities : public testing::TestWithParam<const char*> {};

TEST_P(CanopiesOfRealCities, OfHorizonsAreThoseOfRays) {
  const std::filesystem::path file = scenes::test_data(GetParam());
  if (!std::filesystem::exists(file)) GTEST_SKIP() << scenes::absence_of(file);
  const scenes::TemporaryFolder folder;
  const PackageReader package = real_city_with_trees(file, folder.path() / "city.farlod");
  const std::vector<CellReceivers> places = in_streets(package);
  const auto by = [&](Engine engine) { return columns_of_receivers(package, {engine, SkyWeight::cosine, 20000}, places); };
  expect_small_errors(by(Engine::automatic), by(Engine::exact), {"svf_total", "svfveg"});
}

TEST_P(CanopiesOfRealCities, LieWithinTheirBounds) {
  const std::filesystem::path file = scenes::test_data(GetParam());
  if (!std::filesystem::exists(file)) GTEST_SKIP() << scenes::absence_of(file);
  const scenes::TemporaryFolder folder;
  const PackageReader package = real_city_with_trees(file, folder.path() / "city.farlod");
  EXPECT_LE(width_of_bounds(package, {}, in_streets(package)), 0.01);
}

INSTANTIATE_TEST_SUITE_P(Cities, CanopiesOfRealCities, testing::Values("rotterdam/delfshaven.city.json", "omiya/omiya.geojson"),
                         [](const auto& city) { return city.index == 0 ? "Rotterdam" : "Omiya"; });

}  // namespace
}  // namespace farlod
