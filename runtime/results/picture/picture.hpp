// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace farlod {

/// A colour in sRGB, as it lies in a picture's memory.
struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
  bool operator==(const Colour&) const = default;
};

/// A pixel's place, counted from the upper left corner.
struct Pixel {
  std::size_t x = 0, y = 0;
  bool operator==(const Pixel&) const = default;
};

struct PixelSize {
  std::size_t width = 0, height = 0;
  bool operator==(const PixelSize&) const = default;
};

/// A picture in memory, row by row from the top. What is drawn outside of it is lost.
class Picture {
 public:
  Picture(PixelSize size, Colour background);

  [[nodiscard]] PixelSize size() const { return size_; }
  [[nodiscard]] const std::vector<Colour>& pixels() const { return pixels_; }
  /// The pixel must lie inside.
  [[nodiscard]] Colour at(Pixel pixel) const;
  void set(Pixel pixel, Colour colour);
  void fill(Pixel upper_left, PixelSize size, Colour colour);

 private:
  PixelSize size_;
  std::vector<Colour> pixels_;
};

/// The colour of a view factor between 0 (dark violet) and 1 (yellow); a value outside is clamped. The
/// map is viridis, which is perceptually uniform and of monotonic lightness, so that it can be read without colour vision.
[[nodiscard]] Colour colour_of_svf(double svf);

/// The colour of an error, as a share of the largest of the scale: from −1 (violet) over 0 (nearly white) to 1 (brown); a value
/// outside is clamped. Of both signs, the darker is the larger, and colours of opposite signs are told apart without one kind of
/// cones; in a print in grey they are not.
[[nodiscard]] Colour colour_of_error(double share);

/// The colour of a building's height, as a share of the greatest of the scale: from yellow to dark red, the higher the darker; a
/// value above 1 has the colour of 1.
[[nodiscard]] Colour colour_of_height(double share);

/// The grey of the ground's elevation, as a share of the highest: the higher the lighter.
[[nodiscard]] Colour colour_of_ground(double share);

/// Darker or lighter, by a factor around 1.
[[nodiscard]] Colour lit(Colour colour, float factor);

/// The colour of pixels without data: a grey that is not in the colour map.
inline constexpr Colour nodata_colour{190, 190, 190};

/// What all pictures with words have in common.
inline constexpr Colour ink{32, 32, 32}, muted{96, 96, 96};
inline constexpr double title_height = 22.0, text_height = 15.0;
inline constexpr double half_digit_height = 0.36;  ///< of a font's size
inline constexpr double rad_per_deg = std::numbers::pi / 180.0;

}  // namespace farlod
