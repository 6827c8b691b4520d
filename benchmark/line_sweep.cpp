// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "benchmark/line_sweep.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace farlod::benchmark {
namespace {

/// A corner of a triangle: pixel centres are at whole columns and rows.
struct PixelCorner {
  double column = 0.0, row = 0.0, z_m = 0.0;
};
using PixelTriangle = std::array<PixelCorner, 3>;

double doubled_area(const PixelCorner& a, const PixelCorner& b, double column, double row) {
  return (b.column - a.column) * (row - a.row) - (b.row - a.row) * (column - a.column);
}

class Rasteriser {
 public:
  Rasteriser(const package::Manifest& manifest, HeightRaster& raster) : manifest_(manifest), raster_(raster) {}

  void draw(const TileView& tile, Point2d corner_grid) {
    for (std::uint32_t t = 0; t < tile.mesh.triangles.size(); ++t) {
      const Triangle& triangle = tile.mesh.triangles[t];
      const auto corner = [&](std::uint32_t vertex) { return pixel_corner(tile.mesh.vertices[vertex], corner_grid); };
      const bool is_ground = tile.surface_of(t).kind() == SurfaceKind::ground;
      fill({corner(triangle.a), corner(triangle.b), corner(triangle.c)}, is_ground ? raster_.ground_m : raster_.surface_m);
    }
  }

 private:
  [[nodiscard]] PixelCorner pixel_corner(const Point3f& p_cell, Point2d corner_grid) const {
    const Point3d p = manifest_.projected_from_grid({corner_grid.x + p_cell.x, corner_grid.y + p_cell.y, p_cell.z});
    const RasterPlan& plan = raster_.plan;
    return {(p.x - plan.north_west_m.x) / plan.step_m - 0.5, (plan.north_west_m.y - p.y) / plan.step_m - 0.5, p.z};
  }

  /// Raises the pixels whose centres the triangle covers, borders included. A vertical one covers none.
  void fill(const PixelTriangle& t, std::vector<float>& heights_m) const {
    const double area = doubled_area(t[0], t[1], t[2].column, t[2].row);
    if (area == 0.0) return;
    const auto [left, right] = std::minmax({t[0].column, t[1].column, t[2].column});
    const auto [top, bottom] = std::minmax({t[0].row, t[1].row, t[2].row});
    for (std::size_t row = first_from(top); row < end_after(bottom, raster_.plan.rows); ++row)
      for (std::size_t column = first_from(left); column < end_after(right, raster_.plan.columns); ++column) {
        const auto x = static_cast<double>(column), y = static_cast<double>(row);
        const double a = doubled_area(t[1], t[2], x, y) / area, b = doubled_area(t[2], t[0], x, y) / area;
        if (a < 0.0 || b < 0.0 || a + b > 1.0) continue;
        float& height_m = heights_m[row * raster_.plan.columns + column];
        height_m = std::max(height_m, static_cast<float>(a * t[0].z_m + b * t[1].z_m + (1.0 - a - b) * t[2].z_m));
      }
  }
  static std::size_t first_from(double place) { return static_cast<std::size_t>(std::max(0.0, std::ceil(place))); }
  static std::size_t end_after(double place, std::size_t size) {
    return static_cast<std::size_t>(std::clamp(std::floor(place) + 1.0, 0.0, static_cast<double>(size)));
  }

  const package::Manifest& manifest_;
  HeightRaster& raster_;
};

}  // namespace

HeightRaster rasterise(const PackageReader& package, double pixel_m) {
  HeightRaster raster{plan_raster(package.manifest(), pixel_m, std::nullopt), {}, {}};
  const std::size_t pixels = raster.plan.columns * raster.plan.rows;
  raster.surface_m.assign(pixels, -std::numeric_limits<float>::infinity());
  raster.ground_m = raster.surface_m;
  Rasteriser rasteriser(package.manifest(), raster);
  const Grid& grid = package.grid();
  for (std::size_t n = 0; n < static_cast<std::size_t>(grid.cells.size()); ++n)
    rasteriser.draw(package.tile(grid.cells.cell_at(n)), grid.corner_of(grid.cells.cell_at(n)));
  for (std::size_t n = 0; n < pixels; ++n) raster.surface_m[n] = std::max(raster.surface_m[n], raster.ground_m[n]);
  return raster;
}

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
/// A receiver's own pixel may be this much higher than its ground: both are interpolated in different triangles.
constexpr float rounding_m = 0.01F;

