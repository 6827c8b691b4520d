// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/footprints/said_heights.hpp"

#include <algorithm>
#include <optional>

#include "plausibility/doubtful_heights.hpp"

namespace farlod::ingest {

void SaidHeights::keep(const Field& field, const plausibility::SaidHeight& said, OfFields& heights) {
  constexpr std::size_t enough = 10'000;
  if (heights[field].size() < enough) heights[field].push_back(said);
}

void SaidHeights::require_no_elevations(const std::string& source, const std::vector<std::string>& names) const {
  for (const auto& [field, heights] : said_)
    if (field.second == HeightSource::measured) plausibility::require_heights(source, names[field.first], heights);
}

std::vector<std::string> SaidHeights::doubts(const std::vector<std::string>& names, double floor_height_m) const {
  OfFields all = said_;
  for (const auto& [field, heights] : too_high_) {
    // One number that many have means unknown
    const auto is_first = [first_m = heights.front().height_m](const plausibility::SaidHeight& h) {
      return h.height_m == first_m;
    };
    if (!std::all_of(heights.begin(), heights.end(), is_first))
      all[field].insert(all[field].end(), heights.begin(), heights.end());
  }
  std::vector<std::string> doubts;
  for (const auto& [field, heights] : all) {
    const std::string& name = names[field.first];
    const auto doubt = field.second == HeightSource::storeys ? plausibility::doubt_about_storeys(heights, name, floor_height_m)
                                                             : plausibility::doubt_about_heights(heights, name);
    if (doubt) doubts.push_back(name + " " + *doubt);
  }
  return doubts;
}

}  // namespace farlod::ingest
