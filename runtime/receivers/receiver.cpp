// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "receivers/receiver.hpp"

namespace farlod {

std::optional<Point3f> stand(const CellColumns& columns, float x_cell, float y_cell, HeightAbove above, float height_m) {
  const Column column = columns.at(x_cell, y_cell);
  float z_m = height_m;
  if (above == HeightAbove::ground) z_m += column.ground_m().value_or(0.0F);
  if (above == HeightAbove::highest_surface) z_m += column.highest_m().value_or(0.0F);
  if (column.is_inside_building(z_m)) return std::nullopt;
  return Point3f{x_cell, y_cell, z_m};
}

}  // namespace farlod