/// The upper convex hull of the posts that a line has passed.
class Hull {
 public:
  explicit Hull(std::size_t most) : corners_(most) {}
  void clear() { size_ = 0; }

  void add(float along, float height_m) {
    while (size_ > 1 && !is_above(corners_[size_ - 1], corners_[size_ - 2], {along, height_m})) --size_;
    corners_[size_++] = {along, height_m};
  }

  /// The steepest slope up from an eye beyond all corners; 0 when nothing is higher.
  [[nodiscard]] float steepest(float along, float eye_m) const {
    if (size_ == 0) return 0.0F;
    // On the hull, slopes rise up to the tangent and fall behind it. Compared without a division each
    float rise = corners_[size_ - 1].height_m - eye_m, run = along - corners_[size_ - 1].along;
    for (std::size_t n = size_ - 1; n > 0; --n) {
      const float next_rise = corners_[n - 1].height_m - eye_m, next_run = along - corners_[n - 1].along;
      if (next_rise * run < rise * next_run) break;
      rise = next_rise;
      run = next_run;
    }
    return std::max(0.0F, rise / run);
  }

 private:
  struct Corner {
    float along, height_m;
  };
  /// Whether the middle corner stands above the line from the one before it to the one after.
  static bool is_above(const Corner& middle, const Corner& before, const Corner& after) {
    return (middle.height_m - before.height_m) * (after.along - before.along) >
           (after.height_m - before.height_m) * (middle.along - before.along);
  }
  std::vector<Corner> corners_;
  std::size_t size_ = 0;
};

/// The lines of one azimuth. All climb alike: line k is at row k + climb[column].
struct Lines {
  std::vector<std::ptrdiff_t> climb;
  float step_m = 0.0F;       ///< along the line, from column to column
  bool sky_is_east = false;  ///< where receivers look: lines come from there
};

/// From west to east never descending, or never climbing.
std::vector<std::ptrdiff_t> climbs(std::size_t columns, double slope) {
  std::vector<std::ptrdiff_t> rows;
  for (std::size_t column = 0; column < columns; ++column) rows.push_back(std::lround(static_cast<double>(column) * slope));
  return rows;
}

/// Adds what each receiver on a line sees in this azimuth.
template <class Field>
void sweep_line(const Field& field, const Lines& lines, std::ptrdiff_t line, Hull& hull, std::vector<float>& sums) {
  for (std::size_t n = 0; n < field.columns; ++n) {
    const std::size_t column = lines.sky_is_east ? field.columns - 1 - n : n;
    const std::ptrdiff_t row = line + lines.climb[column];
    if (row < 0 || row >= static_cast<std::ptrdiff_t>(field.rows)) continue;
    const std::size_t pixel = static_cast<std::size_t>(row) * field.columns + column;
    const float along_m = static_cast<float>(n) * lines.step_m;
    if (field.eye_m[pixel] < infinity) {
      const float tangent = hull.steepest(along_m, field.eye_m[pixel]);
      sums[pixel] += 1.0F / (1.0F + tangent * tangent);
    }
    // Later receivers look at the face on their own side
    if (field.surface_m[pixel] > -infinity) hull.add(along_m + 0.5F * lines.step_m, field.surface_m[pixel]);
  }
}

}  // namespace

LineSweep::LineSweep(const HeightRaster& raster, float height_m)
    : pixel_m_(raster.plan.step_m), field_{raster.plan.columns, raster.plan.rows, raster.surface_m, {}} {
  field_.eye_m.assign(field_.surface_m.size(), infinity);
  for (std::size_t n = 0; n < field_.eye_m.size(); ++n)
    if (raster.ground_m[n] > -infinity && raster.surface_m[n] <= raster.ground_m[n] + rounding_m)
      field_.eye_m[n] = raster.ground_m[n] + height_m;
  transposed_ = transposed(field_);
}

std::size_t LineSweep::receiver_count() const {
  return static_cast<std::size_t>(std::count_if(field_.eye_m.begin(), field_.eye_m.end(), [](float z) { return z < infinity; }));
}

LineSweep::Field LineSweep::transposed(const Field& field) {
  Field result{field.rows, field.columns, field.surface_m, field.eye_m};
  for (std::size_t row = 0; row < field.rows; ++row)
    for (std::size_t column = 0; column < field.columns; ++column) {
      result.surface_m[column * field.rows + row] = field.surface_m[row * field.columns + column];
      result.eye_m[column * field.rows + row] = field.eye_m[row * field.columns + column];
    }
  return result;
}

