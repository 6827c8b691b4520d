// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

namespace farlod::georeference {

/// The entry of PROJ's registers with a name such as "ETRS89 / UTM zone 32N" or "Amersfoort / RD New + NAP height", as "EPSG:n"
/// or "EPSG:n+m". These names are found:
///   (1) names and aliases of the register, in upper or lower case
///   (2) the same letters and digits with other characters between them ("ETRS89_UTM_zone_32N", "WGS84 UTM 32N")
///   (3) a name without its datum ("RD New"), if only one name of the register ends with it
/// Empty when no entry has the name, or more than one.
[[nodiscard]] std::optional<std::string> code_of_crs_name(const std::string& name);

}  // namespace farlod::georeference
