// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "validation/error_shares.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <span>

#include "validation/studied_city.hpp"

namespace farlod::validation {
namespace {

constexpr double cell_edge_m = 50.0;
constexpr int neighborhood = 3;
/// A block around the middle of the city is baked whole, for what its cells share.
constexpr int block_edge = 16;

std::string text_of(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", value);
  return text.data();
}

struct Variation {
  std::string setting, value;
  FarMapSettings far_map;
};

template <class Setting, class Values>
void vary(std::vector<Variation>& variations, const std::string& name, Setting HorizonMapSettings::*setting,
          const Values& values) {
  for (const auto value : values) {
    Variation v{name, text_of(static_cast<double>(value)), {}};
    v.far_map.horizon.*setting = static_cast<Setting>(value);
    variations.push_back(v);
  }
}

std::vector<Variation> all_variations() {
  std::vector<Variation> variations;
  vary(variations, "azimuth_bins", &HorizonMapSettings::azimuth_bins, std::array{64, 128, 256, 512});
  vary(variations, "squares_per_edge", &HorizonMapSettings::squares_per_edge, std::array{1, 2, 4});
  vary(variations, "layers", &HorizonMapSettings::layers, std::array{3, 5, 8});
  vary(variations, "tolerance", &HorizonMapSettings::tolerance, std::array{0.02, 0.05, 0.1, 0.2});
  return variations;
}

bool is_default(const HorizonMapSettings& s) {
  const HorizonMapSettings d;
  return s.azimuth_bins == d.azimuth_bins && s.squares_per_edge == d.squares_per_edge && s.layers == d.layers &&
         s.tolerance == d.tolerance;
}

std::vector<Cell> middle_cells(const Grid& grid) {
  std::vector<Cell> cells;
  for (const Cell cell : all_cells(grid))
    if (grid.block_of(cell) == Block{0, 0}) cells.push_back(cell);
  std::sort(cells.begin(), cells.end());
  return cells;
}

struct MiddleSites {
  std::vector<Site> ground, facades;
  std::vector<double> exact_ground, exact_facades, true_ground;
};

MiddleSites middle_sites(const CutCity& pieces, std::span<const Cell> cells, const Extent& extent) {
  const SitePackage nothing_baked = without_far_maps(pieces);
  const SkySettings exact{Engine::exact, SkyWeight::cosine, extent.reference_rays, std::nullopt};
  const PackageReader& package = nothing_baked.package();
  MiddleSites sites{ground_sites(package, cells, extent.fewer_receivers),
                    surface_sites(package, cells, SurfaceChoice::walls, extent.fewer_receivers),
                    {},
                    {},
                    {}};
  sites.exact_ground = sky_at(package, exact, sites.ground);
  sites.exact_facades = sky_at(package, exact, sites.facades);
  sites.true_ground = true_sky_at(package, sites.ground);
  return sites;
}

SettingRow measure(const Variation& variation, const SitePackage& baked, const MiddleSites& sites, std::size_t rays) {
  const SkySettings ours{Engine::rays, SkyWeight::cosine, rays, std::nullopt};
  return {variation.setting,
          variation.value,
          is_default(variation.far_map.horizon),
          summarize_errors(sky_at(baked.package(), ours, sites.ground), sites.exact_ground),
          summarize_errors(sky_at(baked.package(), ours, sites.facades), sites.exact_facades),
          summarize_bounds(bounds_at(baked.package(), sites.ground), sites.true_ground),
          baked.bytes_a_cell(),
          baked.bake_ms_a_cell()};
}

/// Asks for so many rays, on the ground, on roofs and on façades.
std::array<std::vector<double>, 3> ask(const PackageReader& package, SkyWeight weight, std::size_t rays,
                                       const StudySites& sites) {
  const SkySettings exact{Engine::exact, weight, rays, std::nullopt};
  const std::size_t ground_count = std::min(sites.ground.size(), sites.roofs.size());
  return {sky_at(package, exact, std::span(sites.ground).first(ground_count)), sky_at(package, exact, sites.roofs),
          sky_at(package, exact, sites.facades)};
}

}  // namespace

std::vector<SamplingRow> study_sampling(const StudiedCity& city, const StudySites& sites, const Extent& extent) {
  tell(city.name + ": sampling of the sky");
  const CutCity pieces = cut(city, city.streets, cell_edge_m);
  const SitePackage nothing_baked = without_far_maps(pieces);
  const auto answers = [&](SkyWeight weight, std::size_t rays) { return ask(nothing_baked.package(), weight, rays, sites); };
  const auto truth = answers(SkyWeight::cosine, extent.sampling_reference_rays);
  const auto truth_solid = answers(SkyWeight::solid_angle, extent.sampling_reference_rays);
  std::vector<SamplingRow> rows;
  for (const std::size_t rays : extent.sampling_rays) {
    const auto cosine = answers(SkyWeight::cosine, rays), solid = answers(SkyWeight::solid_angle, rays);
    rows.push_back({rays, summarize_errors(cosine[0], truth[0]), summarize_errors(cosine[1], truth[1]),
                    summarize_errors(cosine[2], truth[2]), summarize_errors(solid[0], truth_solid[0]),
                    summarize_errors(solid[1], truth_solid[1]), summarize_errors(solid[2], truth_solid[2])});
  }
  return rows;
}

double sampling_constant(const std::vector<SamplingRow>& rows) {
  double constant = 0.0;
  for (const SamplingRow& row : rows)
    for (const ErrorSummary* e : row.all())
      constant = std::max(constant, e->max_abs_error * std::pow(static_cast<double>(row.rays), 0.75));
  return constant;
}

std::vector<SettingRow> study_settings(const StudiedCity& city, const Extent& extent) {
  const CutCity pieces = cut(city, city.streets, cell_edge_m, block_edge);
  const std::vector<Cell> cells = middle_cells(pieces.grid);
  const MiddleSites sites = middle_sites(pieces, cells, extent);
  std::vector<SettingRow> rows;
  std::optional<SettingRow> of_defaults;
  for (const Variation& variation : all_variations()) {
    tell(city.name + ": " + variation.setting + " = " + variation.value);
    if (is_default(variation.far_map.horizon) && of_defaults) {
      rows.push_back(*of_defaults);
      rows.back().setting = variation.setting;
      rows.back().value = variation.value;
      continue;
    }
    const SitePackage baked(pieces, neighborhood, variation.far_map, cells);
    rows.push_back(measure(variation, baked, sites, extent.reference_rays));
    if (rows.back().is_default) of_defaults = rows.back();
  }
  return rows;
}

}  // namespace farlod::validation
