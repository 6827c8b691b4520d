// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "city/tree.hpp"
#include "farlod/pack.hpp"
#include "farlod/problem.hpp"
#include "package/crowns_of_city.hpp"
#include "tiles/ground.hpp"

namespace farlod::tiles {

/// The trees of a city, in the city frame.
struct TreesOfCity {
  std::vector<std::string> sources;  ///< names of the inventories, by Tree::source
  PagedArray<Tree> trees;
  std::optional<CanopyRaster> canopy;

  [[nodiscard]] bool any() const { return !trees.empty() || canopy.has_value(); }
};

/// Puts the crowns of a city on its ground.
///   (1) a tree of an inventory is a spheroid from its trunk's height above the ground at its place to its own; a square of a
///       plant cover is a prism along the axes of the city frame
///   (2) a cell of the canopy's raster whose top is above the ground there is a square prism of its size, turned as it is
///   (3) where the raster of trunks knows nothing, or nothing below the top, a crown begins at the share of its height that the
///       settings say
///   (4) a tree that is there twice, at one centimetre and with the same sizes, counts once; one outside of the grid does not;
///       both are reported, an entry for each file
///   (5) a tree within a building stays: what of it is inside is hidden by the walls, and what is above the roof shades it
///   (6) the result does not depend on the order of trees and files
/// Positions of problems are in the CRS of the package. Throws Cancelled.
class CrownPlacing {
 public:
  /// `origin_m`: of the city frame.
  CrownPlacing(const TreeSettings& settings, const Grid& grid, Point2d origin_m, Report& report)
      : settings_(settings), grid_(grid), origin_m_(origin_m), report_(report) {}

  [[nodiscard]] CrownsOfCity run(TreesOfCity trees, const Ground& ground, double height_origin_m, const std::stop_token& stop);
  [[nodiscard]] const CrownCounts& counts() const { return counts_; }
  /// For the user.
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

 private:
  void place_trees(TreesOfCity& of_city, const Ground& ground, CrownsOfCity& crowns, const std::stop_token& stop);
  void place_canopy(const CanopyRaster& canopy, const Ground& ground, CrownsOfCity& crowns, const std::stop_token& stop);

  const TreeSettings& settings_;
  const Grid& grid_;
  Point2d origin_m_;
  Report& report_;
  CrownCounts counts_;
  std::vector<std::string> notes_;
};

}  // namespace farlod::tiles
