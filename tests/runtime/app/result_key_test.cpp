// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/result_key.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "tests/scenes/temporary_folder.hpp"

// Kept answers are taken again where the key is the same. So each setting either changes the key or changes no value.

namespace farlod {
namespace {

struct Change {
  std::string name;
  std::function<void(SvfOptions&)> make;
};

/// The members of each kind of settings are bound here one by one: a new one does not compile until somebody has said below
/// whether it changes values.
[[maybe_unused]] void all_members_are_known(SvfOptions& o) {
  [[maybe_unused]] auto& [package, output, format, preview_format, verify_format, source, grid_step_m, grid_like, own_pixels,
                          points_file, points_crs, points_layer, surfaces, city_file, matrix_file, matrix, energyplus_file, at,
                          placing, bbox, mask, evaluation, sunshine, names_quantities, drawn_quantity, light_request, preview,
                          verify_file, histogram, projection, memory_limit, resume, merge, shard, run] = o;
  [[maybe_unused]] auto& [choice, spacing_m, irradiation_threshold] = surfaces;
  [[maybe_unused]] auto& [threshold] = matrix;
  [[maybe_unused]] auto& [above, height_m] = placing;
  [[maybe_unused]] auto& [engine, weight, directions, azimuths, rays, max_error, bounds, verify, dry_run, region, within_m,
                          further] = evaluation;
  [[maybe_unused]] auto& [svf_solid, directional, hidden, horizons, distances, sky_patches, sun, sunlit_total, light, irradiation,
                          irradiance, illuminance, shade, sky_component, view_factors, view_factors_below, view_cube, view_sphere,
                          view_eye, eye_field, wall_sectors, seen_building, svf_total, svf_total_bounds, svfaveg,
                          directional_vegetation, sky_shares, canopy, shadow_patches] = further;
  [[maybe_unused]] auto& [rule, season, transmissivity, extinction] = canopy;
  [[maybe_unused]] auto& [first, days, step] = *sunshine;
  // The intervals follow from the request, the package and the file
  [[maybe_unused]] auto& [intervals, sky_model, ground_albedo, facade_albedo, by_month, by_step] = *light;
  [[maybe_unused]] auto& [weather_file, period, light_step, linke_turbidity] = *light_request;
}

class ResultKey : public testing::Test {
 protected:
  ResultKey() {
    for (const char* name : {"a.csv", "b.csv", "a.geojson", "b.geojson", "a.tif", "b.tif"})
      std::ofstream(folder.file(name)) << name;
  }

  [[nodiscard]] AnswerKey changed(const SvfOptions& before, const Change& change) const {
    SvfOptions after = before;
    change.make(after);
    return key_of_answers(after, package);
  }
  void expect_each_to_change(const SvfOptions& before, const std::vector<Change>& changes) const {
    std::vector<AnswerKey> seen{key_of_answers(before, package)};
    for (const Change& change : changes) {
      seen.push_back(changed(before, change));
      for (std::size_t n = 0; n + 1 < seen.size(); ++n) EXPECT_NE(seen[n], seen.back()) << change.name << " and change " << n;
    }
  }

