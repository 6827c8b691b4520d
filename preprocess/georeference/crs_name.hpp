// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

namespace farlod::georeference {

/// The entry of PROJ's registers that a bare name means, as "EPSG:n" or "EPSG:n+m": "ETRS89 / UTM zone 32N",
/// "Amersfoort / RD New + NAP height".
///   (1) names and aliases of the register, whatever the case
///   (2) the same letters and digits with other signs between them ("ETRS89_UTM_zone_32N", "WGS84 UTM 32N")
///   (3) a name without its datum ("RD New"), when only one ends so
/// Empty when no entry is meant, or more than one.
[[nodiscard]] std::optional<std::string> code_of_crs_name(const std::string& name);

}  // namespace farlod::georeference
