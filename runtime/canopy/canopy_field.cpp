// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "canopy/canopy_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "farlod/box.hpp"
#include "package/pixel_heights.hpp"

namespace farlod {
namespace {

/// Crowns and receivers are floats in their cell, and so off the centres by some micrometres; turns are rounded.
constexpr double most_aside = 1e-3, most_turned_rad = 1e-3, most_along = 1e9;

/// What an eye at the side of a pixel has for 1 / distance, in 1/m.
constexpr double per_no_distance = 1e6;

/// Whether the sides of a square, turned so far, lie along the axes of the city.
bool lies_along_axes(const Crown& crown, const GridRotation& rotation) {
  const double quarter = 0.5 * std::numbers::pi;
  const double off = std::remainder(crown.turn_rad() - rotation.bearing().radians(), quarter);
  return std::abs(off) <= most_turned_rad;
}

/// The first pixel and the end of the columns and rows that the centres of pixels in a box have.
struct PixelRange {
  Point2d low{most_along, most_along}, high{-most_along, -most_along};
  void add(Point2d pixels) {
    low = {std::min(low.x, first_of_square(pixels.x)), std::min(low.y, first_of_square(pixels.y))};
    high = {std::max(high.x, std::floor(pixels.x + 0.5)), std::max(high.y, std::floor(pixels.y + 0.5))};
  }
  /// Squares of the lattice are squares of the field.
  static double first_of_square(double pixel) { return std::floor(pixel / canopy_square) * canopy_square; }
  [[nodiscard]] double columns() const { return high.x - low.x + 1.0; }
  [[nodiscard]] double rows() const { return high.y - low.y + 1.0; }
};

/// All pixels with their centre in the rectangle of the grid, where all crowns are.
PixelRange range_of(const CanopyLattice& lattice, const Grid& grid) {
  PixelRange range;
  const Box2d all = grid.rectangle();
  for (const double x : {all.low.x, all.high.x})
    for (const double y : {all.low.y, all.high.y}) range.add(lattice.pixels_at(grid.rotation.city_from_grid(Point2d{x, y})));
  return range;
}

}  // namespace

std::optional<CanopyLattice> CanopyLattice::of(const Grid& grid, Cell cell, const Crown& crown) {
  if (crown.shape != CrownShape::prism || !lies_along_axes(crown, grid.rotation)) return std::nullopt;
  CanopyLattice lattice(2.0 * static_cast<double>(crown.half_width_m), crown);
  lattice.centre_city_ = city_from_cell(grid, cell, crown.x_m, crown.y_m);
  return lattice;
}

std::optional<CanopyLattice::Place> CanopyLattice::centre_at(Point2d p_city) const {
  const Point2d p = pixels_at(p_city), centre{std::round(p.x), std::round(p.y)};
  const bool is_centre = std::abs(p.x - centre.x) <= most_aside && std::abs(p.y - centre.y) <= most_aside;
  // Numbers beyond those of pixels may be none of an integer
  if (!is_centre || std::abs(centre.x) > most_along || std::abs(centre.y) > most_along) return std::nullopt;
  return Place{static_cast<std::int32_t>(centre.x), static_cast<std::int32_t>(centre.y)};
}

std::optional<CanopyLattice::Place> CanopyLattice::place_of(const Grid& grid, Cell cell, const Crown& crown) const {
  const bool is_alike = crown.shape == any_.shape && crown.half_width_m == any_.half_width_m && crown.turn == any_.turn &&
                        crown.foliage == any_.foliage;
  return is_alike ? centre_at(city_from_cell(grid, cell, crown.x_m, crown.y_m)) : std::nullopt;
}

namespace {

/// Makes the path of one direction: from pixel to pixel, across the side that is nearer.
class PixelWalk {
 public:
  PixelWalk(Point2d direction, double pixel_m, std::ptrdiff_t stride)
      : pixel_m_(pixel_m),
        per_x_(1.0 / std::max(std::abs(direction.x), 1e-12)),
        per_y_(1.0 / std::max(std::abs(direction.y), 1e-12)),
        to_x_(0.5 * per_x_),
        to_y_(0.5 * per_y_),
        step_x_(direction.x < 0.0 ? -1 : 1),
        step_y_(direction.y < 0.0 ? -stride : stride) {}

