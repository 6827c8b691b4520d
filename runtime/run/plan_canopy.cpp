// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "base/cancellation.hpp"
#include "base/run_settings.hpp"
#include "farlod/plan_view.hpp"
#include "run/memory_limit.hpp"
#include "run/package_contents.hpp"
#include "run/usable_view.hpp"
#include "scene/canopy_around.hpp"

namespace farlod {
namespace {

/// The lowest and the highest place of a crown above or below a place of the plan, which lies so far from the crown's axis;
/// nothing where the crown does not reach.
std::optional<std::pair<double, double>> extent_of(const Crown& crown, Point2d from_axis) {
  const double half = crown.half_width_m, bottom = crown.bottom_m, top = crown.top_m;
  if (crown.shape == CrownShape::prism) {
    const double cosine = std::cos(crown.turn_rad()), sine = std::sin(crown.turn_rad());
    const double x = cosine * from_axis.x + sine * from_axis.y, y = cosine * from_axis.y - sine * from_axis.x;
    return std::max(std::abs(x), std::abs(y)) <= half ? std::optional(std::pair(bottom, top)) : std::nullopt;
  }
  const double share = norm(from_axis) / half;
  if (share > 1.0) return std::nullopt;
  if (crown.shape == CrownShape::cylinder) return std::pair(bottom, top);
  const double middle = 0.5 * (bottom + top), reach = 0.5 * (top - bottom) * std::sqrt(1.0 - share * share);
  return std::pair(middle - reach, middle + reach);
}

/// Takes crowns one by one.
class CanopyOfPlan {
 public:
  CanopyOfPlan(const package::Manifest& manifest, const RasterPlan& plan)
      : manifest_(manifest), plan_(plan), canopy_{no_crowns(plan), no_crowns(plan)} {}

  /// `corner_grid` is that of the crown's cell.
  void add(const Crown& crown, Point2d corner_grid) {
    const Point2d axis_grid{corner_grid.x + crown.x_m, corner_grid.y + crown.y_m};
    const Point2d axis = horizontal(manifest_.projected_from_grid({axis_grid.x, axis_grid.y, 0.0}));
    const double reach = reach_m(crown) / plan_.step_m;
    const double column = (axis.x - plan_.north_west_m.x) / plan_.step_m, row = (plan_.north_west_m.y - axis.y) / plan_.step_m;
    const auto [column_begin, column_end] = pixels_between(column - reach, column + reach, plan_.columns);
    const auto [row_begin, row_end] = pixels_between(row - reach, row + reach, plan_.rows);
    for (std::size_t r = row_begin; r < row_end; ++r)
      for (std::size_t c = column_begin; c < column_end; ++c)
        if (const auto extent = extent_of(crown, manifest_.grid_from_projected(plan_.centre_m(c, r)) - axis_grid))
          add(r * plan_.columns + c, *extent);
  }
  [[nodiscard]] PlanCanopy take() { return std::move(canopy_); }

 private:
  static std::vector<float> no_crowns(const RasterPlan& plan) {
    return std::vector<float>(plan.columns * plan.rows, std::numeric_limits<float>::quiet_NaN());
  }
  /// Pixels that lie between two places along an axis, and perhaps one more.
  static std::pair<std::size_t, std::size_t> pixels_between(double from, double to, std::size_t count) {
    const auto within = [count](double x) { return static_cast<std::size_t>(std::clamp(x, 0.0, static_cast<double>(count))); };
    return {within(std::floor(from)), within(std::ceil(to))};
  }
  void add(std::size_t pixel, std::pair<double, double> extent) {
    const auto bottom = static_cast<float>(extent.first + manifest_.height_origin_m);
    const auto top = static_cast<float>(extent.second + manifest_.height_origin_m);
    canopy_.bottom_m[pixel] = std::fmin(canopy_.bottom_m[pixel], bottom);
    canopy_.top_m[pixel] = std::fmax(canopy_.top_m[pixel], top);
  }

  const package::Manifest& manifest_;
  const RasterPlan& plan_;
  PlanCanopy canopy_;
};

/// Whether crowns of a cell may reach a raster.
bool may_reach(const package::Manifest& manifest, Cell cell, double reach_m, const RasterPlan& plan) {
  const Box2d outline = manifest.projected_outline(manifest.grid.square_of(cell));
  const Point2d& corner = plan.north_west_m;
  const double width_m = static_cast<double>(plan.columns) * plan.step_m, height_m = static_cast<double>(plan.rows) * plan.step_m;
  return outline.low.x - reach_m <= corner.x + width_m && corner.x <= outline.high.x + reach_m &&
         outline.low.y - reach_m <= corner.y && corner.y - height_m <= outline.high.y + reach_m;
}

}  // namespace

PlanCanopy plan_canopy(const Package& package, const RasterPlan& plan, const RunSettings& run) {
  require_usable(run);
  require_usable_view(plan);
  const PackageInUse in_use(package);
  const PackageReader& reader = in_use.reader();
  require_memory(run, static_cast<double>(2 * plan.columns * plan.rows * sizeof(float)), "looking up crowns",
                 "choose a smaller part");
  CanopyOfPlan canopy(reader.manifest(), plan);
  if (!reader.has_crowns()) return canopy.take();
  const CrownsFile& crowns = reader.crowns();
  const double reach_m = std::numbers::sqrt2 * static_cast<double>(crowns.largest_half_width_m());
  for (const package::CrownCellRecord& record : crowns.cells()) {
    throw_if_cancelled(run.stop);
    const Cell cell{record.i, record.j};
    if (!may_reach(reader.manifest(), cell, reach_m, plan)) continue;
    for (const Crown& crown : crowns.crowns_of(record)) canopy.add(crown, reader.grid().corner_of(cell));
  }
  return canopy.take();
}

}  // namespace farlod
