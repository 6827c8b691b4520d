// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <proj.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <regex>
#include <span>
#include <utility>
#include <vector>

#include "georeference/crs.hpp"
#include "georeference/objects_proj.hpp"

namespace farlod::georeference {
namespace {

constexpr PJ_TYPE horizontal_types[] = {PJ_TYPE_GEOGRAPHIC_2D_CRS, PJ_TYPE_PROJECTED_CRS};
constexpr PJ_TYPE all_types[] = {PJ_TYPE_GEOGRAPHIC_2D_CRS, PJ_TYPE_PROJECTED_CRS, PJ_TYPE_GEOGRAPHIC_3D_CRS,
                                 PJ_TYPE_COMPOUND_CRS};
constexpr PJ_TYPE vertical_types[] = {PJ_TYPE_VERTICAL_CRS};

struct Entry {
  std::string name, code;
};

enum class Search { exact, approximate };

/// The entries whose name or alias is the text, or contains its words.
std::vector<Entry> search(const std::string& text, std::span<const PJ_TYPE> types, Search kind) {
  constexpr std::size_t most = 100;
  const Owned<PJ_CONTEXT> context = make_context();
  const Owned<PJ_OBJ_LIST> found(proj_create_from_name(context.get(), nullptr, text.c_str(), types.data(), types.size(),
                                                       kind == Search::approximate ? 1 : 0, most, nullptr));
  std::vector<Entry> entries;
  for (int n = 0; found && n < proj_list_get_count(found.get()); ++n) {
    const Owned<PJ> entry(proj_list_get(context.get(), found.get(), n));
    entries.push_back({proj_get_name(entry.get()),
                       std::string(proj_get_id_auth_name(entry.get(), 0)) + ":" + proj_get_id_code(entry.get(), 0)});
  }
  return entries;
}

/// The letters and digits of a name, in lower case.
std::string letters_of(const std::string& name) {
  std::string letters;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      letters.push_back(static_cast<char>(std::tolower(static_cast<unsigned char>(c))));
  return letters;
}

/// A name in the spelling of the register: "WGS84 UTM 32N" becomes "WGS84 / UTM zone 32N".
std::string with_usual_utm(const std::string& name) {
  static const std::regex utm(R"((.*?)[\s/_]+UTM[\s_]*(?:zone)?[\s_]*(\d{1,2})[\s_]*([NS]))",
                              std::regex::ECMAScript | std::regex::icase);
  static const std::regex wgs84(R"(WGS[\s_]?(?:19)?84)", std::regex::ECMAScript | std::regex::icase);
  std::smatch found;
  if (!std::regex_match(name, found, utm)) return name;
  const std::string datum = std::regex_replace(found[1].str(), wgs84, "WGS 84");
  return datum + " / UTM zone " + std::to_string(std::stoi(found[2])) + found[3].str();
}

/// The code of the entries if all have the same name. Geographic CRSs in two and three dimensions share their name.
std::optional<std::string> code_of_only_name(const std::vector<Entry>& entries) {
  const auto differs = [&](const Entry& e) { return e.name != entries.front().name; };
  if (entries.empty() || std::any_of(entries.begin(), entries.end(), differs)) return std::nullopt;
  return entries.front().code;
}

std::optional<std::string> code_in(std::span<const PJ_TYPE> types, const std::string& name) {
  if (auto exact = code_of_only_name(search(name, types, Search::exact))) return exact;
  const std::string letters = letters_of(name);
  constexpr std::size_t least_letters = 5;  // fewer occur in too many names
  if (letters.size() < least_letters) return std::nullopt;
  std::vector<Entry> same, ending;
  for (Entry& entry : search(name, types, Search::approximate)) {
    const std::string other = letters_of(entry.name);
    if (other.ends_with(letters)) (other == letters ? same : ending).push_back(std::move(entry));
  }
  return code_of_only_name(same.empty() ? ending : same);
}

}  // namespace

std::optional<std::string> code_of_crs_name(const std::string& name) {
  if (auto exact = code_of_only_name(search(name, all_types, Search::exact))) return exact;
  const std::string usual = with_usual_utm(name);
  const auto plus = usual.rfind(" + ");
  if (plus == std::string::npos) return code_in(horizontal_types, usual);
  const auto horizontal = code_in(horizontal_types, with_usual_utm(usual.substr(0, plus)));
  const auto vertical = code_in(vertical_types, usual.substr(plus + 3));
  return horizontal && vertical ? std::optional(*horizontal + "+" + *vertical) : std::nullopt;
}

}  // namespace farlod::georeference
