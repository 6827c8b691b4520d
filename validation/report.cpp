// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "validation/report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "evaluate/error_budget.hpp"
#include "validation/studied_city.hpp"

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
      sky_at(nothing_baked.package(), {Engine::exact, SkyWeight::cosine, extent.reference_rays, std::nullopt}, middle.sites);
  return middle;
}

struct Turned {
  TurnedRow row;
  BoundedSky ours;
};

Turned study_turn(const StudiedCity& city, const CircleSites& middle, double turn_deg, std::size_t rays) {
  tell(city.name + ": grid turned by " + std::to_string(static_cast<int>(turn_deg)) + " degrees");
  const CutCity pieces = cut(city, city.streets + Angle::degrees(turn_deg), turned_cell_edge_m, turned_block_edge);
  const std::vector<Cell> cells = cells_of_circle(pieces.grid);
  const SitePackage box(pieces, turned_neighborhood, of_kind(FarMapKind::box), cells);
  const SitePackage horizon(pieces, turned_neighborhood, of_kind(FarMapKind::horizon), cells);
  const SkySettings settings{Engine::rays, SkyWeight::cosine, rays, std::nullopt};
  return {{turn_deg, summarize_errors(sky_at(box.package(), settings, middle.sites), middle.exact),
           summarize_errors(sky_at(horizon.package(), settings, middle.sites), middle.exact), box.bytes_a_cell(),
           horizon.bytes_a_cell(), horizon.bake_ms_a_cell()},
          bounds_at(horizon.package(), middle.sites)};
}

/// The same city, somewhere else under the grid.
BoundedSky answers_of_moved(const StudiedCity& city, const CircleSites& middle, double move_m) {
  tell(city.name + ": grid moved");
  StudiedCity moved = city;
  for (Point3d& p : moved.city.points()) p = p + Point3d{move_m, move_m, 0.0};
  std::vector<Site> sites = middle.sites;
  for (Site& site : sites) site.p_city = site.p_city + Point3d{move_m, move_m, 0.0};
  const CutCity pieces = cut(moved, moved.streets, turned_cell_edge_m, turned_block_edge);
  const SitePackage horizon(pieces, turned_neighborhood, {}, cells_of(pieces.grid, sites));
  return bounds_at(horizon.package(), sites);
}

