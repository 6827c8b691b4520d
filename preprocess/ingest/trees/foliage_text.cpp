// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/trees/foliage_text.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "base/lower_case.hpp"

namespace farlod::ingest {
namespace {

/// Genera of which all or nearly all species in streets and parks are evergreen, and their English names, sorted.
constexpr std::array<std::string_view, 60> evergreen_words{
    "abies",         "acacia",        "agathis",    "araucaria",    "arbutus",     "buxus",
    "callistemon",   "callitris",     "casuarina",  "cedar",        "cedrus",      "ceratonia",
    "chamaecyparis", "cinnamomum",    "citrus",     "corymbia",     "cryptomeria", "cupressocyparis",
    "cupressus",     "cypress",       "eucalyptus", "fir",          "grevillea",   "hemlock",
    "holly",         "ilex",          "juniper",    "juniperus",    "laurus",      "livistona",
    "lophostemon",   "macadamia",     "melaleuca",  "metrosideros", "nerium",      "olea",
    "olive",         "palm",          "phoenix",    "photinia",     "picea",       "pine",
    "pinus",         "pittosporum",   "podocarpus", "pseudotsuga",  "sequoia",     "sequoiadendron",
    "spruce",        "syagrus",       "syzygium",   "taxus",        "thuja",       "thujopsis",
    "trachycarpus",  "tristaniopsis", "tsuga",      "washingtonia", "waterhousea", "yew"};
static_assert(std::is_sorted(evergreen_words.begin(), evergreen_words.end()));

/// Words of names of which another one would say evergreen ("bald cypress", "false acacia").
constexpr std::array<std::string_view, 7> deciduous_words{"bald", "dawn", "false", "larix", "metasequoia", "robinia", "taxodium"};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// Calls visit(word) for each word of Latin letters, in lower case.
template <class Visit>
void for_each_word(std::string_view text, const Visit& visit) {
  while (!text.empty()) {
    const auto begin = std::find_if(text.begin(), text.end(), is_letter);
    const auto end = std::find_if_not(begin, text.end(), is_letter);
    if (begin != end) visit(lower_case(std::string(begin, end)));
    text.remove_prefix(static_cast<std::size_t>(end - text.begin()));
  }
}

}  // namespace

Foliage foliage_of_species(std::string_view species) {
  bool is_evergreen = false, is_deciduous = false;
  for_each_word(species, [&](const std::string& word) {
    is_evergreen = is_evergreen || std::binary_search(evergreen_words.begin(), evergreen_words.end(), std::string_view(word));
    is_deciduous = is_deciduous ||
                   std::find(deciduous_words.begin(), deciduous_words.end(), std::string_view(word)) != deciduous_words.end();
  });
  return is_deciduous ? Foliage::deciduous : is_evergreen ? Foliage::evergreen : Foliage::unknown;
}

Foliage foliage_of_leaves(std::string_view leaves) {
  const std::string text = lower_case(std::string(leaves));
  if (text == "evergreen" || text == "needleleaved") return Foliage::evergreen;
  if (text == "deciduous" || text == "semi_deciduous") return Foliage::deciduous;
  return Foliage::unknown;
}

}  // namespace farlod::ingest
