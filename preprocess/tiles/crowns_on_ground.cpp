// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/crowns_on_ground.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/cancellation.hpp"
#include "city/geometry.hpp"
#include "plausibility/doubtful_trees.hpp"
#include "plausibility/elevations_as_heights.hpp"

namespace farlod::tiles {
namespace {

/// Lower than this above the ground, what a raster of elevations says is the ground itself.
constexpr double lowest_canopy_m = 0.5;
/// A height above the ground that is less is what is left of a 0 after resampling.
constexpr float least_height_m = 0.01F;
constexpr std::size_t trees_between_looks = 4096;

std::int64_t centimetres(double length_m) { return std::llround(100.0 * length_m); }

/// Strips of the plan, from west to east: trees beside each other come one after the other, and those at one place, too.
auto key_of(const Tree& t) {
  constexpr std::int64_t strip_cm = 5000;
  const std::int64_t x = centimetres(t.place.x), y = centimetres(t.place.y);
  const std::int64_t strip = y / strip_cm - (y % strip_cm < 0 ? 1 : 0);
  return std::tuple(strip, x, y, t.height_m, t.crown_diameter_m, t.trunk_height_m);
}

/// How many trees of each file something was met with, and where first.
class CountBySource {
 public:
  explicit CountBySource(const TreesOfCity& of_city) : entries_(of_city.sources.size()) {
    for (const Tree& tree : of_city.trees) ++entries_[tree.source].all;
  }

  void add(const Tree& tree) {
    Entry& entry = entries_[tree.source];
    if (entry.count++ == 0) entry.first = tree.place;
  }
  void tell(ProblemCode code, const std::string& what, const TreesOfCity& trees, Point2d origin_m, Report& report) const {
    for (std::size_t n = 0; n < entries_.size(); ++n) {
      const auto& [count, all, first] = entries_[n];
      if (count == 0) continue;
      const Point2d p = origin_m + first;
      report.add({code, trees.sources[n], "the whole file", std::to_string(count) + " of " + std::to_string(all) + what,
                  Point3d{p.x, p.y, 0.0}});
    }
  }

 private:
  struct Entry {
    std::uint64_t count = 0, all = 0;
    Point2d first;
  };
  std::vector<Entry> entries_;
};

/// Counts cells of a raster with something wrong.
struct CellCount {
  std::uint64_t count = 0;
  Point2d first_city;
  std::string first_detail;

  void add(Point2d p_city, const std::string& detail) {
    if (count++ > 0) return;
    first_city = p_city;
    first_detail = detail;
  }
  void tell(ProblemCode code, const std::string& source, Point2d origin_m, Report& report) const {
    if (count == 0) return;
    const std::string cells = std::to_string(count) + (count == 1 ? " cell: " : " cells, of which the first: ");
    const Point2d p = origin_m + first_city;
    report.add({code, source, "the whole file", cells + first_detail, Point3d{p.x, p.y, 0.0}});
  }
};

/// What a cell of a raster says above its ground.
class CellHeights {
 public:
  CellHeights(const CanopyRaster& canopy, const TreeSettings& settings) : canopy_(canopy), settings_(settings) {}

  /// Whether a value says that no crown is there, wherever the ground is.
  [[nodiscard]] bool is_none(double top_m) const {
    const bool is_elevation = settings_.heights == CanopyHeights::elevations;
    return !std::isfinite(top_m) || (is_elevation ? top_m == 0.0 : std::abs(top_m) < least_height_m);
  }

  /// Empty where no crown is.
  [[nodiscard]] std::optional<double> height_m(std::size_t n, double ground_m, Point2d p_city) {
    const double top_m = canopy_.top_m[n];
    const bool is_elevation = settings_.heights == CanopyHeights::elevations;
    if (is_none(top_m)) return std::nullopt;
    const double above_m = is_elevation ? top_m - ground_m : top_m;
    if (is_elevation && above_m < lowest_canopy_m) return std::nullopt;
    if (above_m > 0.0) heights.add(above_m);
    if (!is_elevation && above_m > 0.0) on_ground.add({above_m, ground_m});
    if (above_m > 0.0 && above_m <= highest_tree_m) return above_m;
    unusable.add(p_city, "a height of " + metres(above_m) + " above the ground");
    return std::nullopt;
  }

  /// Where a crown of that height begins.
  [[nodiscard]] double trunk_m(std::size_t n, double ground_m, double height_m, Point2d p_city) {
    const double usual_m = settings_.trunk_ratio * height_m;
    if (canopy_.trunk_m.empty()) return usual_m;
    const double stated_m = canopy_.trunk_m[n];
    if (!std::isfinite(stated_m)) {
      ++without_trunk;
      return usual_m;
    }
    const double trunk_m = settings_.heights == CanopyHeights::elevations ? stated_m - ground_m : stated_m;
    if (trunk_m >= 0.0 && trunk_m < height_m) return trunk_m;
    trunks.add(p_city, "a crown from " + metres(trunk_m) + " to " + metres(height_m) + " above the ground");
    return usual_m;
  }

  CellCount unusable, trunks;
  std::uint64_t without_trunk = 0;
  plausibility::HeightsOfTrees heights;
  plausibility::SomeOfMany<plausibility::HeightOnGround> on_ground;

