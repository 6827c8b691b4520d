// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "validation/alignment_study.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "validation/site_package.hpp"

namespace farlod::validation {
namespace {

constexpr double turned_cell_edge_m = 50.0;
constexpr int turned_neighborhood = 3;
/// Four blocks meet in the middle of the city. However the grid is turned or moved, receivers within this circle are in them.
constexpr int turned_block_edge = 8;
constexpr double circle_m = 370.0;

std::vector<Cell> cells_of_circle(const Grid& grid) {
  std::vector<Cell> cells;
  for (const Cell cell : all_cells(grid)) {
    const Block block = grid.block_of(cell);
    if (block.i >= -1 && block.i <= 0 && block.j >= -1 && block.j <= 0) cells.push_back(cell);
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

struct CircleSites {
  std::vector<Site> sites;
  std::vector<double> exact;
};

CircleSites sites_in_circle(const StudiedCity& city, const Extent& extent) {
  const CutCity pieces = cut(city, city.streets, turned_cell_edge_m, turned_block_edge);
  const SitePackage nothing_baked = without_far_maps(pieces);
  CircleSites middle{ground_sites(nothing_baked.package(), cells_of_circle(pieces.grid), extent.fewer_receivers), {}};
  std::erase_if(middle.sites, [](const Site& s) { return norm(horizontal(s.p_city)) > circle_m; });
  middle.exact =
      sky_at(nothing_baked.package(), {Engine::exact, SkyWeight::cosine, extent.reference_rays, std::nullopt}, middle.sites).svf;
  return middle;
}

struct Turned {
  TurnedRow row;
  SkyFigures figures;  ///< of the kind `horizon`
};

Turned study_turn(const StudiedCity& city, const CircleSites& middle, double turn_deg, std::size_t rays) {
  tell(city.name + ": grid turned by " + std::to_string(static_cast<int>(turn_deg)) + " degrees");
  const CutCity pieces = cut(city, city.streets + Angle::degrees(turn_deg), turned_cell_edge_m, turned_block_edge);
  const std::vector<Cell> cells = cells_of_circle(pieces.grid);
  const SitePackage box(pieces, turned_neighborhood, of_kind(FarMapKind::box), cells);
  const SitePackage horizon(pieces, turned_neighborhood, of_kind(FarMapKind::horizon), cells);
  const SkySettings settings{Engine::rays, SkyWeight::cosine, rays, std::nullopt};
  SkyFigures ours = sky_at(horizon.package(), settings, middle.sites);
  const std::vector<double> papers = sky_at(box.package(), settings, middle.sites).svf;
  return {{turn_deg, summarize_errors(papers, middle.exact), summarize_errors(ours.svf, middle.exact), box.bytes_a_cell(),
           horizon.bytes_a_cell(), horizon.bake_ms_a_cell()},
          std::move(ours)};
}

/// The same city, somewhere else under the grid.
SkyFigures figures_of_moved(const StudiedCity& city, const CircleSites& middle, double move_m, std::size_t rays) {
  tell(city.name + ": grid moved");
  StudiedCity moved = city;
  for (Point3d& p : moved.city.points()) p = p + Point3d{move_m, move_m, 0.0};
  std::vector<Site> sites = middle.sites;
  for (Site& site : sites) site.p_city = site.p_city + Point3d{move_m, move_m, 0.0};
  const CutCity pieces = cut(moved, moved.streets, turned_cell_edge_m, turned_block_edge);
  const SitePackage horizon(pieces, turned_neighborhood, {}, cells_of(pieces.grid, sites));
  return sky_at(horizon.package(), {Engine::rays, SkyWeight::cosine, rays, std::nullopt}, sites);
}

MovedGrid compare(const SkyFigures& a, const SkyFigures& b, std::size_t rays) {
  const auto stated = [](const SkyFigures& f, std::size_t n) { return std::max(f.high[n] - f.svf[n], f.svf[n] - f.low[n]); };
  MovedGrid moved;
  for (std::size_t n = 0; n < a.svf.size(); ++n) {
    const double change = std::abs(a.svf[n] - b.svf[n]), allowed = stated(a, n) + stated(b, n);
    moved.mean_change += change / static_cast<double>(a.svf.size());
    moved.max_change = std::max(moved.max_change, change);
    moved.max_stated = std::max(moved.max_stated, allowed);
    // Coordinates are rounded elsewhere: a ray that grazes an edge may go either way
    if (change > allowed + 2.5 / static_cast<double>(rays)) ++moved.beyond;
  }
  return moved;
}

}  // namespace

AlignmentStudy study_alignment(const StudiedCity& city, const Extent& extent) {
  const CircleSites middle = sites_in_circle(city, extent);
  const std::size_t rays = extent.reference_rays;
  std::vector<Turned> turned;
  for (const double turn_deg : {0.0, 10.0, 20.0, 30.0, 45.0}) turned.push_back(study_turn(city, middle, turn_deg, rays));
  AlignmentStudy study;
  for (const Turned& t : turned) study.turned.push_back(t.row);
  const SkyFigures moved = figures_of_moved(city, middle, turned_cell_edge_m / 3.0, rays);
  study.by_a_third_of_a_cell = compare(turned[0].figures, moved, rays);
  study.turned_by_10_deg = compare(turned[0].figures, turned[1].figures, rays);
  return study;
}

}  // namespace farlod::validation
