// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/plan_background.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "farlod/plan_view.hpp"

namespace farlod {
namespace {

// Greys must stay apart from that of buildings
constexpr float darkest = 0.6F, lightest = 1.25F;
/// A few pixels are not seen.
constexpr std::size_t pixels_for_one_that_shows = 100;

/// The ground's heights as a picture has them.
class Relief {
 public:
  Relief(const std::vector<float>& heights_m, const RasterPlan& plan) : heights_m_(heights_m), plan_(plan) {}

  /// Towards the east and the north, in metres a metre; level where the ground is unknown.
  [[nodiscard]] Point2d gradient(std::size_t column, std::size_t row) const {
    const std::size_t west = column - (column > 0 ? 1 : 0), east = std::min(column + 1, plan_.columns - 1);
    const std::size_t north = row - (row > 0 ? 1 : 0), south = std::min(row + 1, plan_.rows - 1);
    return {rise(at(west, row), at(east, row), east - west), rise(at(column, south), at(column, north), south - north)};
  }

 private:
  [[nodiscard]] double at(std::size_t column, std::size_t row) const {
    return static_cast<double>(heights_m_[row * plan_.columns + column]);
  }
  [[nodiscard]] double rise(double from_m, double to_m, std::size_t pixels) const {
    const double slope = (to_m - from_m) / (static_cast<double>(pixels) * plan_.step_m);
    return std::isfinite(slope) ? slope : 0.0;
  }

  const std::vector<float>& heights_m_;
  const RasterPlan& plan_;
};

/// Lambert's cosine law, compared with level ground.
float factor_of(Point2d gradient) {
  constexpr double up = std::numbers::sqrt2 / 2.0, west = 0.5, north = 0.5;  // of length 1: 45° high in the north-west
  const double light = (west * gradient.x - north * gradient.y + up) / std::sqrt(1.0 + dot(gradient, gradient));
  return std::clamp(static_cast<float>(light / up), darkest, lightest);
}

std::vector<Segment> outlines_of(const Package& package, const RasterPlan& plan, const RunSettings& run) {
  const double right = static_cast<double>(plan.columns), bottom = static_cast<double>(plan.rows);
  const Point2d north_west = plan.north_west_m;
  const Box2d part{{north_west.x, north_west.y - bottom * plan.step_m}, {north_west.x + right * plan.step_m, north_west.y}};
  const auto found = building_outlines(package, part, most_outlines, run);
  if (!found || found->typical_edge_m < smallest_building * plan.step_m) return {};
  const auto placed = [&](Point2d p) {
    return PagePoint{(p.x - north_west.x) / plan.step_m, (north_west.y - p.y) / plan.step_m};
  };
  std::vector<Segment> outlines;
  for (const PlanSegment& segment : found->segments)
    if (const auto seen = clipped({placed(segment.a), placed(segment.b)}, {0.0, 0.0}, {right, bottom})) outlines.push_back(*seen);
  return outlines;
}

}  // namespace

std::vector<float> shading_of(const std::vector<float>& heights_m, const RasterPlan& plan) {
  const Relief relief(heights_m, plan);
  std::vector<float> shading;
  shading.reserve(heights_m.size());
  for (std::size_t row = 0; row < plan.rows; ++row)
    for (std::size_t column = 0; column < plan.columns; ++column) shading.push_back(factor_of(relief.gradient(column, row)));
  const auto shown = std::count_if(shading.begin(), shading.end(), [](float f) { return std::abs(f - 1.0F) > visible_light; });
  return static_cast<std::size_t>(shown) * pixels_for_one_that_shows >= shading.size() ? shading : std::vector<float>{};
}

std::vector<bool> widened(const std::vector<bool>& is_covered, std::size_t columns, std::size_t by) {
  const std::size_t rows = columns == 0 ? 0 : is_covered.size() / columns;
  std::vector<bool> wide(is_covered.size());
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column) {
      if (!is_covered[row * columns + column]) continue;
      for (std::size_t r = row - std::min(row, by); r <= std::min(row + by, rows - 1); ++r)
        for (std::size_t c = column - std::min(column, by); c <= std::min(column + by, columns - 1); ++c)
          wide[r * columns + c] = true;
    }
  return wide;
}

PlanBackground plan_background(const Package& package, const RasterPlan& plan, std::size_t threads,
                               bool has_pixels_without_value) {
  RunSettings run;
  run.threads = threads;
  PlanBackground background;
  background.outlines = outlines_of(package, plan, run);
  // Pixels of less than a centimetre, or of more than ten kilometres, show no relief
  if (!has_pixels_without_value || plan.step_m < 0.01 || plan.step_m > 10'000.0) return background;
  const PlanHeights heights = plan_heights(package, plan, run);
  background.shading = shading_of(heights.ground_m, plan);
  constexpr float lowest_roof_m = 0.1F;
  for (std::size_t n = 0; n < heights.ground_m.size(); ++n)
    background.is_covered.push_back(heights.highest_m[n] - heights.ground_m[n] > lowest_roof_m);
  return background;
}

}  // namespace farlod
