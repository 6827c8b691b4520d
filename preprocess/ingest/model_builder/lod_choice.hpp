// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace farlod::ingest {

/// Which level of detail of a building is taken.
struct LodChoice {
  std::optional<int> exactly;  ///< 0 to 3; empty: the best from 1 to 3
};

/// The level of detail that each part of one building is taken from; empty: nothing is taken of the part.
/// `lods_of_parts` lists the levels with usable surfaces, for the building itself (first) and each of its parts. Refined
/// levels (2.2) belong to their whole number (2). One level holds for all; but a part that lacks it gives the best it
/// has, unless it is the building itself, whose coarser shell encloses the parts and would count them twice.
[[nodiscard]] std::vector<std::optional<double>> choose_lods(std::span<const std::vector<double>> lods_of_parts,
                                                             LodChoice choice);

/// "1, 2.2": for messages. "none" when there are none.
[[nodiscard]] std::string list_lods(std::span<const std::vector<double>> lods_of_parts);

/// What the report says of the polygons of the levels that were not chosen.
[[nodiscard]] std::string unused_polygons(std::size_t count, std::span<const std::vector<double>> lods_of_parts);

}  // namespace farlod::ingest
