// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farlod/morphology.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/run_settings.hpp"
#include "farlod/error.hpp"
#include "run/cell_amounts.hpp"
#include "run/cell_crowns.hpp"
#include "run/cell_faces.hpp"
#include "run/cells_in_parallel.hpp"
#include "run/facing.hpp"
#include "run/memory_limit.hpp"
#include "run/morphology_of_package.hpp"
#include "run/package_contents.hpp"

namespace farlod {
namespace {

CellMorphology morphology_of(const PackageReader& reader, Cell cell, const WindDirections& winds) {
  const package::Manifest& m = reader.manifest();
  CellMorphology result;
  result.cell = {cell.i, cell.j};
  const auto [low, high] = m.grid.square_of(cell);
  for (std::size_t n = 0; const Point2d corner : {low, Point2d{high.x, low.y}, high, Point2d{low.x, high.y}})
    result.corners_projected[n++] = horizontal(m.projected_from_grid({corner.x, corner.y, 0.0}));
  const CellFaces faces = faces_of(reader, cell);
  result.amounts = form_of(faces, winds).all();
  result.vegetation = vegetation_of(reader, cell, faces);
  result.amounts.plan_area_m2 = m.grid.cell_edge_m * m.grid.cell_edge_m;
  return result;
}

}  // namespace

void require_buildings_cut_at_borders(const package::Manifest& m) {
  if (m.pixels && m.buildings == 0)
    throw InvalidArgument(
        "this package is a surface model, which does not tell buildings from ground: pack footprints or a city "
        "file for what cells hold of buildings");
  if (m.assign == "whole")
    throw InvalidArgument("this package has each building whole in one cell: pack it with --assign clip for what cells hold");
}

WindDirections winds_of(const package::Manifest& m) {
  WindDirections winds;
  for (std::size_t k = 0; k < winds.size(); ++k)
    winds[k] = horizontal(normal_of({Angle::degrees(360.0 * static_cast<double>(k) / wind_directions), Angle::degrees(90.0)}, m));
  return winds;
}

double UrbanForm::lambda_f_mean() const {
  const auto& areas_m2 = amounts.frontal_area_m2;
  return std::accumulate(areas_m2.begin(), areas_m2.end(), 0.0) / (wind_directions * amounts.plan_area_m2);
}

double UrbanForm::complete_aspect_ratio() const {
  return (amounts.wall_area_m2 + amounts.roof_area_m2 + amounts.plan_area_m2 - amounts.building_plan_area_m2) /
         amounts.plan_area_m2;
}

std::optional<double> UrbanForm::height_to_width() const {
  // Rounding leaves a little ground in a cell without any
  constexpr double least_ground_share = 1e-6;
  if (lambda_p() > 1.0 - least_ground_share) return std::nullopt;
  return 0.5 * amounts.wall_area_m2 / (amounts.plan_area_m2 - amounts.building_plan_area_m2);
}

std::optional<double> UrbanForm::vegetation_fraction() const {
  return vegetation ? std::optional(vegetation->plan_area_m2 / amounts.plan_area_m2) : std::nullopt;
}

std::optional<double> UrbanForm::height_mean_m() const {
  if (!(amounts.volume_m3 > 0.0)) return std::nullopt;
  return amounts.volume_m3 / amounts.building_plan_area_m2;
}

std::optional<double> UrbanForm::height_std_m() const {
  const auto mean_m = height_mean_m();
  if (!mean_m) return std::nullopt;
  return std::sqrt(std::max(0.0, amounts.height_moment_m4 / amounts.building_plan_area_m2 - *mean_m * *mean_m));
}

std::optional<double> UrbanForm::height_share(std::size_t bin) const {
  const auto& areas_m2 = amounts.plan_area_by_height_m2;
  const double all_m2 = std::accumulate(areas_m2.begin(), areas_m2.end(), 0.0);
  return all_m2 > 0.0 ? std::optional(areas_m2[bin] / all_m2) : std::nullopt;
}

std::optional<Roughness> UrbanForm::roughness_macdonald() const {
  constexpr double a = 4.43, beta = 1.0, drag = 1.2, karman = 0.4;
  const auto height_m = height_mean_m();
  if (!height_m) return std::nullopt;
  const double displaced = 1.0 + std::pow(a, -lambda_p()) * (lambda_p() - 1.0), free = 1.0 - displaced;
  const double resistance = 0.5 * beta * drag / (karman * karman) * free * lambda_f_mean();
  // Nothing stands in the wind: the limit of the exponential
  const double length = resistance > 0.0 ? free * std::exp(-1.0 / std::sqrt(resistance)) : 0.0;
  return Roughness{length * *height_m, displaced * *height_m};
}

std::optional<Roughness> UrbanForm::roughness_kanda() const {
  constexpr double a0 = 1.29, b0 = 0.36, c0 = -0.17, a1 = 0.71, b1 = 20.21, c1 = -0.77;
  const auto macdonald = roughness_macdonald();
  if (!macdonald) return std::nullopt;
  const double mean_m = *height_mean_m(), std_m = *height_std_m(), max_m = amounts.height_max_m;
  const double x = std::min(1.0, (std_m + mean_m) / max_m), y = lambda_p() * std_m / mean_m;
  return Roughness{(b1 * y * y + c1 * y + a1) * macdonald->length_m,
                   (c0 * x * x + (a0 * std::pow(lambda_p(), b0) - c0) * x) * max_m};
}

std::vector<CellMorphology> morphology_of_cells(const Package& package, const RunSettings& run) {
  require_usable(run);
  const PackageInUse in_use(package);
  const PackageReader& reader = in_use.reader();
  require_buildings_cut_at_borders(reader.manifest());
  const auto count = static_cast<std::size_t>(reader.grid().cells.size());
  require_memory(run, static_cast<double>(count * sizeof(CellMorphology) + bytes_of_blocks_at_work(reader.manifest())),
                 "describing cells", "pack the city in larger cells");
  const WindDirections winds = winds_of(reader.manifest());
  std::vector<CellMorphology> cells(count);
  for_each_cell(count, run, "cells",
                [&](std::size_t n) { cells[n] = morphology_of(reader, reader.grid().cells.cell_at(n), winds); });
  return cells;
}

}  // namespace farlod
