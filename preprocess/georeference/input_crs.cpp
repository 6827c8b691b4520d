// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/input_crs.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <regex>
#include <utility>

#include "base/expects.hpp"
#include "farlod/error.hpp"

namespace farlod::georeference {
namespace {

constexpr auto ignoring_case = std::regex::ECMAScript | std::regex::icase;

std::string trimmed(std::string_view text) {
  const auto is_space = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  const auto first = std::find_if_not(text.begin(), text.end(), is_space);
  const auto last = std::find_if_not(text.rbegin(), std::make_reverse_iterator(first), is_space).base();
  return {first, last};
}

/// A reference to an entry of a register.
struct RegisterCode {
  std::string authority, code;
};

/// The register that a code belongs to. Codes of ESRI are often given as codes of EPSG, which end at 32767. EPSG:900913 is an
/// alias that PROJ knows.
std::string authority_of(const RegisterCode& given) {
  constexpr int last_of_epsg = 32767;
  constexpr std::string_view google = "900913";
  std::string authority = given.authority.empty() ? "EPSG" : given.authority;
  std::transform(authority.begin(), authority.end(), authority.begin(),
                 [](char c) { return static_cast<char>(std::toupper(static_cast<unsigned char>(c))); });
  const bool is_esri = authority == "EPSG" && given.code != google && std::stoi(given.code) > last_of_epsg;
  return is_esri ? "ESRI" : authority;
}

/// Whether a text can be a code: codes of EPSG are numbers, those of other registers may be words with a digit (LAMB93).
bool may_be_code(const RegisterCode& given) {
  static const std::regex number(R"(\d{4,7})"), word(R"([\w.-]*\d[\w.-]*)");
  static const std::regex epsg("(EPSG)?", ignoring_case);
  return std::regex_match(given.code, std::regex_match(given.authority, epsg) ? number : word);
}

/// From a horizontal code and, if there is a second one, a vertical code.
std::optional<CrsDefinition> definition_of(const std::vector<RegisterCode>& codes) {
  if (codes.empty() || codes.size() > 2 || !std::all_of(codes.begin(), codes.end(), may_be_code)) return std::nullopt;
  const std::string authority = authority_of(codes[0]);
  CrsDefinition definition{authority + ":" + codes[0].code};
  if (codes.size() == 1) return definition;
  const std::string of_heights = codes[1].authority.empty() ? "EPSG" : authority_of(codes[1]);
  definition.for_proj.append("+").append(of_heights == authority ? "" : of_heights + ":").append(codes[1].code);
  return definition;
}

/// Reads each of the parts of a text by a pattern whose groups are the authority and the code.
std::optional<CrsDefinition> parse_parts(const std::string& text, const std::regex& separator, const std::regex& part) {
  std::vector<RegisterCode> codes;
  if (!text.empty() && std::regex_match(text.substr(text.size() - 1), separator)) return std::nullopt;
  for (std::sregex_token_iterator it(text.begin(), text.end(), separator, -1), end; it != end; ++it) {
    const std::string one = trimmed(it->str());
    std::smatch found;
    if (!std::regex_match(one, found, part)) return std::nullopt;
    codes.push_back({found[1], found[2]});
  }
  return definition_of(codes);
}

/// "EPSG:n", "EPSG:n+m", "EPSG:n, EPSG:m", "EPSG::n", "epsg n", "n", "ESRI:n".
std::optional<CrsDefinition> parse_code(const std::string& text) {
  static const std::regex separator("[+,;]");
  static const std::regex part(R"((?:(\w+?)\s*::?\s*|EPSG[\s_]*)?([A-Za-z0-9._-]+))", ignoring_case);
  return parse_parts(text, separator, part);
}

/// "urn:ogc:def:crs:EPSG::n", "urn:ogc:def:crs,crs:EPSG:6.12:n,crs:EPSG:6.12:m".
std::optional<CrsDefinition> parse_urn(const std::string& text) {
  static const std::regex start(R"((?:urn:)?(?:x-)?(?:ogc|opengis):def:crs[:,])", ignoring_case);
  static const std::regex separator("[,+]");
  static const std::regex part(R"((?:(?:urn:)?(?:(?:x-)?ogc:def:)?crs:)?([A-Za-z]\w*):(?:[\d.]*:)?([\w.-]+))", ignoring_case);
  std::smatch found;
  if (!std::regex_search(text, found, start, std::regex_constants::match_continuous)) return std::nullopt;
  return parse_parts(found.suffix(), separator, part);
}

/// Replaces the three escape sequences that occur in a URL inside of a URL.
std::string unescaped(std::string text) {
  static const std::array<std::pair<std::regex, const char*>, 3> escapes{
      {{std::regex("%3A", ignoring_case), ":"}, {std::regex("%2F", ignoring_case), "/"}, {std::regex("&amp;"), "&"}}};
  for (const auto& [written, meant] : escapes) text = std::regex_replace(text, written, meant);
  return text;
}

/// ".../def/crs/EPSG/0/n", the old ".../gml/srs/epsg.xml#n", and pages of epsg.io and spatialreference.org.
std::optional<RegisterCode> code_of_url(const std::string& url) {
  static const std::regex single(R"(https?://(?:www\.)?opengis\.net/def/crs/([A-Za-z]\w*)/[\d.]+/([\w.-]+)/?)", ignoring_case);
  static const std::regex old_single(R"(https?://(?:www\.)?opengis\.net/gml/srs/(epsg)\.xml#(\d+))", ignoring_case);
  static const std::regex page(R"(https?://(?:www\.)?(epsg\.io|spatialreference\.org/ref/epsg)/(\d+)/?)", ignoring_case);
  std::smatch found;
  if (std::regex_match(url, found, single) || std::regex_match(url, found, old_single)) return RegisterCode{found[1], found[2]};
  if (std::regex_match(url, found, page)) return RegisterCode{"EPSG", found[2]};
  return std::nullopt;
}

/// A URL, or a URL with two others: ".../def/crs-compound?1=...&2=...".
std::optional<CrsDefinition> parse_url(const std::string& text) {
  static const std::regex compound(R"(https?://(?:www\.)?opengis\.net/def/crs-compound/?\?1=([^&]*)&2=([^&]*))", ignoring_case);
  const std::string url = unescaped(text);
  std::smatch found;
  if (!std::regex_match(url, found, compound)) {
    const auto code = code_of_url(url);
    return code ? definition_of({*code}) : std::nullopt;
  }
  const auto horizontal = code_of_url(found[1]), vertical = code_of_url(found[2]);
  return horizontal && vertical ? definition_of({*horizontal, *vertical}) : std::nullopt;
}

/// CRS84, CRS84h and CRS83 are geographic CRSs of EPSG with the longitude first.
std::optional<CrsDefinition> parse_longitude_first(const std::string& text) {
  static const std::regex form(
      R"((?:urn:(?:x-)?ogc:def:crs:OGC:[\d.]*:|https?://(?:www\.)?opengis\.net/def/crs/OGC/[\d.]+/|OGC:)?CRS(83|84h?))",
      ignoring_case);
  std::smatch found;
  if (!std::regex_match(text, found, form)) return std::nullopt;
  return CrsDefinition{found[1].str() == "83" ? "EPSG:4269" : "EPSG:4326", true};
}

/// "+7837" for "DE_DHHN2016_NH*GCG2016", the part behind the star; nothing where the register has no such system.
std::string heights_of_adv(const std::string& text) {
  static const std::array<std::pair<std::regex, const char*>, 5> names{{
      {std::regex(R"(DE_DHHN2016_NH(\*.*)?)", ignoring_case), "+7837"},
      {std::regex(R"(DE_DHHN92_NH(\*.*)?)", ignoring_case), "+5783"},
      {std::regex(R"(DE_DHHN85_(?:NOH|NN)(\*.*)?)", ignoring_case), "+5784"},
      {std::regex(R"(DE_DHHN12_NOH(\*.*)?)", ignoring_case), "+7699"},
      {std::regex(R"(DE_SNN76_NH(\*.*)?)", ignoring_case), "+5785"},
  }};
  for (const auto& [name, code] : names)
    if (std::regex_match(text, name)) return code;
  return {};
}

/// "urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH*GCG2016". The realisation of a federal state ("DE_DHDN_3GK2_NW101") has the EPSG code
/// of the national CRS.
std::optional<CrsDefinition> parse_adv(const std::string& text) {
  static const std::regex form(R"((?:urn:)?adv:crs:([^*]+)(?:\*(.*))?)", ignoring_case);
  static const std::regex utm(R"(ETRS89_UTM(2[89]|3[0-8]))", ignoring_case);
  static const std::array<std::pair<std::regex, const char*>, 13> names{{
      {std::regex("ETRS89_Lat-Lon", ignoring_case), "EPSG:4258"},
      {std::regex("ETRS89_Lat-Lon-h", ignoring_case), "EPSG:4937"},
      {std::regex("DE_DHDN_Lat-Lon", ignoring_case), "EPSG:4314"},
      {std::regex("DE_DHDN_3GK2(_.*)?", ignoring_case), "EPSG:31466"},
      {std::regex("DE_DHDN_3GK3(_.*)?", ignoring_case), "EPSG:31467"},
      {std::regex("DE_DHDN_3GK4(_.*)?", ignoring_case), "EPSG:31468"},
      {std::regex("DE_DHDN_3GK5(_.*)?", ignoring_case), "EPSG:31469"},
      {std::regex("DE_PD-83_3GK3", ignoring_case), "EPSG:3396"},
      {std::regex("DE_PD-83_3GK4", ignoring_case), "EPSG:3397"},
      {std::regex("DE_RD-83_3GK4", ignoring_case), "EPSG:3398"},
      {std::regex("DE_RD-83_3GK5", ignoring_case), "EPSG:3399"},
      {std::regex("DE_42-83_3GK4", ignoring_case), "EPSG:2398"},
      {std::regex("DE_42-83_3GK5", ignoring_case), "EPSG:2399"},
  }};
  std::smatch found, zone;
  if (!std::regex_match(text, found, form)) return std::nullopt;
  const std::string horizontal = found[1].str();
  const std::string heights = heights_of_adv(found[2].str());
  if (std::regex_match(horizontal, zone, utm)) return CrsDefinition{"EPSG:258" + zone[1].str() + heights};
  for (const auto& [name, code] : names)
    if (std::regex_match(horizontal, name)) return CrsDefinition{horizontal.ends_with("-h") ? code : code + heights};
  return std::nullopt;
}

/// PROJ reads a PROJ string as a CRS only if it contains `+type=crs`.
std::optional<CrsDefinition> parse_proj_string(const std::string& text) {
  if (!text.starts_with("+proj=") && !text.starts_with("+init=")) return std::nullopt;
  return CrsDefinition{text.find("+type=crs") == std::string::npos ? text + " +type=crs" : text};
}

/// A keyword and a bracket: PROJCS[…], GEOGCRS[…], BOUNDCRS[…]. No regular expression is used, since WKT can be long.
std::optional<CrsDefinition> parse_wkt(const std::string& text) {
  const auto bracket = text.find_first_of("[(");
  if (bracket == std::string::npos || bracket < 3 || (text.back() != ']' && text.back() != ')')) return std::nullopt;
  const bool is_keyword = std::all_of(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(bracket), [](char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_' || c == ' ';
  });
  return is_keyword ? std::optional(CrsDefinition{text}) : std::nullopt;
}

/// PROJ parses nested objects by recursion. A text that is nested deeper than any CRS must not get there.
bool nests_deeply(const std::string& text) {
  constexpr int deepest = 64;
  int depth = 0;
  for (const char c : text) {
    if (c == '{' || c == '[') ++depth;
    if (c == '}' || c == ']') --depth;
    if (depth > deepest) return true;
  }
  return false;
}

/// A JSON object whose type is a CRS: "type": "ProjectedCRS".
std::optional<CrsDefinition> parse_projjson(const std::string& text) {
  if (text.front() != '{' || text.back() != '}' || nests_deeply(text)) return std::nullopt;
  const bool is_crs = text.find("\"type\"") != std::string::npos && text.find("CRS\"") != std::string::npos;
  return is_crs ? std::optional(CrsDefinition{text}) : std::nullopt;
}

/// A name of words, as in the register. Addresses and names of other schemes are refused.
std::optional<CrsDefinition> parse_name(const std::string& text) {
  const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  const auto is_graphic = [](char c) { return static_cast<unsigned char>(c) >= ' '; };
  const bool has_letter = std::any_of(text.begin(), text.end(), is_letter);
  if (!has_letter || !std::all_of(text.begin(), text.end(), is_graphic)) return std::nullopt;
  if (text.find_first_of(":{}\"=#?%*") != std::string::npos) return std::nullopt;
  return CrsDefinition{text, false, true};
}

}  // namespace

std::optional<CrsDefinition> parse_crs_definition(std::string_view text) {
  const std::string definition = trimmed(text);
  if (definition.empty()) return std::nullopt;
  if (auto wkt = parse_wkt(definition)) return wkt;
  if (auto proj_string = parse_proj_string(definition)) return proj_string;
  if (auto projjson = parse_projjson(definition)) return projjson;
  // std::regex recurses for each character. Names are short; a long text is a broken WKT
  constexpr std::size_t longest_name = 500;
  if (definition.size() > longest_name) return std::nullopt;
  for (const auto parse : {parse_longitude_first, parse_adv, parse_urn, parse_url, parse_code, parse_name})
    if (auto found = parse(definition)) return found;
  return std::nullopt;
}

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
  // What is the same but for the heights may be given to say their zero
  if (mean_the_same(source, own, given)) return {given.crs.heights_name() && !own.crs.heights_name() ? given : own};
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

std::string note_of_city_crs(const std::string& file, std::size_t files, const Georeference& georeference) {
  const auto output = Crs::find(georeference.crs_wkt);
  FARLOD_EXPECTS(output.has_value());
  return file + (files > 1 ? ", one of " + std::to_string(files) + " files, has no CRS: those without one are" : " has no CRS:") +
         " taken to be in the city's, " + output->name() + " (--crs names another)";
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