MovedGrid compare(const BoundedSky& a, const BoundedSky& b) {
  const auto stated = [](const BoundedSky& f, std::size_t n) { return std::max(f.high[n] - f.svf[n], f.svf[n] - f.low[n]); };
  MovedGrid moved;
  for (std::size_t n = 0; n < a.svf.size(); ++n) {
    const double change = std::abs(a.svf[n] - b.svf[n]), allowed = stated(a, n) + stated(b, n);
    moved.mean_change += change / static_cast<double>(a.svf.size());
    moved.max_change = std::max(moved.max_change, change);
    moved.max_stated = std::max(moved.max_stated, allowed);
    // Coordinates are rounded elsewhere
    constexpr double rounding = 4e-5;
    if (change > allowed + rounding) ++moved.beyond;
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
  study.by_a_third_of_a_cell = compare(turned[0].ours, answers_of_moved(city, middle, turned_cell_edge_m / 3.0));
  study.turned_by_10_deg = compare(turned[0].ours, turned[1].ours);
  return study;
}

namespace {

std::string cells_of_row(const ErrorSummary& e) {
  return fmt::format("{:.5f} | {:.4f} | {:.4f}", e.mean_abs_error, e.p99_abs_error, e.max_abs_error);
}

std::string intro(const Results& results) {
  std::string text;
  for (const CityResults& city : results.cities)
    text += fmt::format("{}{} ({} buildings, {} polygons)", text.empty() ? "Cities: " : ", ", city.far_field.name,
                        city.far_field.buildings, city.far_field.polygons);
  const Extent& extent = results.extent;
  return text +
         fmt::format(
             ". `generated` is `farlod-city --size {:g} --seed 1 --towers 0.3 --rotation 20 --lod 1`; the others are real. "
             "The grid follows the streets.\n\n"
             "Receivers are random places 1.5 m above the ground: {} with c = 50 and 100 m, N = 3, and {} with other cells and "
             "neighbourhoods. The reference traces {} rays against the whole city. Each kind of far map is evaluated with the "
             "same rays, so that the difference is the error of the far field alone.\n",
             extent.generated_size_m, extent.receivers, extent.fewer_receivers, extent.reference_rays) +
         (results.lacks_real_cities
              ? "\nReal cities are left out here and below: their data was not there (`scripts/validate --data`).\n"
              : "");
}

std::string far_field_table(const CityStudy& study) {
  std::string text = fmt::format(
      "\n### {}\n\n| c, m | N | dropped: mean | 99 % | max | paper's map: mean | 99 % | max | ours: mean | 99 % | max |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n",
      study.name);
  for (const FarFieldRow& row : study.rows)
    text += fmt::format("| {:g} | {} | {} | {} | {} |\n", row.cell_edge_m, row.neighborhood, cells_of_row(row.ground.dropped),
                        cells_of_row(row.ground.box), cells_of_row(row.ground.horizon));
  return text;
}

std::string rays_table(const Results& results) {
  std::string text =
      "\n### What users get\n\nThe same receivers with fewer rays: the error of the sampling comes on top of the error of our "
      "far "
      "maps.\n\n| city | c, m | N | rays | mean | 99 % | max |\n|---|---|---|---|---|---|---|\n";
  for (const CityResults& city : results.cities)
    for (const FarFieldRow& row : city.far_field.rows)
      for (const RaysErrors& of_rays : row.ground_rays)
        text += fmt::format("| {} | {:g} | {} | {} | {} |\n", city.far_field.name, row.cell_edge_m, row.neighborhood,
                            of_rays.rays, cells_of_row(of_rays.horizon));
  return text;
}

std::string surfaces_section(const Results& results) {
  std::string text = fmt::format(
      "\n## Roofs and façades\n\nUp to {} random places each, 1 cm off the surface; c = 50 m, N = 3; {} rays on both sides. The "
      "paper's map is captured 1.5 m above the ground, however high the receiver is.\n\n"
      "| city | receivers on | paper's map: mean | 99 % | max | ours: mean | 99 % | max |\n|---|---|---|---|---|---|---|---|\n",
      results.extent.surface_receivers, results.extent.reference_rays);
  for (const CityResults& city : results.cities)
    for (const FarFieldRow& row : city.far_field.rows)
      for (const auto& [what, errors] : {std::pair("roofs", &row.roofs), std::pair("façades", &row.facades)})
        if (*errors)
          text += fmt::format("| {} | {} | {} | {} |\n", city.far_field.name, what, cells_of_row((*errors)->box),
                              cells_of_row((*errors)->horizon));
  return text;
}

/// Rays through the far map against rays that see the whole city, and whether bounds hold.
std::string models_section(const Results& results) {
  const Extent extent = extent_of_model(results.extent);
  std::string text = fmt::format(
      "\n## Models as they exist\n\nOpen shells, eaves, balconies, projecting floors, hillsides: generated ones are `farlod-city "
      "--size {:g} --seed 9 --lod 2` with the options given (`--hillside` with `--lod 1`); the others are real. Up to {} "
      "receivers each, c = 50 m, N = 3; {} rays on both sides. *Outside* as [below](#certain-bounds).\n\n"
      "| city | buildings | receivers on | dropped: mean | 99 % | max | ours: mean | 99 % | max | mean width of bounds | outside "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|\n",
      extent.generated_size_m, extent.receivers, extent.reference_rays);
  for (const CityStudy& city : results.models)
    for (const FarFieldRow& row : city.rows) {
      const auto add = [&](const char* where, const FarFieldErrors& e) {
        text += fmt::format("| {} | {} | {} | {} | {} | {:.4f} | {} |\n", city.name, city.buildings, where,
                            cells_of_row(e.dropped), cells_of_row(e.horizon), e.bounds.mean_width, e.bounds.outside);
      };
      add("ground", row.ground);
      if (row.roofs) add("roofs", *row.roofs);
      if (row.facades) add("façades", *row.facades);
    }
  return text;
}

std::string bounds_row(const std::string& city, const FarFieldRow& row, const std::string& where, const FarFieldErrors& errors) {
  return fmt::format("| {} | {:g} | {} | {} | {} | {:.4f} | {:.4f} | {} |\n", city, row.cell_edge_m, row.neighborhood, where,
                     errors.horizon.count, errors.bounds.mean_width, errors.bounds.max_width, errors.bounds.outside);
}

std::string bounds_section(const Results& results) {
  std::string text =
      "\n## Certain bounds\n\n`--bounds` of the engine `auto`. *Outside* counts the receivers whose sky, of all triangles of "
      "the city, is beyond these bounds by more than .00002.\n\n| city | c, m | N | on | receivers | mean width | max width | "
      "outside "
      "|\n|---|---|---|---|---|---|---|---|\n";
  for (const CityResults& city : results.cities)
    for (const FarFieldRow& row : city.far_field.rows) {
      text += bounds_row(city.far_field.name, row, "ground", row.ground);
      if (row.roofs) text += bounds_row(city.far_field.name, row, "roofs", *row.roofs);
      if (row.facades) text += bounds_row(city.far_field.name, row, "façades", *row.facades);
    }
  return text;
}

std::string bytes_section(const Results& results) {
  std::string text =
      "\n## Size of far maps\n\nMean over all cells of the city, c = 50 m, N = 3: the picture, and with ours the explicit "
      "occluders.\n\n"
      "| city | paper's map, bytes a cell | ours, bytes a cell |\n|---|---|---|\n";
  for (const CityResults& city : results.cities)
    for (const FarFieldRow& row : city.far_field.rows)
      if (row.bytes_a_cell > 0.0)
        text += fmt::format("| {} | {:.0f} | {:.0f} |\n", city.far_field.name, row.box_bytes_a_cell, row.bytes_a_cell);
  return text;
}

std::string sampling_table(const CityResults& city) {
  std::string text = fmt::format(
      "\n{}:\n\n| rays | 2.4 · rays^(−3/4) | ground: mean | 99 % | max | roofs: mean | 99 % | max | façades: mean | 99 % | max | "
      "max with "
      "`--sky solid`: ground | roofs | façades |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      city.far_field.name);
  for (const SamplingRow& row : city.sampling)
    text += fmt::format("| {} | {:.4f} | {} | {} | {} | {:.4f} | {:.4f} | {:.4f} |\n", row.rays, sampling_error(row.rays) / 1.25,
                        cells_of_row(row.ground), cells_of_row(row.roofs), cells_of_row(row.facades),
                        row.ground_solid.max_abs_error, row.roofs_solid.max_abs_error, row.facades_solid.max_abs_error);
  return text + fmt::format("\nThe largest error times rays^(3/4), of all these: {:.2f}.\n", sampling_constant(city.sampling));
}

std::string sampling_section(const Results& results) {
  std::string text = fmt::format(
      "\n## Shares of the error\n\n### The sampling of the sky\n\nEngine `exact` against itself with {} rays: no far map is "
      "involved. The second column is the law of `sampling_error` (runtime/evaluate/error_budget.hpp), which adds a quarter to "
      "it.\n",
      results.extent.sampling_reference_rays);
  for (const CityResults& city : results.cities) text += sampling_table(city);
  return text;
}

std::string settings_section(const Results& results) {
  std::string text = fmt::format(
      "\n### The far map's own settings\n\nEach is varied alone ({}, c = 50 m, N = 3, the 16 × 16 cells in the middle, {} rays "
      "on both sides, up to {} receivers each; **bold**: the default). Time is wall clock.\n\n"
      "| setting | value | ground: mean | max | façades: mean | max | mean width of bounds | bytes a cell | baking, ms a cell "
      "|\n|---|---|---|---|---|---|---|---|---|\n",
      results.city_of_settings, results.extent.reference_rays, results.extent.fewer_receivers);
  for (const SettingRow& row : results.settings)
    text += fmt::format("| {} | {} | {:.5f} | {:.4f} | {:.5f} | {:.4f} | {:.4f} | {:.0f} | {:.1f} |\n", row.setting,
                        row.is_default ? "**" + row.value + "**" : row.value, row.ground.mean_abs_error, row.ground.max_abs_error,
                        row.facades.mean_abs_error, row.facades.max_abs_error, row.ground_bounds.mean_width, row.bytes_a_cell,
                        row.bake_ms_a_cell);
  return text;
}

/// What turning the grid away from the streets does, as a factor.
std::string turned_summary(const CityResults& city) {
  const std::vector<TurnedRow>& rows = city.alignment.turned;
  const auto factor = [&rows](auto&& value) {
    double sum = 0.0;
    for (std::size_t n = 1; n < rows.size(); ++n) sum += value(rows[n]);
    return sum / static_cast<double>(rows.size() - 1) / value(rows[0]);
  };
  return fmt::format("* {}: mean error × {:.2f} (paper's map), × {:.2f} (ours); bytes × {:.2f} (paper's map), × {:.2f} (ours)\n",
                     city.far_field.name, factor([](const TurnedRow& r) { return r.box.mean_abs_error; }),
                     factor([](const TurnedRow& r) { return r.horizon.mean_abs_error; }),
                     factor([](const TurnedRow& r) { return r.box_bytes_a_cell; }),
                     factor([](const TurnedRow& r) { return r.bytes_a_cell; }));
}

std::string alignment_section(const Results& results) {
  std::string text =
      "\n## Along the streets or not\n\nThe paper turns its grid along the streets. The same receivers, in the middle of each "
      "city, with the grid turned away from the streets (c = 50 m, N = 3):\n\n"
      "| city | turned by | paper's map: mean | max | ours: mean | max | paper's map, bytes a cell | ours, bytes a cell | baking "
      "ours, ms a cell |\n|---|---|---|---|---|---|---|---|---|\n";
  for (const CityResults& city : results.cities)
    for (const TurnedRow& row : city.alignment.turned)
      text += fmt::format("| {} | {:g}° | {:.5f} | {:.4f} | {:.5f} | {:.4f} | {:.0f} | {:.0f} | {:.1f} |\n", city.far_field.name,
                          row.turn_deg, row.box.mean_abs_error, row.box.max_abs_error, row.horizon.mean_abs_error,
                          row.horizon.max_abs_error, row.box_bytes_a_cell, row.bytes_a_cell, row.bake_ms_a_cell);
  text += "\nThe mean over the turned grids, divided by that of the grid along the streets:\n\n";
  for (const CityResults& city : results.cities) text += turned_summary(city);
  return text;
}

std::string moved_section(const Results& results) {
  std::string text =
      "\n### Another grid, the same answers\n\nHow much our answers change with the grid, and how much their bounds allow. "
      "An answer differs from the exact one at most by the distance to its farther bound, and two answers at most by the sum of "
      "these distances. *Beyond* counts the receivers whose answers differ by more.\n\n| city | grid | mean change | max change "
      "| most that bounds allow | beyond "
      "|\n|---|---|---|---|---|---|\n";
  const auto add = [&text](const std::string& city, const std::string& what, const MovedGrid& m) {
    text += fmt::format("| {} | {} | {:.5f} | {:.4f} | {:.4f} | {} |\n", city, what, m.mean_change, m.max_change, m.max_stated,
                        m.beyond);
  };
  for (const CityResults& city : results.cities) {
    add(city.far_field.name, "moved by c/3 both ways", city.alignment.by_a_third_of_a_cell);
    add(city.far_field.name, "turned by 10°", city.alignment.turned_by_10_deg);
  }
  return text;
}

}  // namespace

std::string markdown(const Results& results) {
  std::string text =
      "## Near field, far field\n\nThe paper keeps the true geometry of N × N cells around a receiver and takes the rest of the "
      "city from a picture captured at the cell's centre (`--far-map box`). Ours (`--far-map horizon`, the default) stores the "
      "far edges whose direction changes within a cell one by one, as explicit occluders, and bounds the rest by a residual "
      "horizon. *Dropped*: the far field is left out, as by tools that cut a city into tiles.\n\n";
  text += intro(results);
  for (const CityResults& city : results.cities) text += far_field_table(city.far_field);
  text += rays_table(results);
  text += surfaces_section(results);
  text += models_section(results);
  text += bounds_section(results);
  text += bytes_section(results);
  text += sampling_section(results);
  text += settings_section(results);
  text += alignment_section(results);
  return text + moved_section(results);
}

}  // namespace farlod::validation
