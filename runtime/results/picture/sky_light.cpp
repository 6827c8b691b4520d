// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/sky_light.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "results/picture/picture.hpp"

namespace farlod {
namespace {

/// ColorBrewer's OrRd without its palest: from little to much, and apart from the sky, from all geometry, and for the
/// colour-blind.
constexpr std::array<Colour, 5> sun_colours{{{254, 240, 217}, {253, 204, 138}, {252, 141, 89}, {227, 74, 51}, {153, 0, 0}}};
constexpr double strongest_sun_w_m2 = 1000.0;
/// Paler than near geometry, darker than the sky, and no colour of a sun that is seen.
constexpr Colour hidden_sun{150, 154, 164};
constexpr double seen_radius = 2.6, hidden_radius = 1.3;

std::uint8_t between_channels(std::uint8_t from, std::uint8_t to, double share) {
  return static_cast<std::uint8_t>(std::lround(from + share * (to - from)));
}

}  // namespace

Colour colour_of_sun(double direct_w_m2) {
  constexpr std::size_t last = sun_colours.size() - 1;
  const double place = std::clamp(direct_w_m2 / strongest_sun_w_m2, 0.0, 1.0) * static_cast<double>(last);
  const std::size_t below = std::min(static_cast<std::size_t>(place), last - 1);
  const double share = place - static_cast<double>(below);
  const Colour &a = sun_colours[below], &b = sun_colours[below + 1];
  return {between_channels(a.red, b.red, share), between_channels(a.green, b.green, share),
          between_channels(a.blue, b.blue, share)};
}

void add_suns(Drawing& drawing, const Hemisphere& hemisphere, SkyProjection projection, const LightOfSky& light) {
  for (const LitSun& sun : light.suns) {
    const PagePoint place = sky_page_point(sun.direction, projection);
    const bool hidden = is_hidden(hemisphere, sun.direction);
    drawing.shapes.emplace_back(
        disc(place, hidden ? hidden_radius : seen_radius, hidden ? hidden_sun : colour_of_sun(sun.direct_w_m2)));
  }
}

void add_light_legend(Drawing& drawing, PagePoint upper_left, const LightOfSky& light) {
  constexpr double step = 24.0, base_line = 12.0, ramp_width = 150.0, ramp_height = 12.0;
  const double x = upper_left.x;
  double y = upper_left.y;
  const auto add_text = [&](const std::string& words, double indent, Colour colour) {
    drawing.shapes.emplace_back(Text{{x + indent, y + base_line}, words, text_height, Alignment::left, colour});
    y += step;
  };
  add_text("Sun of the period, W/m²", 0.0, ink);
  // A box for each pixel of the ramp
  for (int n = 0; n < static_cast<int>(ramp_width); ++n)
    drawing.shapes.emplace_back(box({x + n, y}, 1.0, ramp_height, colour_of_sun(strongest_sun_w_m2 * n / (ramp_width - 1.0))));
  y += ramp_height + 2.0;
  drawing.shapes.emplace_back(Text{{x, y + base_line}, "0", text_height, Alignment::left, ink});
  drawing.shapes.emplace_back(Text{{x + ramp_width, y + base_line}, "1000", text_height, Alignment::right, ink});
  y += step;
  drawing.shapes.emplace_back(box({x, y - 1.0}, 16.0, 16.0, colour_of(SkyPart::near)));
  drawing.shapes.emplace_back(disc({x + 8.0, y + 7.0}, 2.0 * hidden_radius, hidden_sun));
  add_text("hidden", 26.0, ink);
  y += 0.5 * step;
  for (const std::string& words : light.legend) add_text(words, 0.0, ink);
}

}  // namespace farlod
