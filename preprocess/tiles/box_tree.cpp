// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/box_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace farlod::tiles {

BoxTree::BoxTree(const std::vector<Box2d>& boxes) : order_(boxes.size()) {
  if (boxes.empty()) return;
  // Sort into strips from west to east, and each strip from south to north
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  const auto west = [&](std::size_t a, std::size_t b) { return boxes[a].low.x < boxes[b].low.x; };
  const auto south = [&](std::size_t a, std::size_t b) { return boxes[a].low.y < boxes[b].low.y; };
  std::stable_sort(order_.begin(), order_.end(), west);
  const auto strip = fan_out * static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(boxes.size()) / fan_out)));
  for (std::size_t k = 0; k < order_.size(); k += strip) {
    const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(k);
    std::stable_sort(begin, begin + static_cast<std::ptrdiff_t>(std::min(strip, order_.size() - k)), south);
  }
  for (const std::size_t number : order_) {
    if (levels_.empty()) levels_.emplace_back();
    levels_[0].push_back(boxes[number]);
  }
  while (levels_.back().size() > fan_out) {
    const std::vector<Box2d>& below = levels_.back();
    std::vector<Box2d> above((below.size() + fan_out - 1) / fan_out);
    for (std::size_t k = 0; k < below.size(); ++k) {
      above[k / fan_out].add(below[k].low);
      above[k / fan_out].add(below[k].high);
    }
    levels_.push_back(std::move(above));
  }
}

}  // namespace farlod::tiles