  scenes::TemporaryFolder folder;
  PackageDescription package;
};

SvfOptions raster() {
  SvfOptions o;
  o.package = "town.farlod";
  o.grid_step_m = 2.0;
  return o;
}

TEST_F(ResultKey, HasEachReceiver) {
  const SvfOptions grid = raster();
  expect_each_to_change(
      grid, {{"--grid", [](SvfOptions& o) { o.grid_step_m = 1.0; }},
             {"no --grid", [](SvfOptions& o) { o.own_pixels = true; }},
             {"--grid-like", [&](SvfOptions& o) { o.grid_like = folder.file("a.tif"); }},
             {"--grid-like of other contents", [&](SvfOptions& o) { o.grid_like = folder.file("b.tif"); }},
             {"--height", [](SvfOptions& o) { o.placing.height_m = 2.0; }},
             {"--on-surface", [](SvfOptions& o) { o.placing.above = HeightAbove::highest_surface; }},
             {"--bbox",
              [](SvfOptions& o) {
                o.bbox_projected = Box2d{{0, 0}, {1, 1}};
              }},
             {"--mask", [&](SvfOptions& o) { o.mask_file = folder.file("a.geojson"); }},
             {"--within", [](SvfOptions& o) { o.evaluation.within_m = 3.0; }},
             {"--mask of other contents", [&](SvfOptions& o) { o.mask_file = folder.file("b.geojson"); }},
             {"--surfaces", [](SvfOptions& o) { o.source = ReceiverSource::surfaces; }},
             {"--along", [&](SvfOptions& o) { o.source = ReceiverSource::lines, o.points_file = folder.file("a.geojson"); }},
             {"--points", [&](SvfOptions& o) { o.source = ReceiverSource::points, o.points_file = folder.file("a.csv"); }}});
  SvfOptions points = raster();
  points.source = ReceiverSource::points;
  points.points_file = folder.file("a.csv");
  expect_each_to_change(points, {{"--points", [&](SvfOptions& o) { o.points_file = folder.file("b.csv"); }},
                                 {"--points-crs", [](SvfOptions& o) { o.points_crs = "EPSG:4326"; }},
                                 {"--points-layer", [](SvfOptions& o) { o.points_layer = "a"; }},
                                 {"--bbox",
                                  [](SvfOptions& o) {
                                    o.bbox_projected = Box2d{{0, 0}, {1, 1}};
                                  }},
                                 {"--height", [](SvfOptions& o) { o.placing.height_m = 2.0; }}});
  SvfOptions surfaces = raster();
  surfaces.source = ReceiverSource::surfaces;
  expect_each_to_change(surfaces, {{"--surfaces", [](SvfOptions& o) { o.surfaces.choice = SurfaceChoice::walls; }},
                                   {"--spacing", [](SvfOptions& o) { o.surfaces.spacing_m = 1.0; }}});
}

TEST_F(ResultKey, HasWhatDecidesErrors) {
  expect_each_to_change(raster(), {{"--engine", [](SvfOptions& o) { o.evaluation.engine = Engine::exact; }},
                                   {"--sky", [](SvfOptions& o) { o.evaluation.weight = SkyWeight::solid_angle; }},
                                   {"--directions", [](SvfOptions& o) { o.evaluation.directions = DirectionSet::fibonacci; }},
                                   {"--azimuths", [](SvfOptions& o) { o.evaluation.azimuths = 100; }},
                                   {"--rays", [](SvfOptions& o) { o.evaluation.rays = 100; }},
                                   {"--max-error", [](SvfOptions& o) { o.evaluation.max_error = 0.01; }},
                                   {"--bounds", [](SvfOptions& o) { o.evaluation.bounds = true; }}});
}

TEST_F(ResultKey, HasEachQuantity) {
  using namespace std::chrono;
  const auto sun = [](sys_days first, std::size_t days, minutes step) {
    return [=](SvfOptions& o) { o.sunshine = SunPeriod{first, days, step}; };
  };
  const auto further = [](auto member) { return [member](SvfOptions& o) { o.evaluation.further.*member = true; }; };
  expect_each_to_change(raster(),
                        {{"svf_solid", further(&Quantities::svf_solid)},
                         {"directional", further(&Quantities::directional)},
                         {"hidden", further(&Quantities::hidden)},
                         {"horizon", [](SvfOptions& o) { o.evaluation.further.horizons = 36; }},
                         {"horizon at more azimuths", [](SvfOptions& o) { o.evaluation.further.horizons = 72; }},
                         {"horizon_distance", further(&Quantities::horizon_distances)},
                         {"145 patches", [](SvfOptions& o) { o.evaluation.further.sky_patches = SkyPatchSet::tregenza; }},
                         {"577 patches", [](SvfOptions& o) { o.evaluation.further.sky_patches = SkyPatchSet::reinhart; }},
                         {"svf_total", further(&Quantities::svf_total)},
                         {"svfaveg", further(&Quantities::svfaveg)},
                         {"directional_vegetation", further(&Quantities::directional_vegetation)},
                         {"shadow_patches", further(&Quantities::shadow_patches)},
                         {"shares", further(&Quantities::sky_shares)},
                         {"irradiation", further(&Quantities::irradiation)},
                         {"irradiance", further(&Quantities::irradiance)},
                         {"shade", further(&Quantities::shade)},
                         {"sky_component", further(&Quantities::sky_component)},
                         {"sunlit_total", further(&Quantities::sunlit_total)},
                         {"view_factors", further(&Quantities::view_factors)},
                         {"view_factors_below", further(&Quantities::view_factors_below)},
                         {"view_cube", further(&Quantities::view_cube)},
                         {"view_sphere", further(&Quantities::view_sphere)},
                         {"view_eye", further(&Quantities::view_eye)},
                         {"view_eye of another field",
                          [](SvfOptions& o) { o.evaluation.further.view_eye = true, o.evaluation.further.eye_field_deg = 45.0; }},
                         {"view_building", [](SvfOptions& o) { o.evaluation.further.seen_building = "a"; }},
                         {"view_building of another", [](SvfOptions& o) { o.evaluation.further.seen_building = "b"; }},
                         {"view_cube by eight sectors",
                          [](SvfOptions& o) { o.evaluation.further.view_cube = true, o.evaluation.further.wall_sectors = 8; }},
                         {"sun of a day", sun(2026y / 6 / 21, 1, 5min)},
                         {"sun of another day", sun(2026y / 1 / 1, 1, 5min)},
                         {"sun of a year", sun(2026y / 1 / 1, 365, 5min)},
                         {"sun in other steps", sun(2026y / 1 / 1, 365, 10min)}});
}

TEST_F(ResultKey, HasTheLightOfAPeriod) {
  SvfOptions lit = raster();
  lit.evaluation.further.irradiation = true;
  lit.evaluation.further.light.emplace();
  lit.light.emplace();
  const auto light = [](auto change) { return [change](SvfOptions& o) { change(*o.evaluation.further.light); }; };
  const auto request = [](auto change) { return [change](SvfOptions& o) { change(*o.light); }; };
  expect_each_to_change(lit,
                        {{"--weather", request([&](LightSource& r) { r.weather_file = folder.file("a.csv"); })},
                         {"--weather of other contents", request([&](LightSource& r) { r.weather_file = folder.file("b.csv"); })},
                         {"--period", request([](LightSource& r) { r.period = "2026-06"; })},
                         {"--step", request([](LightSource& r) { r.step = std::chrono::minutes(10); })},
                         {"--linke", request([](LightSource& r) { r.linke_turbidity = 5.0; })},
                         {"--sky-model", light([](Light& l) { l.sky_model = SkyModel::isotropic; })},
                         {"--albedo of the ground", light([](Light& l) { l.ground_albedo = 0.1; })},
                         {"--albedo of façades", light([](Light& l) { l.facade_albedo = 0.1; })},
                         {"--by month", light([](Light& l) { l.by_month = true; })}});
}

TEST_F(ResultKey, HasWhatCrownsDo) {
  SvfOptions trees = raster();
  trees.evaluation.further.svf_total = true;
  const auto canopy = [](auto change) { return [change](SvfOptions& o) { change(o.evaluation.further.canopy); }; };
  expect_each_to_change(trees, {{"--canopy-rule", canopy([](CanopySettings& c) { c.rule = CanopyRule::each; })},
                                {"--transmissivity", canopy([](CanopySettings& c) { c.transmissivity = 0.1; })},
                                {"--leaf-off", canopy([](CanopySettings& c) { c.season = Season::leaf_off; })},
                                {"beer", canopy([](CanopySettings& c) { c.rule = CanopyRule::beer; })},
                                {"--extinction", canopy([](CanopySettings& c) {
                                   c.rule = CanopyRule::beer;
                                   c.extinction_per_m = 0.1;
                                 })}});
}

TEST_F(ResultKey, HasThePackage) {
  const AnswerKey before = key_of_answers(raster(), package);
  package.manifest_xxh3 += 1;
  EXPECT_NE(key_of_answers(raster(), package), before);
}

TEST_F(ResultKey, HasNothingThatChangesNoValue) {
  for (const Change& change :
       {Change{"-o", [](SvfOptions& o) { o.output = "b.tif"; }},
        Change{"the package's folder", [](SvfOptions& o) { o.package = "elsewhere/town.farlod"; }},
        Change{"--preview", [](SvfOptions& o) { o.preview_file = "b.png"; }},
        Change{"--verify", [](SvfOptions& o) { o.evaluation.verify = 100, o.verify_file = "b.csv"; }},
        Change{"--irradiation-threshold", [](SvfOptions& o) { o.surfaces.irradiation_threshold_kwh_m2 = 800.0; }},
        Change{"--histogram", [](SvfOptions& o) { o.histogram_file = "b.csv"; }},
        Change{"--projection", [](SvfOptions& o) { o.projection = SkyProjection::equidistant; }},
        Change{"--memory-limit", [](SvfOptions& o) { o.memory_limit_mib = 100; }},
        Change{"--city", [](SvfOptions& o) { o.city_file = "b.gml"; }},
        Change{"--matrix", [](SvfOptions& o) { o.matrix_file = "b.npz"; }},
        Change{"--matrix-threshold", [](SvfOptions& o) { o.matrix.threshold = 0.5; }},
        Change{"--energyplus", [](SvfOptions& o) { o.energyplus_file = "b.idf"; }},
        Change{"--dry-run", [](SvfOptions& o) { o.evaluation.dry_run = true; }},
        Change{"--resume", [](SvfOptions& o) { o.resume = true; }},
        Change{"--shard",
               [](SvfOptions& o) {
                 o.shard = Shard{0, 2};
               }},
        Change{"--merge", [](SvfOptions& o) { o.merge = true; }},
        Change{"--threads", [](SvfOptions& o) { o.run.threads = 1; }},
        Change{"sectors that nobody asks for", [](SvfOptions& o) { o.evaluation.further.wall_sectors = 8; }},
        Change{"a field that nobody asks for", [](SvfOptions& o) { o.evaluation.further.eye_field_deg = 45.0; }},
        Change{"crowns that nobody asks for", [](SvfOptions& o) { o.evaluation.further.canopy.season = Season::leaf_off; }}})
    EXPECT_EQ(changed(raster(), change), key_of_answers(raster(), package)) << change.name;
}

TEST_F(ResultKey, IsTheCommandLineOfAResult) {
  SvfOptions o = raster();
  o.placing.above = HeightAbove::highest_surface;
  o.evaluation.bounds = true;
  o.evaluation.further.svf_total = true;
  EXPECT_EQ(provenance_of(o, package).settings,
            "--grid 2 --height 1.5 --on-surface --engine auto --sky cosine --bounds --quantity svf,svf_total --canopy-rule umep");
  o.surfaces.irradiation_threshold_kwh_m2 = 800.5;
  EXPECT_TRUE(provenance_of(o, package).settings.ends_with(" --canopy-rule umep --irradiation-threshold 800.5"));
}

}  // namespace
}  // namespace farlod
