// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/input_crs.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "farlod/error.hpp"
#include "georeference/crs_definition.hpp"
#include "georeference/crs_name.hpp"

namespace farlod::georeference {
namespace {

using Found = std::optional<NamedCrs>;

/// The beginning of a definition, for messages: WKT is long.
std::string shortened(const std::string& definition) {
  constexpr std::size_t longest = 80;
  return definition.size() > longest ? definition.substr(0, longest) + "..." : definition;
}

/// "EPSG:4326 (WGS 84), longitude first".
std::string label_of(const NamedCrs& named) {
  const auto code = named.crs.epsg();
  const std::string name = named.crs.name();
  return (code ? "EPSG:" + std::to_string(*code) + " (" + name + ")" : name) + (named.longitude_first ? ", longitude first" : "");
}

/// The CRS that each source defines. Each distinct definition is looked up once: it takes milliseconds, and a city may have
/// hundreds of tiles.
std::vector<Found> find_own(std::span<const SourceCity> sources) {
  std::map<std::string, Found> known;
  std::vector<Found> own;
  for (const SourceCity& source : sources) {
    const std::string& definition = source.crs.definition;
    if (!known.contains(definition)) known.emplace(definition, find_crs(definition));
    own.push_back(known.at(definition));
  }
  return own;
}

[[noreturn]] void throw_unknown(const std::string& given, const std::string& file) {
  throw InputError("--crs " + given + ", for " + file + ": no such CRS is known: give EPSG:n");
}

/// Whether the longitude comes first, by the format of the file or by the definition.
bool has_longitude_first(const SourceCity& source, const NamedCrs& named) {
  return source.crs.longitude_first || named.longitude_first;
}

bool mean_the_same(const SourceCity& source, const NamedCrs& own, const NamedCrs& given) {
  const bool same_order = has_longitude_first(source, own) == has_longitude_first(source, given) || own.crs.is_projected();
  const bool same_heights = !given.crs.says_height_unit() || own.crs.height_unit_m() == given.crs.height_unit_m();
  return own.crs.equals(given.crs) && same_order && same_heights;
}

InputCrs overruled(const SourceCity& source, const NamedCrs& own, const NamedCrs& given) {
  if (mean_the_same(source, own, given)) return {own};
  const std::string file_says = "the file says " + label_of(own), option_says = "--crs says " + label_of(given);
  return {given, ProblemCode::two_crs, file_says + "; " + option_says + ", which is used",
          InputCrs::Own{own, file_says + ", which is used; " + option_says + ", but its coordinates cannot be in that"}};
}

/// The CRS of --crs for a source without a CRS or with an unknown one.
InputCrs fallback_for(const SourceCity& source, const Found& given, const std::string& given_text) {
  const std::string& own = source.crs.definition;
  InputCrs input{given ? *given : crs_of_input(source.source, own, given_text)};
  if (own.empty()) return input;
  input.problem = ProblemCode::crs_unknown;
  input.detail = "the CRS \"" + shortened(own) + "\" is unknown; that of --crs is used, " + label_of(input.named);
  return input;
}

}  // namespace

std::optional<NamedCrs> find_crs(const std::string& definition) {
  const auto parsed = parse_crs_definition(definition);
  if (!parsed) return std::nullopt;
  const auto for_proj = parsed->is_bare_name ? code_of_crs_name(parsed->for_proj) : parsed->for_proj;
  const auto crs = for_proj ? Crs::find(*for_proj) : std::nullopt;
  return crs ? std::optional(NamedCrs{*crs, parsed->longitude_first}) : std::nullopt;
}

NamedCrs crs_of_input(const std::string& file, const std::string& definition, const std::string& fallback) {
  if (auto own = find_crs(definition)) return *own;
  if (fallback.empty() && definition.empty()) throw InputError(file + " does not say its CRS: give --crs EPSG:n");
  if (fallback.empty())
    throw InputError(file + " names a CRS that is not known, \"" + shortened(definition) + "\": give --crs EPSG:n");
  if (auto given = find_crs(fallback)) return *given;
  throw_unknown(fallback, file);
}

std::vector<InputCrs> crs_of_inputs(std::span<const SourceCity> sources, const GeoreferenceSettings& settings) {
  const std::vector<Found> own = find_own(sources);
  const bool all_say = std::all_of(own.begin(), own.end(), [](const Found& found) { return found.has_value(); });
  const bool overrules = all_say && !settings.crs.empty() && !settings.crs_is_for_another;
  const Found given = all_say && !overrules ? std::nullopt : find_crs(settings.crs);
  if (overrules && !given && !sources.empty()) throw_unknown(settings.crs, sources.front().source);
  std::vector<InputCrs> inputs;
  for (std::size_t n = 0; n < sources.size(); ++n) {
    if (!own[n])
      inputs.push_back(fallback_for(sources[n], given, settings.crs));
    else if (overrules)
      inputs.push_back(overruled(sources[n], *own[n], *given));
    else
      inputs.push_back({*own[n]});
  }
  return inputs;
}

}  // namespace farlod::georeference
