// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace farlod {

/// Four pixels around the corner that they share, counter-clockwise from the south-west. Side k runs from pixel k to the next
/// one.
struct FourPixels {
  std::array<bool, 4> has_height{};
  std::array<double, 4> height_m{};
  std::array<bool, 4> joined{};  ///< by side: the surface goes on from one pixel to the other

  [[nodiscard]] static constexpr std::size_t next(std::size_t k) { return (k + 1) % 4; }
  [[nodiscard]] static constexpr std::size_t before(std::size_t k) { return (k + 3) % 4; }
  /// The surface is one piece.
  [[nodiscard]] bool is_whole() const { return joined[0] && joined[1] && joined[2] && joined[3]; }
  /// The first of the two pixels between whose centres a whole surface folds: where heights differ less.
  [[nodiscard]] std::size_t fold() const {
    return std::abs(height_m[0] - height_m[2]) <= std::abs(height_m[1] - height_m[3]) ? 0 : 1;
  }
  /// The third corner of the triangle at side k of a whole surface that folds from pixel `fold` to the one opposite.
  [[nodiscard]] static constexpr std::size_t third(std::size_t fold, std::size_t k) {
    const bool begins_at_fold = k == fold || k == fold + 2;
    return begins_at_fold ? (k + 2) % 4 : before(k);
  }
};

/// The surface of each of four pixels at the corner that they share.
struct PixelMiddle {
  std::array<double, 4> middle_height_m{};
  std::array<bool, 4> is_level{};  ///< the pixel and those that are joined with it here, one after the other, are as high
};

namespace detail {

/// Pixels that are joined one after the other. Three around a corner lie in a plane, which is half-way between the outer two
/// there.
inline void set_middle(const FourPixels& pixels, std::size_t first, std::size_t count, PixelMiddle& middle) {
  const auto height = [&](std::size_t n) { return pixels.height_m[(first + n) % 4]; };
  const double ends_m = 0.5 * (height(0) + height(count - 1));
  const double at_middle_m = count < 4 ? ends_m : 0.5 * (ends_m + 0.5 * (height(1) + height(2)));
  bool level = true;
  for (std::size_t n = 1; n < count; ++n) level &= height(n) == height(0);
  for (std::size_t n = 0; n < count; ++n) {
    middle.middle_height_m[(first + n) % 4] = level ? height(0) : at_middle_m;
    middle.is_level[(first + n) % 4] = level;
  }
}

}  // namespace detail

[[nodiscard]] inline PixelMiddle middle_of(const FourPixels& pixels) {
  PixelMiddle middle;
  if (pixels.is_whole()) {
    detail::set_middle(pixels, 0, 4, middle);
    const std::size_t fold = pixels.fold();
    if (!middle.is_level[0]) middle.middle_height_m.fill(0.5 * (pixels.height_m[fold] + pixels.height_m[fold + 2]));
    return middle;
  }
  for (std::size_t first = 0; first < 4; ++first) {
    if (!pixels.has_height[first] || pixels.joined[FourPixels::before(first)]) continue;
    std::size_t count = 1;
    while (count < 4 && pixels.joined[(first + count - 1) % 4]) ++count;
    detail::set_middle(pixels, first, count, middle);
  }
  return middle;
}

}  // namespace farlod
