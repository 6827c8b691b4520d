// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace farlod {

/// What a file's name for its CRS means, in words that PROJ knows.
struct CrsDefinition {
  std::string for_proj;          ///< "EPSG:n", "EPSG:n+m", WKT, or a PROJ string of type crs
  bool longitude_first = false;  ///< the name itself says so (CRS84), whatever for_proj says
  bool operator==(const CrsDefinition&) const = default;
};

/// Reads "EPSG:n", OGC URNs (single, compound, with and without a version), OGC URLs (single and compound), CRS84,
/// the names of the German surveys (urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH), PROJ strings and WKT.
///   (1) every name of one EPSG code, or of one pair of codes, gives the same definition
///   (2) of an AdV name only the horizontal part counts: its heights are always metres
///   (3) WKT is passed on as it is: whether it can be read is for PROJ to say
/// Empty for anything else. Says nothing on whether a code exists.
[[nodiscard]] std::optional<CrsDefinition> parse_crs_definition(std::string_view text);

}  // namespace farlod
