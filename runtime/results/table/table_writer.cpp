// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/table/table_writer.hpp"

namespace farlod {

std::vector<std::string> names_of(const AnswerColumns& columns) {
  std::vector<std::string> names{columns.quantity};
  if (columns.bounds == BoundsColumns::yes) names.insert(names.end(), {columns.quantity + "_low", columns.quantity + "_high"});
  for (const ColumnDescription& column : columns.further) names.push_back(column.name);
  return names;
}

std::vector<std::string> own_columns_of_points(bool normals, const AnswerColumns& columns) {
  std::vector<std::string> names{"id", "x_m", "y_m", "z_m", "height_above_ground_m"};
  if (normals) names.insert(names.end(), {"azimuth_deg", "tilt_deg"});
  const std::vector<std::string> answers = names_of(columns);
  names.insert(names.end(), answers.begin(), answers.end());
  return names;
}

std::filesystem::path table_beside(const std::filesystem::path& output, const std::string& what) {
  return std::filesystem::path(output).replace_extension(what + output.extension().string());
}

}  // namespace farlod
