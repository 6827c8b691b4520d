// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "validation/city_study.hpp"

#include <fmt/core.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <random>

#include "tests/scenes/surface_count.hpp"

namespace farlod::validation {
namespace {

/// Dense enough that most surfaces have a choice of places.
constexpr double surface_spacing_m = 6.0;
constexpr float head_m = 1.5F;

Site site_of(const PackageReader& package, Cell cell, const Point3f& p_cell, const Point3f& normal_grid) {
  const Grid& grid = package.grid();
  const Point2d corner = grid.corner_of(cell);
  const Point3d p_grid{corner.x + p_cell.x, corner.y + p_cell.y, p_cell.z + package.manifest().height_origin_m};
  return {grid.rotation.city_from_grid(p_grid),
          grid.rotation.city_from_grid(Point3d{normal_grid.x, normal_grid.y, normal_grid.z})};
}

Receiver receiver_of(const PackageReader& package, Cell cell, const Site& site, std::size_t index) {
  const Grid& grid = package.grid();
  const Point3d p = grid.rotation.grid_from_city(site.p_city), n = grid.rotation.grid_from_city(site.normal_city);
  const Point2d corner = grid.corner_of(cell);
  return {index,
          {static_cast<float>(p.x - corner.x), static_cast<float>(p.y - corner.y),
           static_cast<float>(p.z - package.manifest().height_origin_m)},
          {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)}};
}

Cell cell_of(const Grid& grid, const Site& site) { return grid.cell_of(grid.rotation.grid_from_city(horizontal(site.p_city))); }

std::vector<CellReceivers> receivers_of(const PackageReader& package, std::span<const Site> sites) {
  std::map<Cell, std::vector<Receiver>> by_cell;
  for (std::size_t n = 0; n < sites.size(); ++n) {
    const Cell cell = cell_of(package.grid(), sites[n]);
    by_cell[cell].push_back(receiver_of(package, cell, sites[n], n));
  }
  std::vector<CellReceivers> result;
  for (auto& [cell, receivers] : by_cell) result.push_back({cell, std::move(receivers)});
  return result;
}

void evaluate(const PackageReader& package, const SkySettings& settings, std::span<const Site> sites, const SkyAnswers& answers) {
  const SkyEvaluator evaluator(package, settings);
  const std::vector<CellReceivers> receivers = receivers_of(package, sites);
  oneapi::tbb::parallel_for(std::size_t{0}, receivers.size(), [&](std::size_t n) { evaluator.evaluate(receivers[n], answers); });
}

BoundedSky bounded_sky(const PackageReader& package, const SkySettings& settings, std::span<const Site> sites) {
  std::vector<float> svf(sites.size()), low(svf), high(svf);
  evaluate(package, settings, sites, SkyAnswers(svf, low, high));
  return {{svf.begin(), svf.end()}, {low.begin(), low.end()}, {high.begin(), high.end()}};
}

}  // namespace

std::vector<Site> ground_sites(const PackageReader& package, std::span<const Cell> cells, std::size_t count) {
  std::mt19937_64 random(20120901);
  const auto uniform = [&random](double end) { return end * static_cast<double>(random() >> 11) * 0x1p-53; };
  std::map<Cell, PointLocator> columns;
  std::vector<Site> sites;
  while (sites.size() < count) {
    const Cell cell = cells[static_cast<std::size_t>(uniform(static_cast<double>(cells.size())))];
    const double edge_m = package.grid().cell_edge_m;
    const auto x = static_cast<float>(uniform(edge_m)), y = static_cast<float>(uniform(edge_m));
    const PointLocator& here = columns.try_emplace(cell, package, cell).first->second;
    const auto p_cell = stand(here, x, y, HeightAbove::ground, head_m);
    if (p_cell) sites.push_back(site_of(package, cell, *p_cell, {0.0F, 0.0F, 1.0F}));
  }
  return sites;
}

std::vector<Site> surface_sites(const PackageReader& package, std::span<const Cell> cells, SurfaceChoice choice,
                                std::size_t count) {
  std::vector<std::vector<Site>> by_cell(cells.size());
  oneapi::tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t n) {
    for (const SurfaceReceiver& r : surface_receivers(package, cells[n], choice, surface_spacing_m))
      if (!r.is_inside_building) by_cell[n].push_back(site_of(package, cells[n], r.p_cell, r.normal));
  });
  std::vector<Site> all, chosen;
  for (const std::vector<Site>& some : by_cell) all.insert(all.end(), some.begin(), some.end());
  for (const std::size_t n : choose_some(all.size(), count)) chosen.push_back(all[n]);
  return chosen;
}

