// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "plausibility/elevations_as_heights.hpp"

namespace farlod::plausibility {

/// Why the values of a field are hardly heights of buildings in metres, in words that go on behind its name, with what to do;
/// none where they may be. Ten buildings must be there.
///   (1) areas: for nine of ten buildings, the value is about the area of the outline
///   (2) storeys: 98 % are whole numbers up to 60, half of which are at most 3; or at most 8 where the field is called so, or
///       3 % of 20 buildings and more are too low for metres (1, or 2 on a box of 100 m²), and any is 2 or 3
///   (3) another unit, or another thing: half are more than 300 m, or half are six times as high as they are wide
///   (4) feet: the field is called `heightft`, which is no clear ending as `_ft` is
///   (5) codes: of 50 buildings and more, whole numbers up to 30, of which one of 50 is 1, as codes begin and no town does
[[nodiscard]] std::optional<std::string> doubt_about_heights(std::span<const SaidHeight> heights, std::string_view field);

/// The same of a field that was read as numbers of storeys, each `floor_height_m` high.
///   (1) fractions: half of the values are no whole numbers, nor halves, as heights are
///   (2) another thing: rule (3) of heights
[[nodiscard]] std::optional<std::string> doubt_about_storeys(std::span<const SaidHeight> heights, std::string_view field,
                                                             double floor_height_m);

}  // namespace farlod::plausibility
