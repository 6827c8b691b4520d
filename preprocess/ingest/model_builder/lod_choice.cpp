// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/model_builder/lod_choice.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace farlod::ingest {
namespace {

bool is_wanted(double lod, LodChoice choice) {
  const double whole = std::floor(lod);
  return choice.exactly ? whole == static_cast<double>(*choice.exactly) : whole >= 1.0 && whole <= 3.0;
}

std::optional<double> best_of(const std::vector<double>& lods, LodChoice choice) {
  std::optional<double> best;
  for (const double lod : lods)
    if (is_wanted(lod, choice) && (!best || lod > *best)) best = lod;
  return best;
}

}  // namespace

std::vector<std::optional<double>> choose_lods(std::span<const std::vector<double>> lods_of_parts, LodChoice choice) {
  std::vector<std::optional<double>> chosen;
  for (const std::vector<double>& lods : lods_of_parts) chosen.push_back(best_of(lods, choice));
  const auto best = std::max_element(chosen.begin(), chosen.end());
  if (best == chosen.end() || !*best) return chosen;
  const double level = **best;
  for (std::size_t part = 0; part < chosen.size(); ++part) {
    const std::vector<double>& lods = lods_of_parts[part];
    if (std::find(lods.begin(), lods.end(), level) != lods.end())
      chosen[part] = level;
    else if (part == 0)
      chosen[part].reset();
  }
  return chosen;
}

std::string list_lods(std::span<const std::vector<double>> lods_of_parts) {
  std::set<double> all;
  for (const std::vector<double>& lods : lods_of_parts) all.insert(lods.begin(), lods.end());
  std::ostringstream text;
  for (const double lod : all) text << (lod == *all.begin() ? "" : ", ") << lod;
  return all.empty() ? "none" : text.str();
}

std::string unused_polygons(std::size_t count, std::span<const std::vector<double>> lods_of_parts) {
  return std::to_string(count) + " polygons of other levels are not used; it has LoD " + list_lods(lods_of_parts);
}

}  // namespace farlod::ingest
