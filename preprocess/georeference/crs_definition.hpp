// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace farlod::georeference {

/// What a file's name for its CRS means, in words that PROJ knows.
struct CrsDefinition {
  std::string for_proj;          ///< "EPSG:n", "EPSG:n+m", WKT, PROJJSON, a PROJ string of type crs, or a name to be looked up
  bool longitude_first = false;  ///< the name itself says so (CRS84), whatever for_proj says
  bool is_bare_name = false;     ///< for_proj is a name of the register, such as "ETRS89 / UTM zone 32N"
  bool operator==(const CrsDefinition&) const = default;
};

/// Reads codes ("EPSG:n", "epsg n", "n", "EPSG:n+m", "EPSG:n, EPSG:m", "ESRI:n"), OGC's URNs and URLs (single, compound, with and
/// without a version, those of old), CRS84, the names of the German surveys (urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH), PROJ
/// strings, WKT, PROJJSON, and bare names.
///   (1) every name of one code, or of one pair of codes, gives the same definition
///   (2) of an AdV name only the horizontal part counts: its heights are always metres
///   (3) WKT and PROJJSON are passed on as they are: whether they can be read is for PROJ to say
/// Empty for anything else. Says nothing on whether a code or a name exists.
[[nodiscard]] std::optional<CrsDefinition> parse_crs_definition(std::string_view text);

}  // namespace farlod::georeference
