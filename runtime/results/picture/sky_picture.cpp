// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/sky_picture.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/expects.hpp"
#include "results/picture/picture.hpp"
#include "results/picture/sky_light.hpp"

namespace farlod {
namespace {

// Darker than the sky, and paler than all geometry; apart from each other, and from the horizon, also for the colour-blind
struct CourseColours {
  Colour seen, hidden;
};
constexpr std::array<CourseColours, 3> course_colours{
    {{{178, 24, 43}, {250, 200, 200}}, {{0, 96, 72}, {176, 236, 214}}, {{84, 39, 136}, {216, 200, 240}}}};
constexpr Colour halo{255, 255, 255};
constexpr double course_width = 2.4, halo_width = 4.6, dot_radius = 4.0;
constexpr double hour_label_height = 13.0, label_away = 15.5, least_room = 17.0;
constexpr std::size_t minutes_of_hour = 60;

/// A minute of a course, as it is drawn.
struct Minute {
  PagePoint place;
  bool is_up = false, is_hidden = false;
};

std::vector<Minute> minutes_of(const SunCourse& course, const Hemisphere& hemisphere, SkyProjection projection) {
  std::vector<Minute> minutes;
  for (const HemisphereDirection& d : course.minutes) {
    const bool is_up = d.zenith_angle_deg < 90.0;
    minutes.push_back(is_up ? Minute{sky_page_point(d, projection), true, is_hidden(hemisphere, d)} : Minute{});
  }
  return minutes;
}

/// A line, twice: what lies below it is kept away from it.
void add_cased(Drawing& drawing, std::vector<PagePoint> places, bool is_hidden, const CourseColours& colours) {
  const std::vector<double> dashes = is_hidden ? std::vector{5.0, 4.0} : std::vector<double>{};
  if (!is_hidden) drawing.shapes.emplace_back(Line{places, halo_width, halo});
  drawing.shapes.emplace_back(Line{std::move(places), course_width, is_hidden ? colours.hidden : colours.seen, dashes});
}

/// A line for each stretch of time in which the sun is seen, or hidden.
void add_line(Drawing& drawing, const std::vector<Minute>& minutes, const CourseColours& colours) {
  for (std::size_t begin = 0; begin < minutes.size();) {
    std::size_t end = begin + 1;
    while (end < minutes.size() && minutes[end].is_up == minutes[begin].is_up &&
           minutes[end].is_hidden == minutes[begin].is_hidden)
      ++end;
    std::vector<PagePoint> places;
    // Up to where the next one begins
    for (std::size_t n = begin; n < minutes.size() && n <= end && minutes[n].is_up; ++n) places.push_back(minutes[n].place);
    if (minutes[begin].is_up && places.size() > 1) add_cased(drawing, std::move(places), minutes[begin].is_hidden, colours);
    begin = end;
  }
}

void add_dot(Drawing& drawing, const Minute& hour, const CourseColours& colours) {
  drawing.shapes.emplace_back(disc(hour.place, dot_radius + 1.2, halo));
  drawing.shapes.emplace_back(disc(hour.place, dot_radius, colours.seen));
  if (hour.is_hidden) drawing.shapes.emplace_back(disc(hour.place, dot_radius - 1.6, colours.hidden));
}

double distance(PagePoint a, PagePoint b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// Where the numbers of hours stand: beside the line, on the side that looks away from the zenith when the sun is highest.
class HourLabels {
 public:
  HourLabels(Drawing& drawing, SkyProjection projection)
      : drawing_(drawing),
        zenith_(sky_page_point({0.0, 0.0}, projection)),
        radius_(sky_page_point({270.0, 90.0}, projection).x - zenith_.x) {}

  void add(const SunCourse& course, const std::vector<Minute>& minutes, Colour colour) {
    const auto highest = static_cast<std::size_t>(
        std::ranges::min_element(course.minutes, {}, &HemisphereDirection::zenith_angle_deg) - course.minutes.begin());
    if (!minutes[highest].is_up) return;
    const PagePoint away = across(minutes, highest), up = minutes[highest].place;
    const double side = away.x * (up.x - zenith_.x) + away.y * (up.y - zenith_.y) < 0.0 ? -1.0 : 1.0;
    for (std::size_t hour = 0; hour * minutes_of_hour < minutes.size(); ++hour)
      if (minutes[hour * minutes_of_hour].is_up) add_hour(hour, minutes, side, colour);
  }

 private:
  /// The unit vector across the line at some minute.
  static PagePoint across(const std::vector<Minute>& minutes, std::size_t n) {
    const auto up_or = [&](std::size_t other) { return minutes[other].is_up ? minutes[other].place : minutes[n].place; };
    const PagePoint before = up_or(n == 0 ? n : n - 1), after = up_or(std::min(n + 1, minutes.size() - 1));
    const double length = std::max(distance(before, after), 1e-9);
    return {(before.y - after.y) / length, (after.x - before.x) / length};
  }

  void add_hour(std::size_t hour, const std::vector<Minute>& minutes, double side, Colour colour) {
    const std::size_t n = hour * minutes_of_hour;
    const PagePoint dot = minutes[n].place, across_line = across(minutes, n);
    const auto beside = [&](double away) { return PagePoint{dot.x + away * across_line.x, dot.y + away * across_line.y}; };
    PagePoint middle = beside(side * label_away);
    if (distance(middle, zenith_) > radius_ - label_away) middle = beside(-side * label_away);
    const auto is_near = [&](PagePoint other) { return distance(middle, other) < least_room; };
    if (std::ranges::any_of(taken_, is_near)) return;
    taken_.push_back(middle);
    drawing_.shapes.emplace_back(Text{{middle.x, middle.y + 0.36 * hour_label_height},
                                      std::to_string(hour),
                                      hour_label_height,
                                      Alignment::centre,
                                      colour,
                                      halo});
  }

  Drawing& drawing_;
  PagePoint zenith_;
  double radius_;
  std::vector<PagePoint> taken_;
};

/// Draws the ways of the sun over a picture of the sky, with a dot at each full hour and its number where there is room. Where
/// geometry hides the sun, the line is pale and dashed, and the dots are hollow.
void add_sun_courses(Drawing& drawing, const Hemisphere& hemisphere, SkyProjection projection, const SunOfSky& sun) {
  FARLOD_EXPECTS(sun.courses.size() <= course_colours.size());
  std::vector<std::vector<Minute>> courses;
  for (const SunCourse& course : sun.courses) courses.push_back(minutes_of(course, hemisphere, projection));
  for (std::size_t n = 0; n < courses.size(); ++n) add_line(drawing, courses[n], course_colours[n]);
  for (std::size_t n = 0; n < courses.size(); ++n)
    for (std::size_t m = 0; m < courses[n].size(); m += minutes_of_hour)
      if (courses[n][m].is_up) add_dot(drawing, courses[n][m], course_colours[n]);
  HourLabels labels(drawing, projection);
  for (std::size_t n = 0; n < courses.size(); ++n) labels.add(sun.courses[n], courses[n], course_colours[n].seen);
}

/// Which line is which day, and the lines of text of the sun. Returns where it ends.
double add_sun_legend(Drawing& drawing, PagePoint upper_left, const SunOfSky& sun) {
  constexpr double step = 24.0, sample = 30.0, indent = 40.0, middle_of_line = 7.0, base_line = 12.0;
  const double x = upper_left.x;
  double y = upper_left.y;
  const auto add_text = [&](const std::string& words, double from) {
    drawing.shapes.emplace_back(Text{{x + from, y + base_line}, words, text_height, Alignment::left, ink});
    y += step;
  };
  add_text("Sun's path, hours", 0.0);
  for (std::size_t n = 0; n < sun.courses.size(); ++n) {
    const double at = y + middle_of_line;
    drawing.shapes.emplace_back(Line{{{x, at}, {x + sample, at}}, course_width, course_colours[n].seen});
    drawing.shapes.emplace_back(disc({x + 0.5 * sample, at}, dot_radius, course_colours[n].seen));
    add_text(sun.courses[n].day, indent);
  }
  // On what hides it, as in the picture
  drawing.shapes.emplace_back(box({x - 2.0, y}, sample + 4.0, 2.0 * middle_of_line, colour_of(SkyPart::near)));
  const double at = y + middle_of_line;
  add_cased(drawing, {{x, at}, {x + sample, at}}, true, course_colours.front());
  add_dot(drawing, {{x + 0.5 * sample, at}, true, true}, course_colours.front());
  add_text("hidden by geometry", indent);
  y += 0.5 * step;
  for (const std::string& words : sun.legend) add_text(words, 0.0);
  return y;
}

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
        Text{{place.x + 3.0, place.y - 3.0}, std::to_string(elevation_deg) + "°", 13.0, Alignment::left, ink, halo});
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

/// The colours that a picture has, and what they mean.
std::vector<std::pair<SkyPart, const char*>> colours_of(const Hemisphere& hemisphere) {
  constexpr std::array<std::pair<SkyPart, const char*>, 4> words{{{SkyPart::sky, "sky that is seen"},
                                                                  {SkyPart::near, "buildings, ground: near"},
                                                                  {SkyPart::far, "buildings, ground: far"},
                                                                  {SkyPart::crown, "crowns of trees"}}};
  std::vector<std::pair<SkyPart, const char*>> colours;
  for (const auto& row : words)
    if (std::ranges::find(hemisphere.parts, row.first) != hemisphere.parts.end()) colours.push_back(row);
  return colours;
}

/// Returns where it ends.
PagePoint add_legend(Drawing& drawing, const Hemisphere& hemisphere, SkyProjection projection) {
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
  add_text("horizon, sky above it", 26.0, ink);
  y += 12.0;
  for (const std::string& words : {std::string("Seen from below:"), std::string("north up, east on the left"),
                                   std::string("True north"), "Projection: " + name_of(projection)})
    add_text(words, 0.0, muted);
  return {x, y + 12.0};
}

/// As the terminal rounds it.
std::string four_digits(float svf) { return fmt::format("{:.4f}", svf); }

}  // namespace

bool is_hidden(const Hemisphere& hemisphere, const HemisphereDirection& d) {
  const auto part_of = [](double share, std::size_t count) {
    return std::min(static_cast<std::size_t>(share * static_cast<double>(count)), count - 1);
  };
  const std::size_t azimuth = part_of(std::fmod(d.azimuth_deg, 360.0) / 360.0, hemisphere.azimuths),
                    elevation = part_of(1.0 - d.zenith_angle_deg / 90.0, hemisphere.elevations);
  return hemisphere.part(azimuth, elevation) != SkyPart::sky;
}

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
                 const std::optional<SunOfSky>& sun, const std::optional<LightOfSky>& light) {
  const std::string name = caption.quantity == "svf" ? "Sky view factor (svf) " : "Solid angle share of the sky (svf_solid) ";
  const std::string with_trees = caption.svf_total ? ", with trees " + four_digits(*caption.svf_total) : "";
  Drawing drawing{sky_picture_size, name + four_digits(hemisphere.svf) + with_trees};
  drawing.shapes.emplace_back(Text{{24.0, 46.0}, drawing.title, title_height, Alignment::left, ink});
  drawing.shapes.emplace_back(Text{{24.0, 74.0}, caption.place, text_height, Alignment::left, muted});
  drawing.shapes.emplace_back(Image{{disk_left, disk_top}, draw_sky_disk(hemisphere, projection, disk_edge)});
  add_rings(drawing, projection);
  drawing.shapes.emplace_back(horizon_line(hemisphere, projection));
  if (light) add_suns(drawing, hemisphere, projection, *light);
  if (sun) add_sun_courses(drawing, hemisphere, projection, *sun);
  add_directions(drawing);
  PagePoint legend = add_legend(drawing, hemisphere, projection);
  if (sun) legend.y = add_sun_legend(drawing, legend, *sun) + 12.0;
  if (light) add_light_legend(drawing, legend, *light);
  return drawing;
}

}  // namespace farlod
