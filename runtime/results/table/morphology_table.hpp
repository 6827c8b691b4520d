// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "farlod/morphology.hpp"
#include "inputs/requested_zones.hpp"
#include "results/table/feature_writer.hpp"

namespace farlod {

/// The urban form of a cell of the grid, or of a polygon in its place.
struct FormRow {
  std::vector<FieldValue> identity;  ///< as many as FormTable::identity
  Point2d centre;
  std::vector<SurfacePolygon> areas;
  UrbanForm form;
};

struct FormTable {
  std::string name, description;
  std::vector<FeatureField> identity;  ///< the first columns: what a row is
  LayerGeometry geometry = LayerGeometry::areas;
  std::vector<FormRow> rows = {};
};

/// Rows begin with i and j; places are the squares of the cells.
[[nodiscard]] FormTable table_of_cells(std::span<const CellMorphology> cells);
/// Rows begin with `zone`, the number of the feature in its file from 1, and its fields; one that is called like another column
/// has `_input` behind. Centres are those of mass. `zones` must outlive the table.
[[nodiscard]] FormTable table_of_zones(const RequestedZones& zones, std::span<const UrbanForm> forms);

/// Writes a row for each: what it is, the centre x_m and y_m, morphology_columns(). Lengths and areas are rounded to the
/// millimetre, shares to six digits. Throws OutputError.
void write_morphology_csv(const FormTable& table, const std::filesystem::path& path);

/// Adds the same rows as a layer.
void write_morphology_as_features(const FormTable& table, FeatureWriter& writer);

}  // namespace farlod
