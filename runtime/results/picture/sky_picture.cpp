// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/sky_picture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "results/decimal.hpp"
#include "results/picture/picture_style.hpp"
#include "results/picture/sun_courses.hpp"

namespace farlod {
namespace {

constexpr double pi = std::numbers::pi;

// Alike to nobody, whatever colours he sees, and of three steps of lightness (sky, far, near), so that print keeps them apart
constexpr Colour sky_colour{205, 229, 248}, far_colour{230, 159, 0}, near_colour{66, 66, 76};
// Between the lightness of what is far and what is near
constexpr Colour crown_colour{0, 140, 100};
constexpr Colour horizon_colour{0, 84, 147}, ring_colour{140, 150, 160};
constexpr std::size_t disk_edge = 800, disk_left = 56, disk_top = 116;
constexpr PixelSize sky_picture_size{disk_left + disk_edge + 56 + 230, disk_top + disk_edge + 60};

/// The distance from the middle, and its inverse.
double radius_of(double zenith_angle, SkyProjection projection) {
  switch (projection) {
    case SkyProjection::equidistant:
      return zenith_angle / (0.5 * pi);
    case SkyProjection::equal_area:
      return std::numbers::sqrt2 * std::sin(0.5 * zenith_angle);
    case SkyProjection::orthographic:
      break;
  }
  return std::sin(zenith_angle);
}
double zenith_angle_of(double radius, SkyProjection projection) {
  switch (projection) {
    case SkyProjection::equidistant:
      return radius * 0.5 * pi;
    case SkyProjection::equal_area:
      return 2.0 * std::asin(radius / std::numbers::sqrt2);
    case SkyProjection::orthographic:
      break;
  }
  return std::asin(radius);
}

std::string name_of(SkyProjection projection) {
  if (projection == SkyProjection::equidistant) return "equidistant";
  return projection == SkyProjection::equal_area ? "equal-area" : "orthographic";
}

constexpr double disk_radius = 0.5 * disk_edge;

PagePoint page_point_of(const DiskPoint& p) {
  return {static_cast<double>(disk_left) + disk_radius * (1.0 + p.u), static_cast<double>(disk_top) + disk_radius * (1.0 - p.v)};
}

PagePoint page_point_at(double azimuth_deg, double elevation_deg, SkyProjection projection) {
  return sky_page_point({azimuth_deg, 90.0 - elevation_deg}, projection);
}

Line ring(double elevation_deg, SkyProjection projection, double width, Colour colour) {
  Line line{{}, width, colour};
  for (int n = 0; n <= 360; ++n) line.places.push_back(page_point_at(n, elevation_deg, projection));
  return line;
}

Line horizon_line(const Hemisphere& hemisphere, SkyProjection projection) {
  Line line{{}, 1.2, horizon_colour};
  const double step_deg = 360.0 / static_cast<double>(hemisphere.azimuths);
  for (std::size_t n = 0; n <= hemisphere.azimuths; ++n) {
    const double elevation_deg = std::atan(hemisphere.horizon[n % hemisphere.azimuths]) / rad_per_deg;
    // From one end of the part to the other
    line.places.push_back(page_point_at(static_cast<double>(n) * step_deg, elevation_deg, projection));
    if (n < hemisphere.azimuths)
      line.places.push_back(page_point_at(static_cast<double>(n + 1) * step_deg, elevation_deg, projection));
  }
  return line;
}

void add_rings(Drawing& drawing, SkyProjection projection) {
  for (const int elevation_deg : {30, 60}) {
    drawing.shapes.emplace_back(ring(elevation_deg, projection, 0.7, ring_colour));
    // Between the directions, where no other text is
    const PagePoint place = page_point_at(45.0, elevation_deg, projection);
    drawing.shapes.emplace_back(
        Text{{place.x + 3.0, place.y - 3.0}, std::to_string(elevation_deg) + "°", 12.0, Alignment::left, ring_colour});
  }
  drawing.shapes.emplace_back(ring(0.0, projection, 1.5, ink));
}

void add_directions(Drawing& drawing) {
  const double middle_x = static_cast<double>(disk_left) + disk_radius, middle_y = static_cast<double>(disk_top) + disk_radius;
  const double away = disk_radius + 14.0, half_height = 0.36 * 20.0;
  const auto add = [&](const char* letter, double x, double y, Alignment alignment) {
    drawing.shapes.emplace_back(Text{{x, y}, letter, 20.0, alignment, ink});
  };
  add("N", middle_x, middle_y - away, Alignment::centre);
  add("S", middle_x, middle_y + away + 2.0 * half_height, Alignment::centre);
  add("E", middle_x - away, middle_y + half_height, Alignment::right);
  add("W", middle_x + away, middle_y + half_height, Alignment::left);
}

/// The colours that a picture may have, and what they mean.
std::vector<std::pair<SkyPart, const char*>> colours_of(const Hemisphere& hemisphere) {
  std::vector<std::pair<SkyPart, const char*>> colours{
      {SkyPart::sky, "sky"}, {SkyPart::near, "near geometry"}, {SkyPart::far, "far geometry"}};
  if (std::ranges::find(hemisphere.parts, SkyPart::crown) != hemisphere.parts.end())
    colours.emplace_back(SkyPart::crown, "crowns of trees");
  return colours;
}

void add_legend(Drawing& drawing, const Hemisphere& hemisphere, SkyProjection projection, const std::optional<SunOfSky>& sun) {
  const double x = static_cast<double>(disk_left + disk_edge) + 56.0;
  double y = static_cast<double>(disk_top) + 10.0;
  const auto add_text = [&](const std::string& words, double indent, Colour colour) {
    drawing.shapes.emplace_back(Text{{x + indent, y + 12.0}, words, text_height, Alignment::left, colour});
    y += 24.0;
  };
  for (const auto& [part, words] : colours_of(hemisphere)) {
    drawing.shapes.emplace_back(box({x, y - 1.0}, 16.0, 16.0, ink));
    drawing.shapes.emplace_back(box({x + 1.0, y}, 14.0, 14.0, colour_of(part)));
    add_text(words, 26.0, ink);
  }
  drawing.shapes.emplace_back(Line{{{x, y + 7.0}, {x + 16.0, y + 7.0}}, 2.0, horizon_colour});
  add_text("horizon", 26.0, ink);
  y += 12.0;
  for (const std::string& words : {std::string("Seen from below:"), std::string("north up, east on the left"),
                                   std::string("True north"), "Projection: " + name_of(projection)})
    add_text(words, 0.0, muted);
  if (sun) add_sun_legend(drawing, {x, y + 12.0}, *sun);
}

}  // namespace

DiskPoint disk_point_of(const HemisphereDirection& direction, SkyProjection projection) {
  const double radius = radius_of(direction.zenith_angle_deg * rad_per_deg, projection),
               azimuth = direction.azimuth_deg * rad_per_deg;
  return {-radius * std::sin(azimuth), radius * std::cos(azimuth)};
}

std::optional<HemisphereDirection> direction_of(const DiskPoint& point, SkyProjection projection) {
  const double radius = std::hypot(point.u, point.v);
  if (radius > 1.0) return std::nullopt;
  const double azimuth_deg = std::atan2(-point.u, point.v) / rad_per_deg;
  return HemisphereDirection{azimuth_deg < 0.0 ? azimuth_deg + 360.0 : azimuth_deg,
                             zenith_angle_of(radius, projection) / rad_per_deg};
}

Colour colour_of(SkyPart part) {
  if (part == SkyPart::sky) return sky_colour;
  if (part == SkyPart::crown) return crown_colour;
  return part == SkyPart::near ? near_colour : far_colour;
}

PagePoint sky_page_point(const HemisphereDirection& direction, SkyProjection projection) {
  return page_point_of(disk_point_of(direction, projection));
}

Picture draw_sky_disk(const Hemisphere& hemisphere, SkyProjection projection, std::size_t edge) {
  Picture picture({edge, edge}, {255, 255, 255});
  const auto number_of = [](double share, std::size_t count) {
    return std::min(static_cast<std::size_t>(share * static_cast<double>(count)), count - 1);
  };
  const double pixel = 2.0 / static_cast<double>(edge);
  for (std::size_t y = 0; y < edge; ++y)
    for (std::size_t x = 0; x < edge; ++x) {
      const DiskPoint place{(static_cast<double>(x) + 0.5) * pixel - 1.0, 1.0 - (static_cast<double>(y) + 0.5) * pixel};
      const auto direction = direction_of(place, projection);
      if (!direction) continue;
      const std::size_t azimuth = number_of(direction->azimuth_deg / 360.0, hemisphere.azimuths);
      const std::size_t elevation = number_of(1.0 - direction->zenith_angle_deg / 90.0, hemisphere.elevations);
      picture.set({x, y}, colour_of(hemisphere.part(azimuth, elevation)));
    }
  return picture;
}

Drawing draw_sky(const Hemisphere& hemisphere, SkyProjection projection, const SkyCaption& caption,
                 const std::optional<SunOfSky>& sun) {
  const std::string name = caption.quantity == "svf" ? "Sky view factor (svf) " : "Solid angle share of the sky (svf_solid) ";
  Drawing drawing{sky_picture_size, name + svf_decimal(hemisphere.svf).substr(0, 6)};
  drawing.shapes.emplace_back(Text{{24.0, 46.0}, drawing.title, title_height, Alignment::left, ink});
  drawing.shapes.emplace_back(Text{{24.0, 74.0}, caption.place, text_height, Alignment::left, muted});
  drawing.shapes.emplace_back(Image{{disk_left, disk_top}, draw_sky_disk(hemisphere, projection, disk_edge)});
  add_rings(drawing, projection);
  drawing.shapes.emplace_back(horizon_line(hemisphere, projection));
  if (sun) add_sun_courses(drawing, hemisphere, projection, *sun);
  add_directions(drawing);
  add_legend(drawing, hemisphere, projection, sun);
  return drawing;
}

}  // namespace farlod
