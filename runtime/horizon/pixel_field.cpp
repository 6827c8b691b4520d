// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/pixel_field.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "package/pixel_heights.hpp"

namespace farlod {
namespace {

constexpr float least_height_m = 1e-6F;
constexpr std::uint32_t flags = JoinedPixels::east | JoinedPixels::north;

float flagged(float height_m, std::uint32_t joined) {
  return std::bit_cast<float>((std::bit_cast<std::uint32_t>(height_m) & ~flags) | joined);
}
float height_of(float flagged_m) { return flagged(flagged_m, 0); }
std::uint32_t joined_of(float flagged_m) { return std::bit_cast<std::uint32_t>(flagged_m) & flags; }

/// Slopes are rounded between the centres of pixels: what is left out must be lower than that.
float above_rounding(float height_m) { return height_m > no_height_m ? height_m + 4e-7F * std::abs(height_m) + 1e-6F : height_m; }

std::int32_t squares_along(std::int32_t pixels, std::uint32_t shift) { return ((pixels - 1) >> shift) + 1; }

/// Makes each value the highest of `count` ones, from itself on, `apart` each; behind the last there is nothing.
void raise_to_next(std::span<float> values, std::size_t apart, std::int32_t count) {
  const auto raise_to = [&](std::size_t next) {
    for (std::size_t n = 0; n + next * apart < values.size(); ++n) values[n] = std::max(values[n], values[n + next * apart]);
  };
  // Each value is that of twice as many, and so on; then the two that begin and end with all of them overlap
  const auto all = static_cast<std::size_t>(count);
  std::size_t known = 1;
  for (; 2 * known <= all; known *= 2) raise_to(known);
  if (known < all) raise_to(all - known);
}

}  // namespace

float flagged_height(float height_m, std::uint32_t joined) {
  // Flags alone would make 0 a denormal number, with which processors compute slowly
  return flagged(std::abs(height_m) < least_height_m ? least_height_m : height_m, joined & flags);
}

/// There is room before the first square, from where it is still looked at, and behind the last, at the end of each row.
HighestPixels::HighestPixels(const float* height_m, std::ptrdiff_t stride, std::int32_t columns, std::int32_t rows,
                             const Around& around)
    : around_(around),
      columns_(squares_along(columns, around.shift) + 2 * around.across),
      rows_(squares_along(rows, around.shift) + 2 * around.along),
      height_m_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), no_height_m) {
  for (std::int32_t y = 0; y < rows; ++y) {
    float* const row =
        height_m_.data() + static_cast<std::ptrdiff_t>((y >> around.shift) + around.along) * columns_ + around.across;
    for (std::int32_t x = 0; x < columns; ++x)
      row[x >> around.shift] = std::max(row[x >> around.shift], height_m[y * stride + x]);
  }
  for (float& height : height_m_) height = above_rounding(height);
  raise_to_next(height_m_, 1, around.across);
  raise_to_next(height_m_, static_cast<std::size_t>(columns_), around.along);
}

HighestAround HighestPixels::view() const {
  const std::int32_t room = std::min(around_.across, around_.along);
  return {height_m_.data() + static_cast<std::ptrdiff_t>(around_.along) * columns_ + around_.across,
          columns_,
          -room,
          columns_ - around_.across - 1,
          rows_ - around_.along - 1,
          around_.shift};
}

PixelField::PixelField(const package::SurfacePixels& pixels, std::span<const float> height_m,
                       std::span<const std::uint8_t> joined)
    : pixel_m_(pixels.step_m),
      columns_(static_cast<std::int32_t>(pixels.columns)),
      rows_(static_cast<std::int32_t>(pixels.rows)),
      stride_(columns_ + 2 * columns_aside),
      height_m_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(rows_ + 2 * rows_aside), no_height_m),
      around_(nullptr, 0, 1, 0, around_far_step),
      long_around_(nullptr, 0, 1, 0, around_long_step) {
  fill(height_m, joined);
  around_ = {first(), stride_, columns_, rows_, around_far_step};
  long_around_ = {first(), stride_, columns_, rows_, around_long_step};
}

