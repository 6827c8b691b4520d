// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace farlod::georeference {

/// The definition of a CRS in a file, in a form that PROJ can read.
struct CrsDefinition {
  std::string for_proj;          ///< "EPSG:n", "EPSG:n+m", WKT, PROJJSON, a PROJ string of type crs, or a name to look up
  bool longitude_first = false;  ///< the definition itself requires it (CRS84), even if for_proj has the other order
  bool is_bare_name = false;     ///< for_proj is a name of the register, such as "ETRS89 / UTM zone 32N"
  bool operator==(const CrsDefinition&) const = default;
};

/// Reads codes ("EPSG:n", "epsg n", "n", "EPSG:n+m", "EPSG:n, EPSG:m", "ESRI:n"), URNs and URLs of the OGC (single, compound,
/// with and without a version, old ones), CRS84, names of the German surveys (urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH), PROJ
/// strings, WKT, PROJJSON, and bare names.
///   (1) all forms of one code, or of one pair of codes, give the same definition
///   (2) of a name of the German surveys, only the horizontal part is used: its heights are always in metres
///   (3) WKT and PROJJSON are passed on as they are, and not checked
/// Empty for any other text. Does not check whether a code or a name exists.
[[nodiscard]] std::optional<CrsDefinition> parse_crs_definition(std::string_view text);

}  // namespace farlod::georeference
