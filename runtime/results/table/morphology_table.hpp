// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>

#include "farlod/morphology.hpp"
#include "results/table/feature_writer.hpp"

namespace farlod {

/// Writes a row for each cell: i, j, the centre x_m and y_m, morphology_columns(). Lengths and areas are rounded to the
/// millimetre, shares to six digits. Throws OutputError.
void write_morphology_csv(std::span<const CellMorphology> cells, const std::filesystem::path& path);

/// Adds the same rows as a layer `cells`, whose places are the squares of the cells.
void write_morphology_as_features(std::span<const CellMorphology> cells, FeatureWriter& writer);

}  // namespace farlod
