// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plausibility/stand_ins.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "city/city_model.hpp"

namespace farlod::plausibility {
namespace {

/// The numbers of rule (2) of take_out_stand_ins.
bool may_stand_in(float height_m) { return height_m == 0.0F || height_m == -1.0F; }

bool zero_stands_in(const std::vector<std::optional<float>>& heights_m, HeightsOf of) {
  const float least_gap_m = of == HeightsOf::ground ? 20.0F : 100.0F;
  float lowest_other_m = std::numeric_limits<float>::infinity();
  bool has_zero = false;
  for (const auto& height_m : heights_m) {
    if (!height_m || !may_be_elevation(*height_m)) continue;
    if (may_stand_in(*height_m))
      has_zero = true;
    else
      lowest_other_m = std::min(lowest_other_m, *height_m);
  }
  return has_zero && lowest_other_m >= least_gap_m && lowest_other_m <= highest_elevation_m;
}

}  // namespace

std::vector<StandIn> take_out_stand_ins(std::vector<std::optional<float>>& heights_m, HeightsOf of) {
  const bool without_zero = zero_stands_in(heights_m, of);
  std::map<float, StandIn> by_height;
  for (std::size_t n = 0; n < heights_m.size(); ++n) {
    auto& height_m = heights_m[n];
    if (!height_m || (may_be_elevation(*height_m) && !(without_zero && may_stand_in(*height_m)))) continue;
    ++by_height.try_emplace(*height_m, StandIn{*height_m, 0, n}).first->second.pixels;
    height_m.reset();
  }
  std::vector<StandIn> found;
  for (const auto& [height, stand_in] : by_height) found.push_back(stand_in);
  std::stable_sort(found.begin(), found.end(), [](const StandIn& a, const StandIn& b) { return a.pixels > b.pixels; });
  return found;
}

}  // namespace farlod::plausibility
