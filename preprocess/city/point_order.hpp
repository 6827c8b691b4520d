// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tuple>

#include "farlod/point.hpp"

namespace farlod {

/// An order of points, by which results do not depend on the order of the input.
[[nodiscard]] inline bool comes_first(const Point3d& a, const Point3d& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

}  // namespace farlod
