// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "align/inputs_apart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "city/geometry.hpp"
#include "farlod/box.hpp"
#include "farlod/error.hpp"

namespace farlod::align {
namespace {

/// Towns that are nearer may see each other.
constexpr double far_apart_m = 5000.0;
/// Two places, on more cells than a machine should work on in vain.
constexpr double other_place_m = 100e3;
constexpr std::size_t too_many_cells = 1'000'000;
/// Cities have parks, and a grid that is turned has empty corners.
constexpr double nearly_all_empty = 0.9;

/// Where the inputs lie, and which cells have buildings.
struct Extents {
  std::vector<Box2d> of_input;  ///< grid frame
  std::vector<bool> is_built;   ///< of each cell
};

Extents extents_of(const LocatedCity& located, const Grid& grid) {
  Extents extents{std::vector<Box2d>(located.sources.size()), std::vector<bool>(static_cast<std::size_t>(grid.cells.size()))};
  located.city.for_each_building([&](std::size_t, const Building& b) {
    Box2d box;
    for (const Point3d& p_city : located.city.points_of(b)) box.add(grid.rotation.grid_from_city(horizontal(p_city)));
    if (box.empty() || b.source >= extents.of_input.size()) return;
    for (const Point2d corner : {box.low, box.high}) extents.of_input[b.source].add(corner);
    const Cell first = grid.cell_of(box.low), last = grid.cell_of(box.high);
    for (int j = first.j; j <= last.j; ++j)
      for (int i = first.i; i <= last.i; ++i) extents.is_built[grid.cells.index_of({i, j})] = true;
  });
  return extents;
}

/// The two inputs with the widest gap, of those that lie beside each other.
struct Gap {
  double width_m = 0.0;
  std::size_t from = 0, to = 0;
};

/// The longest side of the shortest tree that joins all boxes (Prim): what lies on both sides of it has nothing between.
Gap widest_gap(const std::vector<Box2d>& boxes) {
  std::vector<Gap> to_tree(boxes.size(), Gap{std::numeric_limits<double>::infinity(), 0, 0});
  std::vector<std::size_t> left;
  for (std::size_t n = 0; n < boxes.size(); ++n)
    if (!boxes[n].empty()) left.push_back(n);
  Gap widest;
  while (left.size() > 1) {
    const std::size_t joined = left.back();
    left.pop_back();
    for (const std::size_t n : left)
      if (const double width_m = distance_m(boxes[joined], boxes[n]); width_m < to_tree[n].width_m)
        to_tree[n] = {width_m, joined, n};
    const auto next = std::min_element(left.begin(), left.end(),
                                       [&](std::size_t a, std::size_t b) { return to_tree[a].width_m < to_tree[b].width_m; });
    if (to_tree[*next].width_m > widest.width_m) widest = to_tree[*next];
    std::swap(*next, left.back());
  }
  return widest;
}

}  // namespace

std::optional<std::string> inputs_apart(const LocatedCity& located, const Grid& grid) {
  if (located.sources.size() < 2) return std::nullopt;
  const Extents extents = extents_of(located, grid);
  const auto cells = static_cast<double>(extents.is_built.size());
  const double empty = static_cast<double>(std::count(extents.is_built.begin(), extents.is_built.end(), false)) / cells;
  if (empty < nearly_all_empty) return std::nullopt;
  const Gap gap = widest_gap(extents.of_input);
  if (gap.width_m < far_apart_m) return std::nullopt;
  const std::string apart = fmt::format("{} and {} lie {:.0f} km apart with nothing between them", located.sources[gap.from],
                                        located.sources[gap.to], gap.width_m / 1000.0);
  const std::string cells_text = fmt::format("{} % of {} cells", std::floor(100.0 * empty), extents.is_built.size());
  if (gap.width_m > other_place_m && extents.is_built.size() > too_many_cells)
    throw InputError(apart + ": " + cells_text + " would be empty. Give the files of one place, or check the CRS of each file.");
  return apart + ", and " + cells_text + " are empty: each is better packed on its own";
}

}  // namespace farlod::align
