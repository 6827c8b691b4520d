// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
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

}  // namespace farlod
