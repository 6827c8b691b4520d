// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>

#include "city/city_model.hpp"
#include "farlod/box.hpp"
#include "farlod/point.hpp"
#include "farlod/problem.hpp"

namespace farlod::plausibility {

/// Height of the ground at a place of the city frame, where it is known.
using KnownGroundHeightAt = std::function<std::optional<double>(Point2d p_city)>;

/// Where a survey of the ground comes from.
struct SurveyedGround {
  KnownGroundHeightAt height_at;
  Box2d extent_city;        ///< of its points
  bool is_raster = false;   ///< and no relief of a city file
  double offset_m = 0.0;    ///< by which the user raised it already
  std::string source = {};  ///< the file, or the first of several
};

/// The nodes of a terrain that have a height, and the points of a relief.
[[nodiscard]] Box2d extent_of_survey(const std::optional<TerrainRaster>& terrain, std::span<const Point3d> relief_points_city);

/// Compares the buildings whose heights are elevations with the ground below them, but for those that the file says to begin
/// above it.
///
/// A building stands on the ground when its lowest point lies between the lowest and the highest ground under its outline, with a
/// tolerance of .75 m. With an offset, it does when it is lowered by it.
///   (1) another_datum: at most a fifth of the buildings of a file stand on the ground, with one offset three quarters of them
///       would, and it is no plinth (1.5 m above the ground) and no cellar (3.2 m below it); or this holds in a square of 2 km.
///       Reported once for each file. Of fewer than eight buildings, only offsets of 10 m count.
///       Where no offset is told, buildings are counted that hang 2 m and more above all ground below them, each by another
///       height: a fifth of those of the file, and at least four of at least eight.
///   (2) beyond_terrain: buildings whose middle is outside of the extent of the survey. Reported once for each file.
/// Throws InputError when what is told in (1) holds for most of the city, and no town can stand so: its roofs are below the
/// ground, or its floors 10 m above it; and when the ground has roofs in it (require_ground_without_roofs). Roofs without bases
/// are compared, too (report_roofs), and heights of footprints (report_heights_above_ground). Of ground in another unit
/// (report_unit_of_terrain, report_steep_terrain), nothing but (2) is told.
void report_standing(const LocatedCity& located, const SurveyedGround& ground, Report& report);

}  // namespace farlod::plausibility
