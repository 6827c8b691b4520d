// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sstream>
#include <string>

#include "farlod/point.hpp"

namespace farlod::georeference {

/// A place as messages show it.
[[nodiscard]] inline std::string place_text(Point2d p) {
  std::ostringstream text;
  text.precision(10);
  text << p.x << ", " << p.y;
  return text.str();
}

}  // namespace farlod::georeference
