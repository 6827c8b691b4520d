// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/sun_courses.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/expects.hpp"
#include "results/picture/map_ornaments.hpp"
#include "results/picture/picture_style.hpp"

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

bool is_hidden(const Hemisphere& hemisphere, const HemisphereDirection& d) {
  const auto part_of = [](double share, std::size_t count) {
    return std::min(static_cast<std::size_t>(share * static_cast<double>(count)), count - 1);
  };
  const std::size_t azimuth = part_of(std::fmod(d.azimuth_deg, 360.0) / 360.0, hemisphere.azimuths),
                    elevation = part_of(1.0 - d.zenith_angle_deg / 90.0, hemisphere.elevations);
  return hemisphere.part(azimuth, elevation) != SkyPart::sky;
}

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

}  // namespace

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

void add_sun_legend(Drawing& drawing, PagePoint upper_left, const SunOfSky& sun) {
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
}

}  // namespace farlod
