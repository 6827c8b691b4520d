// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "farlod/angle.hpp"
#include "farlod/evaluation.hpp"
#include "farlod/export.hpp"
#include "farlod/package.hpp"
#include "farlod/point.hpp"
#include "farlod/run.hpp"
#include "farlod/surface_kind.hpp"
#include "farlod/word.hpp"

namespace farlod {

enum class SurfaceChoice { roofs, walls, all };
inline constexpr std::array<Word<SurfaceChoice>, 3> surface_choice_words{
    {{"roofs", SurfaceChoice::roofs}, {"walls", SurfaceChoice::walls}, {"all", SurfaceChoice::all}}};

/// Which surfaces have receivers, and how densely: each triangle of area A has ⌈A/spacing²⌉ of them, evenly placed, each standing
/// for an equal share of its area.
struct SurfaceSettings {
  SurfaceChoice choice = SurfaceChoice::all;
  double spacing_m = 2.0;  ///< 0.05 to 1,000
  /// Surfaces and buildings tell which of their area gets at least so much, 0 to 100,000 kWh/m². Needs Quantities::irradiation.
  std::optional<double> irradiation_threshold_kwh_m2 = {};
};

/// A receiver on a surface of a building.
struct SurfacePoint {
  std::string building;
  std::uint32_t surface = 0;  ///< its number within the building
  SurfaceKind kind = SurfaceKind::unknown;
  Point3d p_projected;
  Angle azimuth;                    ///< of the outward normal, true (clockwise from true north)
  Angle tilt;                       ///< of the outward normal: 0° looks up, 90° is a wall
  double area_m2 = 0.0;             ///< the part of the surface that this receiver stands for
  std::optional<double> svf;        ///< none inside another building, or below the ground
  std::optional<double> low, high;  ///< certain bounds, where asked for
  /// A value for each of columns_of(EvaluationSettings::further); empty where there is no svf.
  std::vector<float> further = {};
  std::uint32_t building_number = 0;  ///< of the building, within the city; ids may be those of several
};

/// What falls on an area in the period of Quantities::light.
struct AreaIrradiation {
  double kwh = 0.0;
  /// The part that gets at least SurfaceSettings::irradiation_threshold_kwh_m2, which there is where that is given.
  std::optional<double> area_above_m2 = {};
};

/// Area-weighted mean over the receivers of a surface that have an answer.
struct SurfaceMean {
  std::string building;
  std::uint32_t surface = 0;
  SurfaceKind kind = SurfaceKind::unknown;
  Angle azimuth, tilt;
  double area_m2 = 0.0;          ///< of the receivers that have an answer
  double covered_area_m2 = 0.0;  ///< of those that have none: below the ground or inside another building, it sees no sky
  std::size_t receivers = 0, nodata = 0;
  std::optional<double> svf_mean = {}, svf_min = {}, svf_max = {};
  std::vector<double> further_mean = {};            ///< of the same; empty where no receiver has an answer
  std::optional<AreaIrradiation> irradiation = {};  ///< of area_m2, with Quantities::irradiation; none where that is 0
  /// What the city file calls it: the semantic surface, or else its polygon. Empty where file or package do not tell, and where
  /// several buildings share their id.
  std::string id = {};
};

/// Area-weighted means over the roofs and walls of a building.
struct BuildingMean {
  std::string building;
  double roof_area_m2 = 0.0, wall_area_m2 = 0.0;                  ///< of the receivers that have an answer
  double covered_roof_area_m2 = 0.0, covered_wall_area_m2 = 0.0;  ///< of those that have none
  std::size_t receivers = 0, nodata = 0;
  std::optional<double> svf_roofs = {}, svf_walls = {};
  /// The numbers of the buildings, within the city, ascending: one, unless several share the id, and have this row together.
  std::vector<std::uint32_t> building_numbers = {};
  /// A value for each of columns_of(EvaluationSettings::further); empty where no roof (wall) has an answer.
  std::vector<double> further_roofs = {}, further_walls = {};
  std::optional<AreaIrradiation> roof_irradiation = {}, wall_irradiation = {};  ///< as SurfaceMean::irradiation
};

/// The means of a run, in an order that depends on nothing but the package and the settings.
struct SurfaceMeans {
  std::vector<SurfaceMean> surfaces;
  std::vector<BuildingMean> buildings;
  EvaluationSummary summary;
};

/// Takes the receivers of a cell of the grid: one cell at a time, each once, in the same order whatever the number of threads;
/// `cell` counts the cells row by row from the south-west. `points` are valid during the call only. What it throws ends the run.
using OnSurfacePoints = std::function<void(std::size_t cell, std::span<const SurfacePoint> points)>;

/// Evaluates receivers on the roofs and walls of all buildings. Throws InvalidArgument, Cancelled, LimitReached, PackageUnusable,
/// PackageDamaged. `on_points` may be empty.
[[nodiscard]] FARLOD_EXPORT SurfaceMeans evaluate_surfaces(const Package& package, const SurfaceSettings& surfaces,
                                                           const EvaluationSettings& settings = {},
                                                           const OnSurfacePoints& on_points = {}, const RunSettings& run = {});

}  // namespace farlod
