// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "city/problem.hpp"
#include "city/source.hpp"
#include "georeference/crs.hpp"
#include "georeference/georeference.hpp"

namespace farlod::georeference {

/// A CRS as an input or an option names it.
struct NamedCrs {
  Crs crs;
  bool longitude_first = false;  ///< the name itself says so
};

/// Empty when nobody knows the definition.
[[nodiscard]] std::optional<NamedCrs> find_crs(const std::string& definition);

/// The CRS of `file`: what it says itself (`definition`), or `fallback` where it says nothing or nothing that is known.
/// Throws InputError when neither helps.
[[nodiscard]] NamedCrs crs_of_input(const std::string& file, const std::string& definition, const std::string& fallback);

/// The CRS that holds for an input, and what the user has to know of it.
struct InputCrs {
  NamedCrs named;
  std::optional<ProblemCode> problem = {};  ///< two_crs or crs_unknown
  std::string detail = {};                  ///< of the problem
  /// What the file says itself, where --crs overrules it, and the words for when it holds after all.
  struct Own {
    NamedCrs named;
    std::string detail;
  };
  std::optional<Own> own = {};
};

/// The CRS of each source, in order. The one of --crs (`settings.crs`)
///   (1) is that of sources that say none, and of those that name one which nobody knows
///   (2) overrules the others when every input says its own; else those keep theirs
///   (3) leaves the unit of heights to a source whose CRS is the same on the map, unless it says one itself
/// Throws InputError when a source is left without.
[[nodiscard]] std::vector<InputCrs> crs_of_inputs(std::span<const SourceCity> sources, const GeoreferenceSettings& settings);

}  // namespace farlod::georeference
