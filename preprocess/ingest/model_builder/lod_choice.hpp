// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace farlod::ingest {

/// The level of detail that a user asks for.
struct LodChoice {
  std::optional<int> exactly;  ///< 0 to 3; empty: the best from 1 to 3
};

/// The level of detail to read of each part of a building; empty: nothing is read of the part. `lods_of_parts` has the levels
/// with usable surfaces, of the building itself (first) and of each part. Refined levels (2.2) belong to their whole number (2).
///   (1) one level is chosen for the whole building
///   (2) a part that lacks it is read in its best level
///   (3) of the building itself nothing is read if it lacks that level: a coarser shell would enclose the parts again
[[nodiscard]] std::vector<std::optional<double>> choose_lods(std::span<const std::vector<double>> lods_of_parts,
                                                             LodChoice choice);

/// For messages: "1, 2.2", or "none".
[[nodiscard]] std::string list_lods(std::span<const std::vector<double>> lods_of_parts);

/// The text of the report about the polygons of levels that were not chosen.
[[nodiscard]] std::string unused_polygons(std::size_t count, std::span<const std::vector<double>> lods_of_parts);

}  // namespace farlod::ingest
