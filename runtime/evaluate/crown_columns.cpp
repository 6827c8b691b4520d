// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/crown_columns.hpp"

#include <algorithm>
#include <string>

#include "evaluate/canopy_answers.hpp"

namespace farlod {
namespace {

/// Both are sampled: crowns hide no more than the sky that there is.
float sky_behind(float svf, const CanopyAnswer& answer) { return std::clamp(answer.loss.sky, 0.0F, svf); }

}  // namespace

void describe_total(const Quantities& q, std::vector<ColumnDescription>& columns) {
  columns.push_back({"svf_total", "1", "sky view factor with what passes the crowns of trees and comes past them"});
  if (q.svf_total_bounds) {
    columns.push_back({"svf_total_low", "1", "lower bound of svf_total"});
    columns.push_back({"svf_total_high", "1", "upper bound of svf_total"});
  }
  columns.push_back({"svfveg", "1", "1 - the sky behind crowns, weighted as in svf"});
}

void add_total(const Quantities& q, float svf, const CanopyAnswer& answer, ValuesOfReceiver& values) {
  values.add(answer.svf_total.estimate);
  if (q.svf_total_bounds) {
    values.add(answer.svf_total.low);
    values.add(answer.svf_total.high);
  }
  values.add(1.0F - sky_behind(svf, answer));
}

void describe_svfaveg(const Quantities&, std::vector<ColumnDescription>& columns) {
  columns.push_back({"svfaveg", "1", "1 - the view of solid things that crowns hide, weighted as in svf"});
}

void add_svfaveg(const Quantities&, float, const CanopyAnswer& answer, ValuesOfReceiver& values) {
  values.add(1.0F - answer.loss.building);
}

void describe_directional_vegetation(const Quantities&, std::vector<ColumnDescription>& columns) {
  for (const std::string of : {"veg", "aveg"})
    for (const auto& [letter, half] : words_of_halves)
      columns.push_back({"svf" + (letter + of), "1", "svf" + of + " of the " + half + " half of the sky"});
}

void add_directional_vegetation(const Quantities&, float svf, const CanopyAnswer& answer, ValuesOfReceiver& values) {
  // What the answer knows better than the azimuths is not known by halves: each keeps its share of it
  const float share = answer.loss.sky > 0.0F ? sky_behind(svf, answer) / answer.loss.sky : 1.0F;
  for (const float half : answer.loss.sky_of_half) values.add(1.0F - share * half);
  for (const float half : answer.loss.building_of_half) values.add(1.0F - half);
}

void describe_shares(const Quantities&, std::vector<ColumnDescription>& columns) {
  columns.push_back({"share_sky", "1", "share of the view that is sky"});
  columns.push_back({"share_vegetation", "1", "share of the view that is crowns of trees"});
  columns.push_back({"share_building", "1", "share of the view that is neither sky nor crowns of trees"});
}

void add_shares(const Quantities&, float svf, const CanopyAnswer& answer, ValuesOfReceiver& values) {
  const float behind = sky_behind(svf, answer), sky = svf - behind;
  const float vegetation = behind + std::clamp(answer.loss.building, 0.0F, 1.0F - svf);
  values.add(sky);
  values.add(vegetation);
  values.add(1.0F - sky - vegetation);
}

}  // namespace farlod
