// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "farlod/surfaces.hpp"

namespace farlod {

/// Writes what surfaces see as objects of EnergyPlus, which stand behind those of a model: for each surface a
/// SurfaceProperty:LocalEnvironment and a SurfaceProperty:SurroundingSurfaces.
///   (1) A surface is called SurfaceMean::id, or else its building, `_` and its number. Rows of one name are one surface, whose
///       means are weighted by their areas; those without a receiver that has an answer are left out.
///   (2) View factors are the means of Quantities::view_factors: sky, ground, and of surrounding surfaces those that are seen.
///   (3) They have six digits, and add up to .999999 at most: EnergyPlus refuses what is more than 1.
/// Schedules of temperatures are named, and not written. `columns` are the names of SurfaceMean::further_mean. Throws
/// OutputError.
void write_energyplus_idf(std::span<const SurfaceMean> surfaces, std::span<const std::string> columns,
                          const std::filesystem::path& path);

}  // namespace farlod
