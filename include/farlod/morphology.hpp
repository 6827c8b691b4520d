// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "farlod/evaluation.hpp"
#include "farlod/export.hpp"
#include "farlod/inspection.hpp"
#include "farlod/package.hpp"
#include "farlod/point.hpp"
#include "farlod/quantities.hpp"
#include "farlod/run.hpp"

namespace farlod {

/// Directions that the wind comes from: the k-th is k · 22.5° clockwise from true north.
inline constexpr std::size_t wind_directions = 16;

/// Bins of heights, as models count them (NUDAPT): the k-th from k · 5 m to less than (k + 1) · 5 m, and the last from 70 m on.
inline constexpr std::size_t height_bins = 15;
inline constexpr double height_bin_m = 5.0;

/// What a cell has of areas and heights. Sums over cells are those of the city, whatever the size of the cells, but for rounding
/// and for `buildings`. What lies below the ground counts nowhere.
struct CellAmounts {
  double plan_area_m2 = 0.0;  ///< of the cell, with its buildings
  /// The ground that roofs, and walls that lean back, cover seen from above: what several cover counts once.
  double building_plan_area_m2 = 0.0;
  double roof_area_m2 = 0.0;  ///< of the roofs seen from above, along their slopes
  /// The outer sides of walls, without party walls: where two walls stand back to back, neither counts.
  double wall_area_m2 = 0.0;
  /// Those walls and roofs, seen from where the wind comes from, as if nothing stood in front of anything.
  std::array<double, wind_directions> frontal_area_m2{};
  /// The integrals of the height of what is seen from above over the ground below it, and of its square, over the building plan
  /// area; the largest height.
  double volume_m3 = 0.0, height_moment_m4 = 0.0, height_max_m = 0.0;
  /// The building plan area by its height: what lies a millimetre below a border of bins, as rounding may have it, is at it.
  std::array<double, height_bins> plan_area_by_height_m2{};
  /// The buildings that are seen from above in the cell, each by its mean height there: number, mean, standard deviation.
  std::size_t buildings = 0;
  double building_height_mean_m = 0.0, building_height_std_m = 0.0;
};

/// What a cell of a package with trees has of crowns. Trunks do not count.
struct CellVegetation {
  double plan_area_m2 = 0.0;   ///< below crowns, on the ground or above roofs; what several cover counts once
  std::size_t count = 0;       ///< crowns whose axes stand in the cell
  double height_mean_m = 0.0;  ///< of their tops above the ground below their axes; 0 without crowns
};

/// The mean sky view factors of what a cell or a zone has, of what is not covered: sky_of_cells. None where nothing is.
struct CellSky {
  std::optional<double> ground, walls, roofs;
};

/// Roughness length and zero-plane displacement height for wind.
struct Roughness {
  double length_m = 0.0, displacement_m = 0.0;
};

/// What the amounts of a cell mean, in the words of urban climatology. Without buildings there are no heights and no roughness;
/// without ground between them no height to width ratio.
struct UrbanForm {
  CellAmounts amounts;
  /// None where the package has no crowns at all: nobody said that no trees stand there.
  std::optional<CellVegetation> vegetation;
  CellSky sky;  ///< nothing, unless the caller fills it