void LineSweep::sweep(const Field& field, double column_step, double row_step, std::vector<float>& sums) const {
  const double slope = row_step / column_step;
  const Lines lines{climbs(field.columns, slope), static_cast<float>(pixel_m_ * std::hypot(1.0, slope)), column_step > 0.0};
  const auto [lowest, highest] = std::minmax(lines.climb.front(), lines.climb.back());
  const oneapi::tbb::blocked_range<std::ptrdiff_t> all(-highest, static_cast<std::ptrdiff_t>(field.rows) - lowest);
  oneapi::tbb::parallel_for(all, [&](const oneapi::tbb::blocked_range<std::ptrdiff_t>& some) {
    Hull hull(field.columns);
    for (std::ptrdiff_t line = some.begin(); line < some.end(); ++line) {
      hull.clear();
      sweep_line(field, lines, line, hull, sums);
    }
  });
}

std::vector<float> LineSweep::sky_view_factors(std::size_t azimuths) const {
  std::vector<float> sums(field_.surface_m.size(), 0.0F), transposed_sums = sums;
  for (std::size_t k = 0; k < azimuths; ++k) {
    const double azimuth = 2.0 * std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(azimuths);
    const double east = std::sin(azimuth), south = -std::cos(azimuth);
    if (std::abs(east) >= std::abs(south))
      sweep(field_, east, south, sums);
    else
      sweep(transposed_, south, east, transposed_sums);
  }
  for (std::size_t row = 0; row < field_.rows; ++row)
    for (std::size_t column = 0; column < field_.columns; ++column) {
      float& sum = sums[row * field_.columns + column];
      sum = (sum + transposed_sums[column * field_.rows + row]) / static_cast<float>(azimuths);
    }
  return sums;
}

namespace {

constexpr std::array<std::size_t, 2> azimuth_counts{64, 128};
constexpr float eye_height_m = 1.5F;

/// The pixels on whose centres receivers stand: both come from the same plan.
std::vector<std::size_t> pixels_of(const PackageReader& package, const RasterPlan& plan, const CityReceivers& receivers) {
  std::vector<std::size_t> pixels;
  for (const CellReceivers& cell : receivers.cells)
    for (const Receiver& r : cell.receivers) {
      const Point2d corner = package.grid().corner_of(cell.cell);
      const Point3d p = package.manifest().projected_from_grid({corner.x + r.p_cell.x, corner.y + r.p_cell.y, 0.0});
      const auto column = static_cast<std::size_t>((p.x - plan.north_west_m.x) / plan.step_m);
      const auto row = static_cast<std::size_t>((plan.north_west_m.y - p.y) / plan.step_m);
      pixels.push_back(row * plan.columns + column);
    }
  return pixels;
}

/// Receivers whose pixel is a building's in the raster, by a hair, have no answer: they are left out.
SweepRow compare(std::size_t azimuths, const std::vector<float>& svf, const std::vector<std::size_t>& pixels,
                 const std::vector<float>& truth) {
  std::vector<float> answers, answered_truth;
  for (std::size_t n = 0; n < pixels.size(); ++n) {
    if (svf[pixels[n]] == 0.0F) continue;
    answers.push_back(svf[pixels[n]]);
    answered_truth.push_back(truth[n]);
  }
  return {azimuths, errors_of(answers, answered_truth), 0.0};
}

}  // namespace

SweepStudy study_sweep(const City& city, const Extent& extent) {
  const SampledField field = prepare_field(city, Place::ground, extent);
  SweepStudy study;
  HeightRaster raster;
  study.raster_s = median_seconds(extent.turns, [&] { raster = rasterise(city.package, extent.spacing_m(Place::ground)); });
  const LineSweep sweep(raster, eye_height_m);
  study.pixel_m = extent.spacing_m(Place::ground);
  study.pixels = raster.surface_m.size();
  study.receivers = sweep.receiver_count();
  study.compared = field.truth.size();
  const std::vector<std::size_t> pixels = pixels_of(city.package, raster.plan, field.sample.receivers);
  for (const std::size_t azimuths : azimuth_counts) {
    tell("line sweep: " + std::to_string(azimuths) + " azimuths");
    std::vector<float> svf;
    const double seconds = median_seconds(extent.turns, [&] { svf = sweep.sky_view_factors(azimuths); });
    study.rows.push_back(compare(azimuths, svf, pixels, field.truth));
    study.rows.back().seconds = seconds;
  }
  return study;
}

}  // namespace farlod::benchmark
