// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/expects.hpp"

namespace farlod {
namespace {

// Viridis (S. van der Walt and N. Smith, 2015, placed in the public domain) at every eighth
constexpr std::array<Colour, 9> viridis{{{68, 1, 84},
                                         {71, 44, 122},
                                         {59, 81, 139},
                                         {44, 113, 142},
                                         {33, 144, 141},
                                         {39, 173, 129},
                                         {92, 200, 99},
                                         {170, 220, 50},
                                         {253, 231, 37}}};

// PuOr of ColorBrewer (Harrower and Brewer 2003), every other colour of eleven, the other way round
constexpr std::array<Colour, 7> violet_to_brown{
    {{45, 0, 75}, {128, 115, 172}, {216, 218, 235}, {247, 247, 247}, {254, 224, 182}, {224, 130, 20}, {127, 59, 8}}};

// YlOrRd of ColorBrewer (Harrower and Brewer 2003), seven colours without the palest
constexpr std::array<Colour, 6> yellow_to_red{
    {{254, 217, 118}, {254, 178, 76}, {253, 141, 60}, {252, 78, 42}, {227, 26, 28}, {177, 0, 38}}};

constexpr std::array<Colour, 2> greys{{{150, 158, 162}, {236, 238, 238}}};

std::uint8_t mix(std::uint8_t a, std::uint8_t b, double share_of_b) {
  return static_cast<std::uint8_t>(std::lround((1.0 - share_of_b) * a + share_of_b * b));
}

/// Linear between the colours of a map, from 0 to 1.
template <std::size_t count>
Colour colour_at(double share, const std::array<Colour, count>& map) {
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(count - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(place), count - 2);
  const Colour a = map[below], b = map[below + 1];
  const double t = place - static_cast<double>(below);
  return {mix(a.red, b.red, t), mix(a.green, b.green, t), mix(a.blue, b.blue, t)};
}

}  // namespace

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

Colour colour_of_svf(double svf) {
  FARLOD_EXPECTS(!std::isnan(svf));
  return colour_at(svf, viridis);
}

Colour colour_of_error(double share) {
  FARLOD_EXPECTS(!std::isnan(share));
  return colour_at(0.5 * (1.0 + share), violet_to_brown);
}

Colour colour_of_height(double share) {
  FARLOD_EXPECTS(!std::isnan(share));
  return colour_at(share, yellow_to_red);
}

Colour colour_of_ground(double share) {
  FARLOD_EXPECTS(!std::isnan(share));
  return colour_at(share, greys);
}

Colour lit(Colour colour, float factor) {
  const auto channel = [&](std::uint8_t c) {
    const double value = factor <= 1.0F ? c * static_cast<double>(factor) : c + (255.0 - c) * (static_cast<double>(factor) - 1.0);
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
  };
  return {channel(colour.red), channel(colour.green), channel(colour.blue)};
}

}  // namespace farlod
