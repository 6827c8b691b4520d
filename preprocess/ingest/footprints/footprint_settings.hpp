// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

namespace farlod::ingest {

/// Where the heights of footprints come from: names of attributes, and values for features without them.
struct FootprintSettings {
  std::optional<std::string> height_field = {};   ///< height above the base
  std::optional<std::string> base_field = {};     ///< elevation of the base
  std::optional<std::string> storeys_field = {};  ///< number of storeys
  double floor_height_m = 3.0;                    ///< height of a storey, where only the number of storeys is known
  std::optional<std::string> roof_field = {};     ///< elevation of the roof
  std::optional<double> default_height_m = {};    ///< for footprints without any height
};

}  // namespace farlod::ingest
