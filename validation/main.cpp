// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "validation/report.hpp"

// Prints the tables behind docs/validation.md. scripts/validate runs it.

namespace farlod::validation {
namespace {

/// The generated one and two real ones.
constexpr std::size_t city_count = 3;

struct Options {
  bool quick = false;
  std::filesystem::path data;
};

std::vector<StudiedCity> cities_of(const Options& options, const Extent& extent) {
  std::vector<StudiedCity> cities;
  cities.push_back(generated_city(extent.generated_size_m));
  const auto add = [&](const std::string& name, const std::string& height_field) {
    const std::filesystem::path file = options.data / name / (name + ".geojson");
    if (std::filesystem::exists(file)) cities.push_back(footprint_city(name, file, height_field));
  };
  add("omiya", "TAKASA");
  add("manhattan", "height");
  return cities;
}

/// Models of other kinds than prisms.
std::vector<CityStudy> study_models(const Options& options, const Extent& of_city) {
  const Extent extent = extent_of_model(of_city);
  std::vector<StudiedCity> models = generated_models(extent.generated_size_m);
  const auto add = [&](const std::string& name, const std::string& file) {
    if (std::filesystem::exists(options.data / file)) models.push_back(building_city(name, options.data / file));
  };
  add("rotterdam", "rotterdam/delfshaven.city.json");
  add("tokyo", "tokyo/53392633_bldg_6697_2_op.gml");
  add("nrw", "nrw/LoD2_32_280_5657_1_NW.gml");
  add("berlin", "trees/berlin_lidar/lod2_buildings_berlin_test_area.gml");
  add("zurich", "zurich/zurich_subset.city.json");
  std::vector<CityStudy> studies;
  for (const StudiedCity& city : models) studies.push_back(study_far_field(city, choose_sites(city, extent), extent));
  return studies;
}

CityResults study(const StudiedCity& city, const Extent& extent) {
  const StudySites sites = choose_sites(city, extent);
  return {study_far_field(city, sites, extent), study_sampling(city, sites, extent), study_alignment(city, extent)};
}

int run(const Options& options) {
  const Extent extent = options.quick ? quick_extent() : Extent();
  const std::vector<StudiedCity> cities = cities_of(options, extent);
  Results results{extent, {}, study_models(options, extent), cities.size() < city_count, cities.front().name, {}};
  for (const StudiedCity& city : cities) results.cities.push_back(study(city, extent));
  results.settings = study_settings(cities.front(), extent);
  std::fputs(markdown(results).c_str(), stdout);
  return 0;
}

}  // namespace
}  // namespace farlod::validation

// Only a mistake in the description of the options is not caught. NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  CLI::App app("farlod-validate — measures errors of sky view factors, for docs/validation.md", "farlod-validate");
  farlod::validation::Options options;
  app.add_flag("--quick", options.quick, "A small city and few receivers");
  app.add_option("--data", options.data, "Folder of the real cities; those that are absent are left out");
  CLI11_PARSE(app, argc, argv);
  try {
    return farlod::validation::run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "farlod-validate: %s\n", error.what());
    return 1;
  }
}
