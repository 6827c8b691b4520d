// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/crs_definition.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <regex>
#include <utility>

namespace farlod {
namespace {

constexpr auto ignoring_case = std::regex::ECMAScript | std::regex::icase;

std::string trimmed(std::string_view text) {
  const auto is_space = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  const auto first = std::find_if_not(text.begin(), text.end(), is_space);
  const auto last = std::find_if_not(text.rbegin(), std::make_reverse_iterator(first), is_space).base();
  return {first, last};
}

/// A horizontal code and, unless it is empty, a vertical one.
CrsDefinition definition_of(const std::string& code, const std::string& vertical_code) {
  CrsDefinition definition{"EPSG:"};
  definition.for_proj.append(code);
  if (!vertical_code.empty()) definition.for_proj.append("+").append(vertical_code);
  return definition;
}

/// "EPSG:n", "EPSG:n+m", "EPSG::n".
std::optional<CrsDefinition> parse_code(const std::string& text) {
  static const std::regex form(R"(EPSG::?(\d+)(?:\+(?:EPSG::?)?(\d+))?)", ignoring_case);
  std::smatch found;
  if (!std::regex_match(text, found, form)) return std::nullopt;
  return definition_of(found[1], found[2]);
}

/// "urn:ogc:def:crs:EPSG::n", "urn:ogc:def:crs,crs:EPSG:6.12:n,crs:EPSG:6.12:m".
std::optional<CrsDefinition> parse_urn(const std::string& text) {
  static const std::regex form(
      R"((?:urn:)?(?:x-)?ogc:def:crs[:,](?:crs:)?EPSG:(?:[\d.]*:)?(\d+)(?:,(?:crs:)?EPSG:(?:[\d.]*:)?(\d+))?)", ignoring_case);
  std::smatch found;
  if (!std::regex_match(text, found, form)) return std::nullopt;
  return definition_of(found[1], found[2]);
}

/// "http://www.opengis.net/def/crs/EPSG/0/n", ".../def/crs-compound?1=...&2=...", and the old ".../gml/srs/epsg.xml#n".
std::optional<CrsDefinition> parse_url(const std::string& text) {
  static const std::regex single(R"(https?://(?:www\.)?opengis\.net/def/crs/EPSG/[\d.]+/(\d+)/?)", ignoring_case);
  static const std::regex old_single(R"(https?://(?:www\.)?opengis\.net/gml/srs/epsg\.xml#(\d+))", ignoring_case);
  static const std::regex compound(
      R"(https?://(?:www\.)?opengis\.net/def/crs-compound\?1=[^&]*/EPSG/[\d.]+/(\d+)&2=[^&]*/EPSG/[\d.]+/(\d+))", ignoring_case);
  std::smatch found;
  if (std::regex_match(text, found, compound)) return definition_of(found[1], found[2]);
  if (std::regex_match(text, found, single) || std::regex_match(text, found, old_single)) return definition_of(found[1], {});
  return std::nullopt;
}

/// CRS84 and its kin are EPSG's geographic CRSs with the longitude first.
std::optional<CrsDefinition> parse_longitude_first(const std::string& text) {
  static const std::regex form(
      R"((?:urn:(?:x-)?ogc:def:crs:OGC:[\d.]*:|https?://(?:www\.)?opengis\.net/def/crs/OGC/[\d.]+/|OGC:)?CRS(83|84h?))",
      ignoring_case);
  std::smatch found;
  if (!std::regex_match(text, found, form)) return std::nullopt;
  return CrsDefinition{found[1].str() == "83" ? "EPSG:4269" : "EPSG:4326", true};
}

/// "urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH*GCG2016". A Land's own realisation ("DE_DHDN_3GK2_NW101") is the same CRS to EPSG.
std::optional<CrsDefinition> parse_adv(const std::string& text) {
  static const std::regex form(R"((?:urn:)?adv:crs:([^*]+)(?:\*.*)?)", ignoring_case);
  static const std::array<std::pair<std::regex, const char*>, 9> names{{
      {std::regex("ETRS89_UTM31", ignoring_case), "EPSG:25831"},
      {std::regex("ETRS89_UTM32", ignoring_case), "EPSG:25832"},
      {std::regex("ETRS89_UTM33", ignoring_case), "EPSG:25833"},
      {std::regex("ETRS89_Lat-Lon", ignoring_case), "EPSG:4258"},
      {std::regex("ETRS89_Lat-Lon-h", ignoring_case), "EPSG:4937"},
      {std::regex("DE_DHDN_3GK2(_.*)?", ignoring_case), "EPSG:31466"},
      {std::regex("DE_DHDN_3GK3(_.*)?", ignoring_case), "EPSG:31467"},
      {std::regex("DE_DHDN_3GK4(_.*)?", ignoring_case), "EPSG:31468"},
      {std::regex("DE_DHDN_3GK5(_.*)?", ignoring_case), "EPSG:31469"},
  }};
  std::smatch found;
  if (!std::regex_match(text, found, form)) return std::nullopt;
  const std::string horizontal = found[1].str();
  for (const auto& [name, code] : names)
    if (std::regex_match(horizontal, name)) return CrsDefinition{code};
  return std::nullopt;
}

/// PROJ takes a string for a CRS only when it says that it is one.
std::optional<CrsDefinition> parse_proj_string(const std::string& text) {
  if (!text.starts_with("+proj=") && !text.starts_with("+init=")) return std::nullopt;
  return CrsDefinition{text.find("+type=crs") == std::string::npos ? text + " +type=crs" : text};
}

/// A keyword and a bracket: PROJCS[…], GEOGCRS[…], BOUNDCRS[…]. Not by a regular expression: WKT can be long.
std::optional<CrsDefinition> parse_wkt(const std::string& text) {
  const auto bracket = text.find_first_of("[(");
  if (bracket == std::string::npos || bracket < 3 || (text.back() != ']' && text.back() != ')')) return std::nullopt;
  const bool is_keyword = std::all_of(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(bracket), [](char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_' || c == ' ';
  });
  return is_keyword ? std::optional(CrsDefinition{text}) : std::nullopt;
}

}  // namespace

std::optional<CrsDefinition> parse_crs_definition(std::string_view text) {
  const std::string definition = trimmed(text);
  if (definition.empty()) return std::nullopt;
  if (auto wkt = parse_wkt(definition)) return wkt;
  if (auto proj_string = parse_proj_string(definition)) return proj_string;
  // Names are short, and std::regex recurses for each character: do not show it a broken WKT
  constexpr std::size_t longest_name = 500;
  if (definition.size() > longest_name) return std::nullopt;
  for (const auto parse : {parse_code, parse_urn, parse_url, parse_longitude_first, parse_adv})
    if (auto found = parse(definition)) return found;
  return std::nullopt;
}

}  // namespace farlod
