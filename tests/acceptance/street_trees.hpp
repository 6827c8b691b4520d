// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sstream>
#include <string>

#include "tests/acceptance/small_town.hpp"

namespace farlod::acceptance {

/// Two rows of trees in the streets of the town.
[[nodiscard]] inline std::string street_trees() {
  std::ostringstream table;
  table.precision(10);
  table << "id,lon,y,x,BAUMHOEHE,KRONE_DM\n";
  for (int n = 0; n < 20; ++n) {
    const Point2d p = p_projected({-95.0 + 10.0 * n, (n % 2 == 0 ? 6.0 : -6.0)});
    table << n << ",," << p.y << ',' << p.x << ",9.5,6\n";
  }
  return table.str();
}

}  // namespace farlod::acceptance
