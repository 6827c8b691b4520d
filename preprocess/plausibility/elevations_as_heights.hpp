// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "city/city_model.hpp"
#include "farlod/problem.hpp"
#include "plausibility/standing_heights.hpp"

namespace farlod::plausibility {

/// What a table gives as the height of a footprint.
struct SaidHeight {
  double height_m = 0.0;
  double plan_m2 = 0.0;
  std::optional<double> outline_m = {};  ///< the elevation that its outline has
  std::optional<double> ground_m = {};   ///< the elevation of the ground there
};

/// Why the heights of a field are elevations, in words that go on behind its name; none where they may be heights.
///   (1) outlines lie where the field says: at 20 m or higher, or at any height where the field is called like an elevation
///   (2) the field is called like an elevation, and no building is lower than 20 m
///   (3) all buildings are higher than 40 m, and six times as high as they are wide
///   (4) houses stand on ground of 20 m and higher, and each would be 1.5 to 40 m high if its height counted from sea level
/// One of twenty may be otherwise, and three must be there, five for (3) and (4).
[[nodiscard]] std::optional<std::string> sign_of_elevations(std::span<const SaidHeight> heights, std::string_view field);

/// Throws InputError where the heights of a field of a file are elevations.
void require_heights(const std::string& source, const std::string& field, std::span<const SaidHeight> heights);

/// What is said to be a height, and the elevation of the ground there.
struct HeightOnGround {
  double height_m = 0.0, ground_m = 0.0;
};

/// The medians of heights that look like elevations.
struct LikelyElevations {
  double height_m = 0.0, ground_m = 0.0, above_m = 0.0;
};

/// Whether heights look like elevations, since real towns and woods have low buildings and crowns, too: of ten and more on ground
/// of typically more than 15 m, 19 of 20 are larger than their ground, by typically 2 to 60 m. Half that are one value say
/// nothing: they are a default.
[[nodiscard]] std::optional<LikelyElevations> likely_elevations(std::span<const HeightOnGround> heights);

/// The heights of footprints that are raised from the ground, file by file:
///   (1) throws InputError by rule (4) of sign_of_elevations, but where most have the height of another one: that follows from
///       storeys or from a default
///   (2) implausible_size where they are likely_elevations, of buildings of any size
void report_heights_above_ground(const LocatedCity& located, const SurveyedGround& ground, Report& report);

}  // namespace farlod::plausibility
