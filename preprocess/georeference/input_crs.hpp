// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "city/city_model.hpp"
#include "farlod/problem.hpp"
#include "georeference/crs.hpp"
#include "georeference/georeference.hpp"

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

/// A CRS that an input or an option defines.
struct NamedCrs {
  Crs crs;
  bool longitude_first = false;  ///< by the definition, such as CRS84
};

/// Empty when the definition is unknown.
[[nodiscard]] std::optional<NamedCrs> find_crs(const std::string& definition);

/// The CRS of `file`: its own `definition`, or `fallback` where that is empty or unknown. Throws InputError when both are.
[[nodiscard]] NamedCrs crs_of_input(const std::string& file, const std::string& definition, const std::string& fallback);

/// What is said of an input, or the first of several, that has no CRS and is taken to be where the city is.
[[nodiscard]] std::string note_of_city_crs(const std::string& file, std::size_t files, const Georeference& georeference);

/// The CRS that is used for an input, and the problem to report about it.
struct InputCrs {
  NamedCrs named;
  std::optional<ProblemCode> problem = {};  ///< two_crs or crs_unknown
  std::string detail = {};                  ///< of the problem
  /// If --crs overrules the CRS of the file: the latter, and the detail of the problem if it is used after all.
  struct Own {
    NamedCrs named;
    std::string detail;
  };
  std::optional<Own> own = {};
};

/// The CRS of each source, in order.
///   (1) sources without a CRS, or with an unknown one, get that of --crs (`settings.crs`)
///   (2) if every input has a known CRS, that of --crs overrules all of them; otherwise these sources keep theirs
///   (3) a source whose CRS is horizontally the same keeps its unit of heights, unless --crs has a vertical axis
/// Throws InputError when a source has no CRS by these rules.
[[nodiscard]] std::vector<InputCrs> crs_of_inputs(std::span<const SourceCity> sources, const GeoreferenceSettings& settings);

}  // namespace farlod::georeference