 private:
  const CanopyRaster& canopy_;
  const TreeSettings& settings_;
};

/// Told where half of the cells are higher than any tree, as centimetres and elevations are.
bool report_tall(const CanopyRaster& canopy, const CellHeights& cells, Point2d origin_m, Report& report) {
  const auto doubt = cells.heights.doubt(
      "gdal_edit.py -scale 0.01 FILE says that they are centimetres, --canopy-absolute that they are elevations");
  if (!doubt) return false;
  const Point2d p = origin_m + cells.unusable.first_city;
  report.add({ProblemCode::implausible_size, canopy.source, "the whole file", *doubt, Point3d{p.x, p.y, 0.0}});
  return true;
}

/// Told where no crown is lower than its ground is high: elevations that are lower than any tree.
void report_elevations(const CanopyRaster& canopy, const CellHeights& cells, Point2d origin_m, Report& report) {
  const auto found = plausibility::likely_elevations(cells.on_ground.kept());
  if (!found) return;
  const Point2d p = origin_m + canopy.centre(canopy.columns / 2, canopy.rows / 2);
  report.add({ProblemCode::implausible_size, canopy.source, "the whole file",
              fmt::format("nearly all of its heights of crowns, typically {:.1f} m, are larger than the elevation of their "
                          "ground, typically {:.1f} m, as those of no wood with low trees are: are they elevations, typically "
                          "{:.1f} m above the ground? --canopy-absolute says so",
                          found->height_m, found->ground_m, found->above_m),
              Point3d{p.x, p.y, 0.0}});
}

}  // namespace

void CrownPlacing::place_trees(TreesOfCity& of_city, const Ground& ground, CrownsOfCity& crowns, const std::stop_token& stop) {
  PagedArray<Tree>& trees = of_city.trees;
  const auto full_key = [](const Tree& t) { return std::tuple(key_of(t), t.source, t.place.x, t.place.y, t.foliage); };
  std::sort(trees.begin(), trees.end(), [&](const Tree& a, const Tree& b) { return full_key(a) < full_key(b); });
  CountBySource outside(of_city), twice(of_city);
  const Point2d axis_grid = grid_.rotation.grid_from_city(Point2d{1.0, 0.0});
  const double turn_rad = std::atan2(axis_grid.y, axis_grid.x);
  for (std::size_t n = 0; n < trees.size(); ++n) {
    const Tree& tree = trees[n];
    if (n % trees_between_looks == 0) throw_if_cancelled(stop);
    const Point2d p_grid = grid_.rotation.grid_from_city(tree.place);
    if (!holds(grid_, p_grid)) {
      outside.add(tree);
    } else if (n > 0 && key_of(tree) == key_of(trees[n - 1])) {
      twice.add(tree);
    } else {
      const double foot_m = ground.height_at(p_grid);
      crowns.add(p_grid, foot_m + double{tree.trunk_height_m}, foot_m + double{tree.height_m},
                 0.5 * double{tree.crown_diameter_m}, tree.shape, tree.foliage, turn_rad);
      ++counts_.of_trees;
    }
  }
  outside.tell(ProblemCode::tree_outside_of_grid, " trees stand outside of the grid: check the CRS, if they should not", of_city,
               origin_m_, report_);
  twice.tell(ProblemCode::duplicate_tree, " trees have the place and the sizes of another one", of_city, origin_m_, report_);
}

void CrownPlacing::place_canopy(const CanopyRaster& canopy, const Ground& ground, CrownsOfCity& crowns,
                                const std::stop_token& stop) {
  const Point2d along_row = grid_.rotation.grid_from_city(canopy.column_step);
  const double turn_rad = std::atan2(along_row.y, along_row.x), half_width_m = 0.5 * norm(along_row);
  CellHeights cells(canopy, settings_);
  for (std::size_t row = 0; row < canopy.rows; ++row) {
    throw_if_cancelled(stop);
    for (std::size_t column = 0; column < canopy.columns; ++column) {
      const std::size_t n = row * canopy.columns + column;
      if (cells.is_none(canopy.top_m[n])) continue;
      const Point2d p_city = canopy.centre(column, row), p_grid = grid_.rotation.grid_from_city(p_city);
      if (!holds(grid_, p_grid)) continue;
      const double foot_m = ground.height_at(p_grid);
      const auto height_m = cells.height_m(n, foot_m, p_city);
      if (!height_m) continue;
      const double bottom_m = foot_m + cells.trunk_m(n, foot_m, *height_m, p_city);
      crowns.add(p_grid, bottom_m, foot_m + *height_m, half_width_m, CrownShape::prism, Foliage::unknown, turn_rad);
      ++counts_.of_canopy;
    }
  }
  if (!report_tall(canopy, cells, origin_m_, report_)) report_elevations(canopy, cells, origin_m_, report_);
  cells.unusable.tell(ProblemCode::unusable_canopy_height, canopy.source, origin_m_, report_);
  if (cells.without_trunk > 0)
    notes_.push_back(canopy.source + ": " + std::to_string(cells.without_trunk) +
                     " cells have crowns, and no height in the raster of trunks: they begin at the usual share of their heights");
  cells.trunks.tell(ProblemCode::trunk_above_crown, canopy.source, origin_m_, report_);
}

CrownsOfCity CrownPlacing::run(TreesOfCity trees, const Ground& ground, double height_origin_m, const std::stop_token& stop) {
  CrownsOfCity crowns(grid_, height_origin_m);
  place_trees(trees, ground, crowns, stop);
  trees.trees = {};
  if (trees.canopy) place_canopy(*trees.canopy, ground, crowns, stop);
  return crowns;
}

}  // namespace farlod::tiles
