// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plausibility/doubtful_trees.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "city/tree.hpp"

namespace farlod::plausibility {

std::optional<std::string> HeightsOfTrees::doubt(const std::string& advice) const {
  constexpr std::size_t enough = 10;
  if (heights_m_.count() < enough) return std::nullopt;
  std::vector<float> heights_m = heights_m_.kept();
  const auto middle = heights_m.begin() + static_cast<std::ptrdiff_t>(heights_m.size() / 2);
  std::nth_element(heights_m.begin(), middle, heights_m.end());
  if (!(*middle > highest_tree_m)) return std::nullopt;
  return fmt::format(
      "half of its {} heights of trees are more than {:.0f} m, and no tree is higher than {:.0f} m: are they in centimetres, or "
      "elevations? {}",
      heights_m_.count(), *middle, highest_tree_m, advice);
}

}  // namespace farlod::plausibility
