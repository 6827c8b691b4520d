// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

namespace farlod::ingest {

/// How high footprints are: names of attributes, and what holds where a feature has none.
struct FootprintSettings {
  std::optional<std::string> height_field = {};   ///< height above the base
  std::optional<std::string> base_field = {};     ///< elevation of the base
  std::optional<std::string> storeys_field = {};  ///< number of storeys
  double floor_height_m = 3.0;                    ///< of a storey, for footprints that only say how many they have
  std::optional<std::string> roof_field = {};     ///< elevation of the roof
  std::optional<double> default_height_m = {};    ///< of footprints without a height of their own
};

}  // namespace farlod::ingest
