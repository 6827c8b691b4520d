// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "farlod/morphology.hpp"
#include "farlod/quantities.hpp"
#include "results/table/feature_writer.hpp"

namespace farlod {

/// The columns that tell what a cell has, besides `i` and `j`.
[[nodiscard]] std::vector<ColumnDescription> morphology_columns();
/// Their values for a cell; none where the cell has nothing to say.
[[nodiscard]] std::vector<std::optional<double>> morphology_values(const CellMorphology& cell);

/// Writes a row for each cell: i, j, the centre x_m and y_m, the columns above. Lengths and areas are rounded to the millimetre,
/// shares to six digits. Throws OutputError.
void write_morphology_csv(std::span<const CellMorphology> cells, const std::filesystem::path& path);

/// Adds the same rows as a layer `cells`, whose places are the squares of the cells.
void write_morphology_as_features(std::span<const CellMorphology> cells, FeatureWriter& writer);

}  // namespace farlod
