// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "validation/city_study.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <span>

#include "tests/scenes/surface_count.hpp"
#include "validation/site_package.hpp"

namespace farlod::validation {
namespace {

/// The paper's own cells and neighborhood: what the requirements are about.
bool is_required(double cell_edge_m, int neighborhood) {
  return (cell_edge_m == 50.0 || cell_edge_m == 100.0) && neighborhood == 3;
}

/// Exact answers of all sites.
struct Reference {
  std::vector<double> ground, roofs, facades;
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
  [[nodiscard]] static SkyFigures figures(const SitePackage& package, Engine engine, std::size_t rays,
                                          std::span<const Site> sites) {
    return sky_at(package.package(), {engine, SkyWeight::cosine, rays, std::nullopt}, sites);
  }

  [[nodiscard]] FarFieldErrors errors(const SitePackage& box, const SitePackage& horizon, std::span<const Site> sites,
                                      std::span<const double> exact_of_all) const {
    const std::span<const double> exact = exact_of_all.first(sites.size());
    const std::size_t rays = extent_.reference_rays;
    const SkyFigures ours = figures(horizon, Engine::rays, rays, sites);
    return {summarize_errors(figures(box, Engine::near_only, rays, sites).svf, exact),
            summarize_errors(figures(box, Engine::rays, rays, sites).svf, exact), summarize_errors(ours.svf, exact),
            summarize_bounds(ours, exact, rays)};
  }

  [[nodiscard]] std::vector<RaysErrors> errors_of_fewer_rays(const SitePackage& horizon, std::span<const Site> ground) const {
    std::vector<RaysErrors> result;
    for (const std::size_t rays : {std::size_t{1000}, std::size_t{4000}})
      result.push_back({rays, summarize_errors(figures(horizon, Engine::rays, rays, ground).svf,
                                               std::span(exact_.ground).first(ground.size()))});
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
  const auto ask = [&](std::span<const Site> some) { return sky_at(nothing_baked.package(), exact, some).svf; };
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
