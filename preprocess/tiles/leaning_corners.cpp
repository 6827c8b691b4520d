// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/leaning_corners.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/ground_contact.hpp"
#include "tiles/solid_to_ground.hpp"

namespace farlod::tiles {
namespace {

bool is_between(Point2d v, Point2d f, Point2d g) {
  const double turn = across(f, g);
  return turn != 0.0 && across(f, v) * turn >= 0.0 && across(v, g) * turn >= 0.0;
}

}  // namespace

/// The distance of the lean from the cone of the facets' ways: no farther does it reach beyond any line that has all of them on
/// its other side (Farkas).
double LeaningCorner::stands_out_m() const {
  const Point2d lean = horizontal(segment.a - segment.b);
  double least_m = norm(lean);
  for (std::size_t n = 0; n < facets.size(); ++n) {
    const double run = norm(facets[n]);
    if (dot(lean, facets[n]) > 0.0) least_m = std::min(least_m, std::abs(across(lean, facets[n])) / run);
    for (std::size_t k = 0; k < n; ++k)
      if (is_between(lean, facets[n], facets[k])) return 0.0;
  }
  return least_m;
}

std::vector<LeaningCorner> leaning_corners(std::span<const EdgeSides> edges) {
  std::vector<LeaningCorner> corners;
  for (const EdgeSides& e : edges) {
    const auto& [a, b] = e.edge();
    const double run_m = norm(horizontal(b - a));
    if (run_m <= least_sliver_m || (run_m > contact_m && !e.counts_as_upright())) continue;
    corners.push_back({a.z > b.z ? Segment3d{a, b} : Segment3d{b, a}, {}});
  }
  return corners;
}

void add_facet(const std::array<Point3d, 3>& t, std::vector<LeaningCorner>& corners) {
  const auto has = [&](const Point3d& p) { return std::find(t.begin(), t.end(), p) != t.end(); };
  for (LeaningCorner& corner : corners) {
    const Point3d &top = corner.segment.a, &foot = corner.segment.b;
    if (!has(top) || !has(foot)) continue;
    const Point3d& third = *std::find_if(t.begin(), t.end(), [&](const Point3d& p) { return !(p == top) && !(p == foot); });
    const Point3d along = foot - top, to_third = third - top;
    if (along.z == 0.0) continue;
    const Point2d level = horizontal(to_third - (to_third.z / along.z) * along);
    if (norm(level) > least_sliver_m) corner.facets.push_back(level);
  }
}

Places ends_of(std::span<const HorizonSegment> borders) {
  Places ends(&comes_first);
  for (const HorizonSegment& border : borders) ends.insert({border.segment.a, border.segment.b});
  return ends;
}

std::vector<ClosingTriangle> closing_below(std::vector<LeaningCorner> corners, const Places& ends_of_grounded,
                                           const GroundHeightAt& ground_height) {
  // Where one ends, the next one below it goes on
  std::stable_sort(corners.begin(), corners.end(),
                   [](const LeaningCorner& c, const LeaningCorner& d) { return c.segment.a.z > d.segment.a.z; });
  Places feet(&comes_first);
  std::vector<ClosingTriangle> closing;
  for (const LeaningCorner& corner : corners) {
    const Point3d &top = corner.segment.a, &foot = corner.segment.b;
    if (!ends_of_grounded.contains(top) && !feet.contains(top)) continue;
    feet.insert(foot);
    if (corner.stands_out_m() <= least_sliver_m) continue;
    const double ground_m = std::min(ground_height(horizontal(top)), ground_height(horizontal(foot)));
    const double low_m = std::min(foot.z, ground_m);
    if (top.z <= ground_m + ground_contact_m) continue;
    const Point3d below_top{top.x, top.y, low_m}, below_foot{foot.x, foot.y, low_m};
    closing.push_back({top, foot, below_top});
    if (foot.z > ground_m + ground_contact_m) closing.push_back({foot, below_foot, below_top});
  }
  return closing;
}

}  // namespace farlod::tiles
