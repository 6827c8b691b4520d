// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plausibility/doubtful_trees.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "city/tree.hpp"

namespace farlod::plausibility {

void HeightsOfTrees::add(double height_m) {
  constexpr std::size_t most_kept = 65'536;
  if (count_++ % apart_ != 0) return;
  if (kept_m_.size() == most_kept) {
    for (std::size_t n = 0; 2 * n < most_kept; ++n) kept_m_[n] = kept_m_[2 * n];
    kept_m_.resize(most_kept / 2);
    apart_ *= 2;
  }
  kept_m_.push_back(static_cast<float>(height_m));
}

std::optional<std::string> HeightsOfTrees::doubt(const std::string& advice) const {
  constexpr std::size_t enough = 10;
  if (count_ < enough) return std::nullopt;
  std::vector<float> heights_m = kept_m_;
  const auto middle = heights_m.begin() + static_cast<std::ptrdiff_t>(heights_m.size() / 2);
  std::nth_element(heights_m.begin(), middle, heights_m.end());
  if (!(*middle > highest_tree_m)) return std::nullopt;
  return fmt::format(
      "half of its {} heights of trees are more than {:.0f} m, and no tree is higher than {:.0f} m: are they in centimetres, or "
      "elevations? {}",
      count_, *middle, highest_tree_m, advice);
}

}  // namespace farlod::plausibility
