// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "farlod/surfaces.hpp"
#include "results/table/table_writer.hpp"

namespace farlod {

/// How a number of a table is written.
enum class NumberForm : std::uint8_t {
  shortest,  ///< as the values of receivers are
  rounded    ///< to thousandths, as areas are
};

/// A number of a surface or a building behind those of svf, under its name; NaN where it has none.
struct AreaColumn {
  std::string name;
  double value;
  NumberForm form;
};

/// The areas of a building; none of roofs (walls) where no roof (wall) has a receiver, as where nobody asked for them.
struct BuildingAreas {
  std::optional<double> roofs_m2, walls_m2;                  ///< with an answer
  std::optional<double> covered_roofs_m2, covered_walls_m2;  ///< without one
};
[[nodiscard]] BuildingAreas areas_of(const BuildingMean& building);

/// Whether tables of these surfaces have the column surface_id: where one of them has an id.
[[nodiscard]] bool have_ids(std::span<const SurfaceMean> surfaces);

/// The columns that follow those of svf, with the values of a surface:
///   (1) COLUMN_mean of each further column;
///   (2) with irradiation, irradiation_kwh, and with a threshold area_above_m2.
[[nodiscard]] std::vector<AreaColumn> area_columns_of(const SurfaceMean& surface, const AnswerColumns& columns);

/// The same of a building:
///   (1) COLUMN_roofs of each further column, then COLUMN_walls of each;
///   (2) with irradiation, roof_irradiation_kwh and wall_irradiation_kwh, and with a threshold roof_area_above_m2 and
///       wall_area_above_m2.
[[nodiscard]] std::vector<AreaColumn> area_columns_of(const BuildingMean& building, const AnswerColumns& columns);

}  // namespace farlod
