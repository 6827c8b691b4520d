// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/building_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "farlod/inspection.hpp"
#include "results/picture/drawing.hpp"

namespace farlod {
namespace {

/// The cells of the grid that a plan may meet.
CellRectangle cells_of(const Package& package, const RasterPlan& plan) {
  const CellRectangle all = inventory_of(package).cells;
  const auto corners = inspect_cell(package, {all.i_begin, all.j_begin}).corners_projected;
  const Point2d east = corners[1] - corners[0], north = corners[3] - corners[0];
  constexpr double farthest = std::numeric_limits<double>::infinity();
  Point2d low{farthest, farthest}, high{-farthest, -farthest};
  for (const double x : {0.0, static_cast<double>(plan.columns) * plan.step_m})
    for (const double y : {0.0, static_cast<double>(plan.rows) * plan.step_m}) {
      const Point2d from_corner = plan.north_west_m + Point2d{x, -y} - corners[0];
      const Point2d cells{dot(from_corner, east) / dot(east, east), dot(from_corner, north) / dot(north, north)};
      low = {std::min(low.x, cells.x), std::min(low.y, cells.y)};
      high = {std::max(high.x, cells.x), std::max(high.y, cells.y)};
    }
  const auto within = [](double cells, std::int32_t begin, std::int32_t end) {
    return begin + static_cast<std::int32_t>(std::clamp(cells, 0.0, static_cast<double>(end - begin)));
  };
  return {within(std::floor(low.x), all.i_begin, all.i_end), within(std::floor(low.y), all.j_begin, all.j_end),
          within(std::ceil(high.x), all.i_begin, all.i_end), within(std::ceil(high.y), all.j_begin, all.j_end)};
}

/// Marks pixels of a plan.
class PixelMarks {
 public:
  explicit PixelMarks(const RasterPlan& plan) : plan_(plan), middles_(plan.columns * plan.rows), corners_(middles_.size()) {}

  void add(const MeshPart& part) {
    for (const MeshTriangle& t : part.triangles) {
      const auto& [a, b, c] = t.vertices;
      for_each_pixel({place_of(part, a), place_of(part, b), place_of(part, c)}, {plan_.columns, plan_.rows}, [&](Pixel p) {
        middles_[p.y * plan_.columns + p.x] = true;
        has_middles_ = true;
      });
      for (const std::uint32_t vertex : t.vertices) mark(place_of(part, vertex));
    }
  }
  [[nodiscard]] const std::vector<bool>& marked() const { return has_middles_ ? middles_ : corners_; }

 private:
  [[nodiscard]] PagePoint place_of(const MeshPart& part, std::uint32_t vertex) const {
    const Point3d& p = part.vertices_projected[vertex];
    return {(p.x - plan_.north_west_m.x) / plan_.step_m, (plan_.north_west_m.y - p.y) / plan_.step_m};
  }
  void mark(PagePoint p) {
    if (p.x < 0.0 || p.y < 0.0) return;
    const auto column = static_cast<std::size_t>(p.x), row = static_cast<std::size_t>(p.y);
    if (column < plan_.columns && row < plan_.rows) corners_[row * plan_.columns + column] = true;
  }

  const RasterPlan& plan_;
  std::vector<bool> middles_, corners_;
  bool has_middles_ = false;
};

}  // namespace

std::vector<bool> plan_of_building(const Package& package, const std::string& id, const RasterPlan& plan) {
  PixelMarks marks(plan);
  const CellRectangle cells = cells_of(package, plan);
  // One by one: what is not the building's is forgotten
  for (std::int32_t j = cells.j_begin; j < cells.j_end; ++j)
    for (std::int32_t i = cells.i_begin; i < cells.i_end; ++i)
      for (const MeshPart& part : geometry_of(package, {i, j, i + 1, j + 1}))
        if (part.building && part.id == id) marks.add(part);
  return marks.marked();
}

}  // namespace farlod