std::vector<Cell> all_cells(const Grid& grid) {
  std::vector<Cell> cells;
  for (std::size_t n = 0; n < static_cast<std::size_t>(grid.cells.size()); ++n) cells.push_back(grid.cells.cell_at(n));
  return cells;
}

std::vector<Cell> cells_of(const Grid& grid, std::span<const Site> sites) {
  std::vector<Cell> cells;
  for (const Site& site : sites) cells.push_back(cell_of(grid, site));
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

std::vector<double> sky_at(const PackageReader& package, const SkySettings& settings, std::span<const Site> sites) {
  std::vector<float> svf(sites.size());
  evaluate(package, settings, sites, SkyAnswers(svf));
  return {svf.begin(), svf.end()};
}

BoundedSky bounds_at(const PackageReader& package, std::span<const Site> sites) { return bounded_sky(package, {}, sites); }

std::vector<double> true_sky_at(const PackageReader& package, std::span<const Site> sites) {
  return bounded_sky(package, {.engine = Engine::exact}, sites).svf;
}

BoundsSummary summarize_bounds(const BoundedSky& bounds, std::span<const double> truth) {
  // Of the true value, and of the floats that bounds are
  constexpr double rounding = 2e-5;
  BoundsSummary summary;
  for (std::size_t n = 0; n < truth.size(); ++n) {
    const double width = bounds.high[n] - bounds.low[n];
    summary.mean_width += width / static_cast<double>(truth.size());
    summary.max_width = std::max(summary.max_width, width);
    if (truth[n] < bounds.low[n] - rounding || truth[n] > bounds.high[n] + rounding) ++summary.outside;
  }
  return summary;
}

namespace {

/// The paper's own cells and neighborhood: what the requirements are about.
bool is_required(double cell_edge_m, int neighborhood) {
  return (cell_edge_m == 50.0 || cell_edge_m == 100.0) && neighborhood == 3;
}

/// What all sites of a kind see: by the rays of the reference, and truly.
struct SeenSky {
  std::vector<double> by_rays, truly;
};
struct Reference {
  SeenSky ground, roofs, facades;
};

/// Studies one city with one cell edge.
class CellEdgeStudy {
 public:
  CellEdgeStudy(const CutCity& cut, const StudySites& sites, const Reference& exact, const Extent& extent)
      : cut_(cut), sites_(sites), exact_(exact), extent_(extent) {}

  [[nodiscard]] FarFieldRow run(int neighborhood) const {
    const double cell_edge_m = cut_.grid.cell_edge_m;
    const bool required = is_required(cell_edge_m, neighborhood), whole = required && cell_edge_m == 50.0;
    const std::span<const Site> ground = std::span(sites_.ground).first(required ? extent_.receivers : extent_.fewer_receivers);
    const scenes::ChosenCells only = whole ? std::nullopt : scenes::ChosenCells(cells_of(cut_.grid, ground));
    const SitePackage box(cut_, neighborhood, of_kind(FarMapKind::box), only);
    const SitePackage horizon(cut_, neighborhood, of_kind(FarMapKind::horizon), only);
    FarFieldRow row{cell_edge_m, neighborhood, errors(box, horizon, ground, exact_.ground), {}, {}, {}, 0.0, 0.0};
    if (required) row.ground_rays = errors_of_fewer_rays(horizon, ground);
    if (whole) {
      row.roofs = errors(box, horizon, sites_.roofs, exact_.roofs);
      row.facades = errors(box, horizon, sites_.facades, exact_.facades);
      row.box_bytes_a_cell = box.bytes_a_cell();
      row.bytes_a_cell = horizon.bytes_a_cell();
    }
    return row;
  }

 private:
  [[nodiscard]] static std::vector<double> sky(const SitePackage& package, Engine engine, std::size_t rays,
                                               std::span<const Site> sites) {
    return sky_at(package.package(), {engine, SkyWeight::cosine, rays, std::nullopt}, sites);
  }

  [[nodiscard]] FarFieldErrors errors(const SitePackage& box, const SitePackage& horizon, std::span<const Site> sites,
                                      const SeenSky& of_all) const {
    const std::span<const double> exact = std::span(of_all.by_rays).first(sites.size());
    const std::size_t rays = extent_.reference_rays;
    return {summarize_errors(sky(box, Engine::near_only, rays, sites), exact),
            summarize_errors(sky(box, Engine::rays, rays, sites), exact),
            summarize_errors(sky(horizon, Engine::rays, rays, sites), exact),
            summarize_bounds(bounds_at(horizon.package(), sites), std::span(of_all.truly).first(sites.size()))};
  }

  [[nodiscard]] std::vector<RaysErrors> errors_of_fewer_rays(const SitePackage& horizon, std::span<const Site> ground) const {
    std::vector<RaysErrors> result;
    for (const std::size_t rays : {std::size_t{1000}, std::size_t{4000}})
      result.push_back({rays, summarize_errors(sky(horizon, Engine::rays, rays, ground),
                                               std::span(exact_.ground.by_rays).first(ground.size()))});
    return result;
  }

  const CutCity& cut_;
  const StudySites& sites_;
  const Reference& exact_;
  const Extent& extent_;
};

Reference exact_answers(const CutCity& cut, const StudySites& sites, const Extent& extent) {
  const SitePackage nothing_baked = without_far_maps(cut);
  const SkySettings exact{Engine::exact, SkyWeight::cosine, extent.reference_rays, std::nullopt};
  const auto ask = [&](std::span<const Site> some) {
    return SeenSky{sky_at(nothing_baked.package(), exact, some), true_sky_at(nothing_baked.package(), some)};
  };
  return {ask(sites.ground), ask(sites.roofs), ask(sites.facades)};
}

std::string progress_text(const std::string& city, const FarFieldRow& row) {
  const auto errors = [](const ErrorSummary& e) { return fmt::format("{:.5f} (max {:.4f})", e.mean_abs_error, e.max_abs_error); };
  return fmt::format("{}: c = {:g} m, N = {}: dropped {}, box {}, horizon {}", city, row.cell_edge_m, row.neighborhood,
                     errors(row.ground.dropped), errors(row.ground.box), errors(row.ground.horizon));
}

}  // namespace

Extent quick_extent() {
  Extent extent;
  extent.generated_size_m = 600.0;
  extent.cell_edges_m = {50.0, 100.0};
  extent.neighborhoods = {1, 3};
  extent.receivers = 300;
  extent.fewer_receivers = 100;
  extent.surface_receivers = 100;
  extent.reference_rays = 5000;
  extent.sampling_reference_rays = 20000;
  extent.sampling_rays = {250, 1000, 4000};
  return extent;
}

Extent extent_of_model(const Extent& extent) {
  Extent less = extent;
  less.generated_size_m = std::min(extent.generated_size_m, 600.0);
  less.cell_edges_m = {50.0};
  less.neighborhoods = {3};
  less.receivers = less.fewer_receivers;
  less.surface_receivers = less.fewer_receivers;
  return less;
}

void tell(const std::string& what) { std::fprintf(stderr, "%s\n", what.c_str()); }

StudySites choose_sites(const StudiedCity& city, const Extent& extent) {
  const CutCity pieces = cut(city, city.streets, 50.0);
  const SitePackage nothing_baked = without_far_maps(pieces);
  const PackageReader& package = nothing_baked.package();
  const std::vector<Cell> cells = all_cells(package.grid());
  return {ground_sites(package, cells, extent.receivers),
          surface_sites(package, cells, SurfaceChoice::roofs, extent.surface_receivers),
          surface_sites(package, cells, SurfaceChoice::walls, extent.surface_receivers)};
}

CityStudy study_far_field(const StudiedCity& city, const StudySites& sites, const Extent& extent) {
  CityStudy study{city.name, city.city.buildings().size(), surface_count(city.city), {}};
  std::optional<Reference> exact;
  for (const double cell_edge_m : extent.cell_edges_m) {
    const CutCity pieces = cut(city, city.streets, cell_edge_m);
    if (!exact) exact = exact_answers(pieces, sites, extent);
    const CellEdgeStudy of_edge(pieces, sites, *exact, extent);
    for (const int neighborhood : extent.neighborhoods) {
      study.rows.push_back(of_edge.run(neighborhood));
      tell(progress_text(city.name, study.rows.back()));
    }
  }
  return study;
}

}  // namespace farlod::validation
