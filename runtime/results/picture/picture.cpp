// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/picture.hpp"

#include "base/expects.hpp"

namespace farlod {

Picture::Picture(PixelSize size, Colour background) : size_(size), pixels_(size.width * size.height, background) {}

Colour Picture::at(Pixel pixel) const {
  FARLOD_EXPECTS(pixel.x < size_.width && pixel.y < size_.height);
  return pixels_[pixel.y * size_.width + pixel.x];
}

void Picture::set(Pixel pixel, Colour colour) {
  if (pixel.x < size_.width && pixel.y < size_.height) pixels_[pixel.y * size_.width + pixel.x] = colour;
}

void Picture::fill(Pixel upper_left, PixelSize size, Colour colour) {
  for (std::size_t y = 0; y < size.height; ++y)
    for (std::size_t x = 0; x < size.width; ++x) set({upper_left.x + x, upper_left.y + y}, colour);
}

}  // namespace farlod
