// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plausibility/doubtful_surface.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace farlod::plausibility {
namespace {

constexpr std::size_t enough_points = 100;
constexpr double flattest_city_m = 1.0;
constexpr double highest_class = 8.0;
constexpr std::size_t fewest_classes = 4;
/// A tower in a small raster makes a steep one: nobody doubts what is lower than this.
constexpr double lowest_steep_m = 100.0, steepest = 4.0;
/// A way has steps of this length; what is farther from the point before begins another way.
constexpr double least_step_m = 2.0, same_way = 8.0;

/// A way over the surface.
class Way {
 public:
  explicit Way(SurfaceShape& shape) : shape_(shape) {}

  void go_to(const Point3d& p) {
    const double run_m = norm(horizontal(p) - horizontal(last_));
    if (has_begun_ && run_m < least_step_m) return;
    if (has_begun_ && run_m <= same_way * shortest_m_) {
      shape_.rise_m += std::abs(p.z - last_.z);
      shape_.run_m += run_m;
      shortest_m_ = std::min(run_m, shortest_m_);
    }
    last_ = p;
    has_begun_ = true;
  }

 private:
  SurfaceShape& shape_;
  Point3d last_;
  bool has_begun_ = false;
  double shortest_m_ = std::numeric_limits<double>::infinity();
};

}  // namespace

void SurfaceShape::add(const Point3d& p) {
  ++points;
  low_m = std::min(low_m, p.z);
  if (!highest || p.z > high_m) highest = p;
  high_m = std::max(high_m, p.z);
  are_whole = are_whole && 0.0 <= p.z && p.z <= highest_class && p.z == std::floor(p.z);
  if (are_whole) whole_numbers.insert(p.z);
}

SurfaceShape shape_of(const TerrainRaster& surface) {
  SurfaceShape shape;
  const auto go = [&](Way& way, std::size_t column, std::size_t row, const auto& visit) {
    const auto& height_m = surface.height_m[row * surface.columns + column];
    if (!height_m) return;
    const Point2d p = surface.node(column, row);
    visit(Point3d{p.x, p.y, *height_m});
    way.go_to({p.x, p.y, *height_m});
  };
  for (std::size_t row = 0; row < surface.rows; ++row) {
    Way way(shape);
    for (std::size_t column = 0; column < surface.columns; ++column)
      go(way, column, row, [&](const Point3d& p) { shape.add(p); });
  }
  constexpr std::size_t enough_columns = 1000;
  const std::size_t apart = std::max<std::size_t>(1, surface.columns / enough_columns);
  for (std::size_t column = 0; column < surface.columns; column += apart) {
    Way way(shape);
    for (std::size_t row = 0; row < surface.rows; ++row) go(way, column, row, [](const Point3d&) {});
  }
  return shape;
}

SurfaceShape shape_of(std::span<const Point3d> points) {
  SurfaceShape shape;
  Way way(shape);
  for (const Point3d& p : points) {
    shape.add(p);
    way.go_to(p);
  }
  return shape;
}

std::optional<std::string> doubt_about_surface(const SurfaceShape& shape) {
  constexpr const char* advice = "give the raster of heights, in metres";
  if (shape.points < enough_points || shape.low_m == shape.high_m) return std::nullopt;
  const double range_m = shape.high_m - shape.low_m;
  if (range_m <= flattest_city_m)
    return fmt::format(
        "its heights lie between {:.2f} m and {:.2f} m, and no city is as flat: is it another quantity, such as a "
        "share from 0 to 1, or another unit? If so, {}",
        shape.low_m, shape.high_m, advice);
  if (shape.are_whole && shape.whole_numbers.size() >= fewest_classes)
    return fmt::format(
        "it holds whole numbers from {:g} to {:g} alone, which were read as metres: are they classes, such as of "
        "land cover, or storeys? If so, {}",
        shape.low_m, shape.high_m, advice);
  if (range_m > lowest_steep_m && shape.rise_m > steepest * shape.run_m)
    return fmt::format(
        "its heights, from {:.0f} m to {:.0f} m, climb or fall by {:.0f} m on a metre, as no city does: are they in "
        "centimetres (gdal_edit.py -scale 0.01 FILE says so), or another quantity? If so, {}",
        shape.low_m, shape.high_m, shape.rise_m / shape.run_m, advice);
  return std::nullopt;
}

}  // namespace farlod::plausibility