void PixelField::fill(std::span<const float> height_m, std::span<const std::uint8_t> joined) {
  for (float& height : height_m_) height = height_of(height);
  for (std::int32_t row = 0; row < rows_; ++row) {
    float* const heights = height_m_.data() + (row + rows_aside) * stride_ + columns_aside;
    for (std::int32_t column = 0; column < columns_; ++column) {
      const auto n = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
      if (std::isnan(height_m[n])) continue;
      heights[column] = flagged_height(height_m[n], joined[n]);
      highest_m_ = std::max(highest_m_, heights[column]);
      is_torn_ |= column + 1 < columns_ && row + 1 < rows_ && (joined[n] & flags) != flags;
    }
  }
  highest_m_ = above_rounding(highest_m_);
}

PixelFieldView PixelField::view() const {
  return {first(), stride_, columns_, rows_, around_.view(), long_around_.view(), highest_m_, is_torn_};
}

FourPixels PixelField::four_from(std::int32_t column, std::int32_t row) const {
  const auto pixel = [&](std::int32_t east, std::int32_t north) {
    return contains(column + east, row + north) ? first()[(row + north) * stride_ + column + east] : height_of(no_height_m);
  };
  const std::array<float, 4> corners{pixel(0, 0), pixel(1, 0), pixel(1, 1), pixel(0, 1)};
  FourPixels four;
  for (std::size_t k = 0; k < 4; ++k) {
    four.height_m[k] = static_cast<double>(height_of(corners[k]));
    four.has_height[k] = four.height_m[k] > 0.5 * static_cast<double>(no_height_m);
  }
  const auto is_joined = [&](std::size_t k, std::uint32_t flag) { return (joined_of(corners[k]) & flag) != 0; };
  four.joined = {is_joined(0, JoinedPixels::east), is_joined(1, JoinedPixels::north), is_joined(3, JoinedPixels::east),
                 is_joined(0, JoinedPixels::north)};
  return four;
}

PixelWindow::PixelWindow(const PixelField& field)
    : field_(field), planes_(static_cast<std::size_t>(plane) * static_cast<std::size_t>(pixel_planes)) {}

void PixelWindow::look_at(std::int32_t column, std::int32_t row) {
  if (highest_ && column - margin == column_ && row - margin == row_) return;
  column_ = column - margin;
  row_ = row - margin;
  torn_ = 0;
  for (std::int32_t y = 0; y < rows; ++y)
    for (std::int32_t x = 0; x < columns; ++x) fill(x, y);
  highest_.emplace(planes_.data(), columns, columns, rows, around_far_step);
}

void PixelWindow::fill(std::int32_t x, std::int32_t y) {
  const FourPixels four = field_.four_from(column_ + x, row_ + y);
  const auto pixel = static_cast<std::size_t>(y * columns + x);
  const auto rise = [&](std::size_t side, std::size_t to) {
    return four.joined[side] ? static_cast<float>(four.height_m[to] - four.height_m[0]) : 0.0F;
  };
  at(PixelPlane::height, 0, pixel) = static_cast<float>(four.height_m[0]);
  at(PixelPlane::east, 0, pixel) = rise(0, 1);
  at(PixelPlane::north, 0, pixel) = rise(3, 3);
  const PixelMiddle middle = middle_of(four);
  for (std::size_t k = 0; k < 4; ++k)
    at(PixelPlane::to_middle, k, pixel) =
        four.has_height[k] ? static_cast<float>(middle.middle_height_m[k] - four.height_m[k]) : 0.0F;
  at(PixelPlane::torn_east, 0, pixel) = four.joined[0] ? no_height_m : 0.0F;
  at(PixelPlane::torn_north, 0, pixel) = four.joined[3] ? no_height_m : 0.0F;
  const auto is_torn_from = [&](std::size_t neighbor, std::size_t side) {
    return (four.has_height[0] || four.has_height[neighbor]) && !four.joined[side];
  };
  if (is_torn_from(1, 0) || is_torn_from(3, 3)) ++torn_;
}

PixelWindowView PixelWindow::view() const { return {planes_.data(), columns, highest_->view(), torn_ > 0}; }

}  // namespace farlod
