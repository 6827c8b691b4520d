// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "results/picture/cell_plan.hpp"
#include "results/picture/colour_map.hpp"

// What readers see of our colours who lack one kind of cones, or who have a print in grey

namespace farlod {
namespace {

using Channels = std::array<double, 3>;
using Matrix = std::array<Channels, 3>;

struct Vision {
  std::string name;
  Matrix matrix;
};

/// Machado, Oliveira and Fernandes (2009), severity 1, for linear sRGB; grey has the luminance of IEC 61966-2-1.
const std::array<Vision, 4> visions{
    Vision{"protanopia", {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}}},
    Vision{"deuteranopia", {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}}},
    Vision{"tritanopia", {{{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}}},
    Vision{"grey", {{{0.2126, 0.7152, 0.0722}, {0.2126, 0.7152, 0.0722}, {0.2126, 0.7152, 0.0722}}}}};

double linear_channel(std::uint8_t c) {
  const double v = c / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

double product(const Channels& a, const Channels& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// CIELAB (white D65) of a colour as somebody sees it: lightness, and the two axes of hue.
Channels lab_of(Colour colour, const Vision& vision) {
  const Channels rgb{linear_channel(colour.red), linear_channel(colour.green), linear_channel(colour.blue)};
  Channels seen{};
  for (std::size_t n = 0; n < 3; ++n) seen[n] = std::clamp(product(vision.matrix[n], rgb), 0.0, 1.0);
  constexpr Matrix xyz{{{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}};
  constexpr Channels white{0.9505, 1.0, 1.089};
  Channels f{};
  for (std::size_t n = 0; n < 3; ++n) {
    const double t = product(xyz[n], seen) / white[n];
    f[n] = t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0;
  }
  return {116.0 * f[1] - 16.0, 500.0 * (f[0] - f[1]), 200.0 * (f[1] - f[2])};
}

/// CIE 1976.
double difference(Colour a, Colour b, const Vision& vision) {
  const Channels p = lab_of(a, vision), q = lab_of(b, vision);
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

TEST(ColourVision, LightnessRisesWithTheShareForEverybody) {
  for (const Vision& vision : visions)
    for (int n = 1; n <= 50; ++n)
      EXPECT_GT(lab_of(colour_of_svf(n / 50.0), vision)[0], lab_of(colour_of_svf((n - 1) / 50.0), vision)[0])
          << vision.name << ' ' << n / 50.0;
}

TEST(ColourVision, ATenthIsSeenByEverybody) {
  // A difference of 2.3 is the least that is noticed side by side (Mahy, Van Eycken and Oosterlinck 1994)
  constexpr double noticed = 2.3;
  for (const Vision& vision : visions)
    for (int n = 1; n <= 10; ++n)
      EXPECT_GT(difference(colour_of_svf(n / 10.0), colour_of_svf((n - 1) / 10.0), vision), 2.0 * noticed)
          << vision.name << ' ' << n / 10.0;
}

TEST(ColourVision, LargerErrorsAreDarkerForEverybody) {
  for (const Vision& vision : visions)
    for (int n = 1; n <= 20; ++n)
      for (const double sign : {-1.0, 1.0})
        EXPECT_LT(lab_of(colour_of_error(sign * n / 20.0), vision)[0], lab_of(colour_of_error(sign * (n - 1) / 20.0), vision)[0])
            << vision.name << ' ' << sign * n / 20.0;
}

TEST(ColourVision, SignsOfErrorsAreToldApartByEverybodyButInGrey) {
  constexpr double clear = 10.0;
  for (const Vision& vision : visions)
    for (int n = 4; n <= 20 && vision.name != "grey"; ++n)
      EXPECT_GT(difference(colour_of_error(n / 20.0), colour_of_error(-n / 20.0), vision), clear)
          << vision.name << ' ' << n / 20.0;
}

TEST(ColourVision, ZonesOfACellAreToldApartByEverybody) {
  constexpr double clear = 10.0;
  for (const Vision& vision : visions)
    for (const auto& [a, b] :
         {std::pair{CellZone::cell, CellZone::near}, {CellZone::near, CellZone::far}, {CellZone::cell, CellZone::far}})
      EXPECT_GT(difference(building_colour(a), building_colour(b), vision), clear) << vision.name;
  for (const Vision& vision : visions)
    for (const CellZone zone : {CellZone::cell, CellZone::near, CellZone::far})
      EXPECT_GT(difference(building_colour(zone), street_colour(zone), vision), 2.0 * clear) << vision.name;
}

}  // namespace
}  // namespace farlod