  [[nodiscard]] double lambda_p() const { return amounts.building_plan_area_m2 / amounts.plan_area_m2; }
  [[nodiscard]] double lambda_f(std::size_t wind) const { return amounts.frontal_area_m2[wind] / amounts.plan_area_m2; }
  [[nodiscard]] FARLOD_EXPORT double lambda_f_mean() const;  ///< of all wind directions
  [[nodiscard]] double wall_to_plan() const { return amounts.wall_area_m2 / amounts.plan_area_m2; }
  /// All surface in contact with the air over the plan area (Voogt & Oke 1997): walls, roofs, and the ground between them as if
  /// it were level.
  [[nodiscard]] FARLOD_EXPORT double complete_aspect_ratio() const;
  /// The ratio of the canyon that has as much wall and ground (Masson 2000): half the wall area over the plan area without
  /// buildings.
  [[nodiscard]] FARLOD_EXPORT std::optional<double> height_to_width() const;
  /// The share of the plan area below crowns.
  [[nodiscard]] FARLOD_EXPORT std::optional<double> vegetation_fraction() const;
  /// Mean and standard deviation over the building plan area.
  [[nodiscard]] FARLOD_EXPORT std::optional<double> height_mean_m() const;
  [[nodiscard]] FARLOD_EXPORT std::optional<double> height_std_m() const;
  /// The share of the building plan area that is as high as a bin says; of all bins 1.
  [[nodiscard]] FARLOD_EXPORT std::optional<double> height_share(std::size_t bin) const;
  /// By Macdonald et al. (1998), for staggered obstacles (A = 4.43, β = 1, C_D = 1.2, κ = 0.4), from lambda_p, lambda_f_mean and
  /// height_mean_m.
  [[nodiscard]] FARLOD_EXPORT std::optional<Roughness> roughness_macdonald() const;
  /// By Kanda et al. (2013), whose length is a multiple of the former, from height_std_m and the largest height besides.
  [[nodiscard]] FARLOD_EXPORT std::optional<Roughness> roughness_kanda() const;
};

/// The urban form of a cell of the grid.
struct CellMorphology : UrbanForm {
  CellPlace cell;
  std::array<Point2d, 4> corners_projected;  ///< counter-clockwise from the south-western one, easting and northing
};

/// A part of the map that takes the place of a cell, such as a census block or a square of a model: what lies in an odd number of
/// rings (Region::Ring), in the package's CRS. Rings touch each other and themselves in corners only.
using Zone = std::vector<std::vector<Point2d>>;

/// The cells of a package, row by row from the south-west. Throws InvalidArgument where the package does not tell buildings from
/// ground (a surface model), or has not cut them at the borders of cells; Cancelled, PackageUnusable, PackageDamaged.
[[nodiscard]] FARLOD_EXPORT std::vector<CellMorphology> morphology_of_cells(const Package& package, const RunSettings& run = {});

/// The same of zones, in their order; they may overlap. Their plan area is that of their rings, also beyond the grid; it is 0 of
/// zones that lie beyond the grid as a whole, of which nothing is known.
///   (1) Walls and roofs are cut exactly at the borders of zones: sums over zones that part the city are those of the city.
///   (2) A wall on a border belongs to the zone behind it, where its building is.
/// Throws InvalidArgument for a coordinate that is no number, or larger than 1e8 m, for a zone without area, and where all zones
/// lie beyond the grid, too.
[[nodiscard]] FARLOD_EXPORT std::vector<UrbanForm> morphology_of_zones(const Package& package, const std::vector<Zone>& zones,
                                                                       const RunSettings& run = {});

/// The sky of the cells, in the same order: of the ground between buildings, on pixels of `spacing_m` (0.05 to 1,000) whose
/// centres lie in the cell, and of walls and roofs as evaluate_surfaces has their receivers, by area. Throws what evaluate_raster
/// and evaluate_surfaces throw, InvalidArgument for a dry run and for a run whose answers are kept, too.
[[nodiscard]] FARLOD_EXPORT std::vector<CellSky> sky_of_cells(const Package& package, double spacing_m,
                                                              const EvaluationSettings& settings = {},
                                                              const RunSettings& run = {});

/// The same of zones, in their order, where they lie in the grid. A wall on a border belongs to the zone behind it. Only what
/// lies near zones is evaluated. Throws what morphology_of_zones throws of them, and InvalidArgument for a region, too.
[[nodiscard]] FARLOD_EXPORT std::vector<CellSky> sky_of_zones(const Package& package, const std::vector<Zone>& zones,
                                                              double spacing_m, const EvaluationSettings& settings = {},
                                                              const RunSettings& run = {});

/// The columns of the table of cells, and what a cell has there: nothing where it has nothing to tell, or no plan area.
[[nodiscard]] FARLOD_EXPORT std::vector<ColumnDescription> morphology_columns();
[[nodiscard]] FARLOD_EXPORT std::vector<std::optional<double>> morphology_values(const UrbanForm& form);

}  // namespace farlod
