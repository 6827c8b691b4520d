// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "city/plan_boxes.hpp"
#include "farlod/box.hpp"

namespace farlod::tiles {

/// Finds the boxes that meet a box, without looking at all of them: a packed R-tree (Leutenegger et al. 1997).
class BoxTree {
 public:
  explicit BoxTree(const std::vector<Box2d>& boxes);

  /// Calls visit(number) for each box that shares a point with `box`, in no order that means anything.
  template <class Visit>
  void for_each_meeting(const Box2d& box, const Visit& visit) const {
    if (!levels_.empty()) descend(levels_.size() - 1, 0, levels_.back().size(), box, visit);
  }

 private:
  static constexpr std::size_t fan_out = 8;

  template <class Visit>
  void descend(std::size_t level, std::size_t begin, std::size_t end, const Box2d& box, const Visit& visit) const {
    for (std::size_t k = begin; k < end; ++k) {
      if (!boxes_meet(levels_[level][k], box)) continue;
      if (level == 0)
        visit(order_[k]);
      else
        descend(level - 1, fan_out * k, std::min(fan_out * (k + 1), levels_[level - 1].size()), box, visit);
    }
  }

  std::vector<std::size_t> order_;          ///< the numbers of the boxes in levels_[0]
  std::vector<std::vector<Box2d>> levels_;  ///< the boxes, and boxes around `fan_out` of the level below
};

}  // namespace farlod::tiles