  [[nodiscard]] double entered() const { return entered_; }
  /// The pixel that the ray is in; then it goes on to the next. Through a corner it goes to the opposite one.
  CanopyCrossing pass() {
    const double left = std::min(to_x_, to_y_);
    const CanopyCrossing crossing{static_cast<std::int32_t>(pixel_), per(entered_), per(left), joined_before_, joined_here_};
    const bool crosses_x = to_x_ <= left + at_a_corner, crosses_y = to_y_ <= left + at_a_corner;
    if (crosses_x) to_x_ += per_x_, pixel_ += step_x_;
    if (crosses_y) to_y_ += per_y_, pixel_ += step_y_;
    const int flag = crosses_x && crosses_y ? 0 : crosses_x ? JoinedPixels::east : JoinedPixels::north;
    const bool goes_up = crosses_x ? step_x_ > 0 : step_y_ > 0;
    joined_before_ = goes_up ? flag : 0;
    joined_here_ = goes_up ? 0 : flag;
    entered_ = left;
    return crossing;
  }

 private:
  static constexpr double at_a_corner = 1e-9;
  [[nodiscard]] float per(double distance) const {
    return static_cast<float>(std::min(1.0 / (std::max(distance, 1e-12) * pixel_m_), per_no_distance));
  }

  double pixel_m_, per_x_, per_y_, to_x_, to_y_, entered_ = 0.0;
  std::ptrdiff_t step_x_, step_y_, pixel_ = 0;
  std::int32_t joined_before_ = 0, joined_here_ = 0;
};

CanopySegment segment_between(Point2d direction, double pixel_m, double from, double to) {
  const auto floor_of = [](double x) { return static_cast<std::int32_t>(std::floor(x)); };
  return {0, floor_of(std::min(from * direction.x, to * direction.x)) - 1,
          floor_of(std::min(from * direction.y, to * direction.y)) - 1,
          static_cast<float>(from > 0.0 ? 1.0 / (from * pixel_m) : per_no_distance)};
}

std::vector<Point2d> canopy_directions(const AzimuthSampling& azimuths, const GridRotation& rotation) {
  std::vector<Point2d> directions;
  for (std::size_t k = 0; k < azimuths.size(); ++k)
    directions.push_back(rotation.city_from_grid(Point2d{double{azimuths.cosine()[k]}, double{azimuths.sine()[k]}}));
  return directions;
}

}  // namespace

CanopyPaths::CanopyPaths(std::span<const Point2d> directions, double pixel_m, std::ptrdiff_t stride, double end) {
  const auto long_count = static_cast<std::size_t>(std::min(end, farthest_m / pixel_m) / long_step) + 1;
  const std::size_t count = long_count * (long_step / far_step);
  std::vector<std::size_t> begins{0};
  for (const Point2d direction : directions) {
    add_segments(direction, pixel_m, stride, count);
    for (std::size_t n = 0; n < long_count; ++n) {
      const double from = static_cast<double>(n) * long_step;
      long_segments_.push_back(segment_between(direction, pixel_m, from, from + long_step));
    }
    most_crossings_ = std::max(most_crossings_, crossings_.size() - begins.back());
    begins.push_back(crossings_.size());
  }
  // Arrays do not move any more
  const auto per = [](double rate) { return 1.0 / std::max(std::abs(rate), 1e-9); };
  for (std::size_t k = 0; k < directions.size(); ++k)
    paths_.push_back({directions[k].x, directions[k].y, per(directions[k].x), per(directions[k].y),
                      std::span(crossings_).subspan(begins[k], begins[k + 1] - begins[k]),
                      std::span(segments_).subspan(k * count, count),
                      std::span(long_segments_).subspan(k * long_count, long_count)});
}

void CanopyPaths::add_segments(Point2d direction, double pixel_m, std::ptrdiff_t stride, std::size_t count) {
  const std::size_t first = crossings_.size();
  PixelWalk walk(direction, pixel_m, stride);
  for (std::size_t n = 0; n < count; ++n) {
    const double from = static_cast<double>(n) * far_step, to = from + far_step;
    while (walk.entered() < to) crossings_.push_back(walk.pass());
    segments_.push_back(segment_between(direction, pixel_m, from, to));
    segments_.back().end = static_cast<std::uint32_t>(crossings_.size() - first);
  }
}

std::optional<CanopyField> CanopyField::of(const CanopyLattice& lattice, const package::Manifest& manifest,
                                           std::span<const CellCrowns> crowns, const SolidPixels& solids) {
  const PixelRange range = range_of(lattice, manifest.grid);
  double count = 0.0;
  for (const CellCrowns& of_cell : crowns) count += static_cast<double>(of_cell.crowns.size());
  if (range.columns() * range.rows() > std::min(most_pixels, most_pixels_per_crown * count)) return std::nullopt;
  CanopyField field(lattice, manifest.grid);
  if (!field.fill(lattice, manifest.grid, crowns)) return std::nullopt;
  if (!solids.height_m.empty()) field.fill_solids(lattice, manifest, solids);
  return field;
}

CanopyField::CanopyField(const CanopyLattice& lattice, const Grid& grid) {
  const PixelRange range = range_of(lattice, grid);
  first_column_ = static_cast<std::int32_t>(range.low.x);
  first_row_ = static_cast<std::int32_t>(range.low.y);
  columns_ = static_cast<std::int32_t>(range.columns());
  rows_ = static_cast<std::int32_t>(range.rows());
  stride_ = columns_ + 2 * aside;
  const auto size = static_cast<std::size_t>(stride_) * static_cast<std::size_t>(rows_ + 2 * aside);
  top_m_.assign(size, no_height_m);
  bottom_m_.assign(size, 0.0F);
}

std::optional<CanopyLattice::Place> CanopyField::in_field(const CanopyLattice::Place& place) const {
  const CanopyLattice::Place p{place.column - first_column_, place.row - first_row_};
  const bool is_within = p.column >= 0 && p.row >= 0 && p.column < columns_ && p.row < rows_;
  return is_within ? std::optional(p) : std::nullopt;
}

bool CanopyField::fill(const CanopyLattice& lattice, const Grid& grid, std::span<const CellCrowns> crowns) {
  for (const CellCrowns& of_cell : crowns)
    for (const Crown& crown : of_cell.crowns) {
      const std::optional<CanopyLattice::Place> place = lattice.place_of(grid, of_cell.cell, crown);
      const std::optional<CanopyLattice::Place> pixel = place ? in_field(*place) : std::nullopt;
      if (!pixel || top_m_[index_of(*pixel)] > no_height_m) return false;
      top_m_[index_of(*pixel)] = crown.top_m;
      bottom_m_[index_of(*pixel)] = crown.bottom_m;
      highest_m_ = std::max(highest_m_, crown.top_m);
    }
  const float* const first = top_m_.data() + aside * stride_ + aside;
  around_.emplace(first, stride_, columns_, rows_, around_far_step);
  long_around_.emplace(first, stride_, columns_, rows_, around_long_step);
  return true;
}

void CanopyField::fill_solids(const CanopyLattice& lattice, const package::Manifest& m, const SolidPixels& solids) {
  const package::SurfacePixels& pixels = *m.pixels;
  const Point2d south_west = pixels.north_west_m - m.origin_m + Point2d{0.5 * pixels.step_m, (0.5 - pixels.rows) * pixels.step_m};
  const std::optional<CanopyLattice::Place> first = lattice.centre_at(south_west);
  if (!first || std::abs(pixels.step_m / lattice.pixel_m() - 1.0) * std::max(pixels.columns, pixels.rows) > most_aside) return;
  solid_m_.assign(top_m_.size(), flagged_height(no_height_m, 0));
  for (std::uint32_t row = 0, n = 0; row < pixels.rows; ++row)
    for (std::uint32_t column = 0; column < pixels.columns; ++column, ++n) {
      const auto pixel =
          in_field({first->column + static_cast<std::int32_t>(column), first->row + static_cast<std::int32_t>(row)});
      if (pixel && !std::isnan(solids.height_m[n]))
        solid_m_[index_of(*pixel)] = flagged_height(solids.height_m[n], solids.joined[n]);
    }
}

CanopyFieldView CanopyField::view() const {
  const auto first = static_cast<std::size_t>(aside) * static_cast<std::size_t>(stride_) + aside;
  return {top_m_.data() + first,
          bottom_m_.data() + first,
          solid_m_.empty() ? nullptr : solid_m_.data() + first,
          stride_,
          columns_,
          rows_,
          around_->view(),
          long_around_->view(),
          highest_m_};
}

CanopyCity::CanopyCity(const package::Manifest& m, const CanopyLattice& l, CanopyField f, const AzimuthSampling& azimuths)
    : manifest(m),
      lattice(l),
      field(std::move(f)),
      paths(canopy_directions(azimuths, m.grid.rotation), l.pixel_m(), field.stride(), field.diagonal() + 2 * long_step) {}

}  // namespace farlod
