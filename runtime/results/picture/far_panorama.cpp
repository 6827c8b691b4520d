// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/far_panorama.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "results/picture/picture.hpp"
#include "results/picture/sky_picture.hpp"

namespace farlod {
namespace {

constexpr Colour hidden_colour{230, 159, 0}, undecided_colour{250, 222, 160}, edge_colour{102, 62, 0};
constexpr Colour estimate_colour{0, 84, 147}, grid_colour{140, 150, 160};
constexpr double label_height = 12.0;

double turned(double azimuth_deg) {
  const double rest = std::fmod(azimuth_deg, 360.0);
  return rest < 0.0 ? rest + 360.0 : rest;
}

bool is_box(const FarView& view) { return !view.box.distance_m.empty(); }

/// A panorama of azimuths: places on paper by what an observer sees.
struct Panorama {
  PageBox where;
  double top_deg = 90.0;

  [[nodiscard]] double x_of(double azimuth_deg) const { return where.upper_left.x + azimuth_deg / 360.0 * where.width; }
  [[nodiscard]] double y_of(double elevation_deg) const {
    return where.upper_left.y + where.height * (1.0 - std::clamp(elevation_deg, 0.0, top_deg) / top_deg);
  }
  [[nodiscard]] PagePoint lower_right() const { return {where.upper_left.x + where.width, where.upper_left.y + where.height}; }
};

/// The upper side of what is below some slopes, from the north to the north: a step for each column of pixels.
std::vector<PagePoint> steps_of(const std::vector<float>& slopes, Angle first_azimuth, const Panorama& panorama) {
  std::vector<PagePoint> places;
  const auto columns = static_cast<std::size_t>(panorama.where.width);
  for (std::size_t column = 0; column < columns; ++column) {
    const double azimuth_deg = (static_cast<double>(column) + 0.5) / static_cast<double>(columns) * 360.0;
    const double turn = turned(azimuth_deg - first_azimuth.degrees()) / 360.0;
    const std::size_t bin = std::min(static_cast<std::size_t>(turn * static_cast<double>(slopes.size())), slopes.size() - 1);
    const double y = panorama.y_of(std::atan(static_cast<double>(slopes[bin])) / rad_per_deg);
    const double x = panorama.where.upper_left.x + static_cast<double>(column);
    places.push_back({x, y});
    places.push_back({x + 1.0, y});
  }
  return places;
}

Polygon area_below(std::vector<PagePoint> steps, const Panorama& panorama, Colour colour) {
  steps.push_back({steps.back().x, panorama.lower_right().y});
  steps.push_back({panorama.where.upper_left.x, panorama.lower_right().y});
  return {std::move(steps), colour};
}

/// A straight edge is bent on a panorama.
constexpr int parts_of_edge = 12;

void add_edges(Drawing& drawing, const FarView& view, Angle convergence, const Panorama& panorama) {
  Segments lines{{}, 0.8, edge_colour};
  for (const FarEdge& edge : view.horizon.edges) {
    std::optional<SeenPlace> last;
    for (int n = 0; n <= parts_of_edge; ++n) {
      const Point3d p = edge.a_projected + n / static_cast<double>(parts_of_edge) * (edge.b_projected - edge.a_projected);
      const SeenPlace seen = seen_from(view.eye_projected, p, convergence);
      // What crosses the north would run through the whole picture
      if (last && std::abs(seen.azimuth_deg - last->azimuth_deg) < 180.0 &&
          std::max(seen.elevation_deg, last->elevation_deg) > 0.0)
        lines.segments.push_back({{panorama.x_of(last->azimuth_deg), panorama.y_of(last->elevation_deg)},
                                  {panorama.x_of(seen.azimuth_deg), panorama.y_of(seen.elevation_deg)}});
      last = seen;
    }
  }
  if (!lines.segments.empty()) drawing.shapes.emplace_back(std::move(lines));
}

void add_elevations(Drawing& drawing, const Panorama& panorama) {
  const int step_deg = panorama.top_deg > 45.0 ? 15 : panorama.top_deg > 10.0 ? 5 : 1;
  for (int elevation = 0; elevation <= std::lround(panorama.top_deg); elevation += step_deg) {
    const double y = panorama.y_of(elevation), left = panorama.where.upper_left.x;
    drawing.shapes.emplace_back(Line{{{left, y}, {left + panorama.where.width, y}}, elevation > 0 ? 0.4 : 1.2, grid_colour});
    drawing.shapes.emplace_back(
        Text{{left - 6.0, y + 4.0}, std::to_string(elevation) + "°", label_height, Alignment::right, ink});
  }
}

void add_direction(Drawing& drawing, const PageBox& where, double x, const std::string& letter) {
  const double top = where.upper_left.y, bottom = top + where.height;
  drawing.shapes.emplace_back(Line{{{x, top}, {x, bottom + 6.0}}, 0.6, grid_colour});
  drawing.shapes.emplace_back(Text{{x, bottom + 24.0}, letter, 18.0, Alignment::centre, ink});
}

void add_horizon(Drawing& drawing, const PageBox& where, const FarView& view, Angle convergence) {
  const Panorama panorama{where, top_of_panorama_deg(view, convergence)};
  const FarHorizonView& h = view.horizon;
  drawing.shapes.emplace_back(box(where.upper_left, where.width, where.height, colour_of(SkyPart::sky)));
  drawing.shapes.emplace_back(area_below(steps_of(h.high, h.first_azimuth, panorama), panorama, undecided_colour));
  drawing.shapes.emplace_back(area_below(steps_of(h.low, h.first_azimuth, panorama), panorama, hidden_colour));
  drawing.shapes.emplace_back(Line{steps_of(h.estimate, h.first_azimuth, panorama), 1.2, estimate_colour});
  add_edges(drawing, view, convergence, panorama);
  add_elevations(drawing, panorama);
  const char* const letters[] = {"N", "E", "S", "W", "N"};
  for (int n = 0; n <= 4; ++n) add_direction(drawing, where, panorama.x_of(90.0 * n), letters[n]);
}

/// Farther is paler.
Colour colour_of_distance(float distance_m, float nearest_m, float farthest_m) {
  const double share = farthest_m > nearest_m ? std::log(distance_m / nearest_m) / std::log(farthest_m / nearest_m) : 0.0;
  const auto mix = [&](std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>(std::lround(a + share * (b - a))); };
  return {mix(edge_colour.red, undecided_colour.red), mix(edge_colour.green, undecided_colour.green),
          mix(edge_colour.blue, undecided_colour.blue)};
}

Picture picture_of(const FarBoxView& map, PixelSize size) {
  Picture picture(size, colour_of(SkyPart::sky));
  float nearest_m = std::numeric_limits<float>::infinity(), farthest_m = 0.0F;
  for (const float d : map.distance_m) {
    if (!std::isfinite(d)) continue;
    nearest_m = std::min(nearest_m, d);
    farthest_m = std::max(farthest_m, d);
  }
  const std::size_t columns = 4 * map.side_columns;
  for (std::size_t y = 0; y < size.height; ++y)
    for (std::size_t x = 0; x < size.width; ++x) {
      const std::size_t row = (size.height - 1 - y) * map.rows / size.height, column = x * columns / size.width;
      const float distance_m = map.distance_m[row * columns + column];
      if (std::isfinite(distance_m)) picture.set({x, y}, colour_of_distance(distance_m, nearest_m, farthest_m));
    }
  return picture;
}

void add_box(Drawing& drawing, const PageBox& where, const FarView& view) {
  const FarBoxView& map = view.box;
  const PixelSize size{static_cast<std::size_t>(where.width), static_cast<std::size_t>(where.height)};
  const Pixel corner{static_cast<std::size_t>(where.upper_left.x), static_cast<std::size_t>(where.upper_left.y)};
  drawing.shapes.emplace_back(Image{corner, picture_of(map, size)});
  for (int side = 0; side <= 4; ++side) {
    const double x = where.upper_left.x + 0.25 * side * where.width;
    drawing.shapes.emplace_back(Line{{{x, where.upper_left.y}, {x, where.upper_left.y + where.height}}, 1.2, ink});
  }
  const char* const letters[] = {"N", "E", "S", "W"};
  for (int n = 0; n < 4; ++n)
    add_direction(drawing, where, where.upper_left.x + 0.25 * place_along_sides(90.0 * n, map) * where.width, letters[n]);
  const double left = where.upper_left.x - 6.0, bottom = where.upper_left.y + where.height;
  const std::string top = std::to_string(std::lround(std::atan(map.top) / rad_per_deg)) + "°";
  drawing.shapes.emplace_back(Text{{left, bottom + 4.0}, "0°", label_height, Alignment::right, ink});
  drawing.shapes.emplace_back(Text{{left, where.upper_left.y + 8.0}, top, label_height, Alignment::right, ink});
}

struct Meaning {
  Colour colour;
  double height;  ///< of the sample: thin ones are lines
  std::string words;
};

std::vector<Meaning> meanings_of_box(const FarBoxView& map) {
  std::vector<Meaning> meanings;
  const auto is_hidden = [](float distance_m) { return std::isfinite(distance_m); };
  if (!std::ranges::all_of(map.distance_m, is_hidden)) meanings.push_back({colour_of(SkyPart::sky), 14.0, "sky"});
  if (std::ranges::none_of(map.distance_m, is_hidden)) return meanings;
  meanings.push_back({edge_colour, 14.0, "hidden by what is near the box"});
  meanings.push_back({undecided_colour, 14.0, "hidden by what is far away"});
  return meanings;
}

/// What the picture has: where nothing is hidden for certain, nothing has that colour.
std::vector<Meaning> meanings_of(const FarView& view) {
  if (is_box(view)) return meanings_of_box(view.box);
  const FarHorizonView& h = view.horizon;
  std::vector<Meaning> meanings;
  if (std::ranges::any_of(h.low, [](float slope) { return slope > 0.0F; }))
    meanings.push_back({hidden_colour, 14.0, "residual city: hidden for certain (low)"});
  const auto has_none_undecided = [](float low, float high) { return high <= std::max(low, 0.0F); };
  if (!std::ranges::equal(h.low, h.high, has_none_undecided))
    meanings.push_back({undecided_colour, 14.0, "residual city: undecided (up to high)"});
  meanings.push_back({estimate_colour, 2.0, "residual city: estimate"});
  if (!h.edges.empty()) meanings.push_back({edge_colour, 2.0, "explicit far edges"});
  meanings.push_back({colour_of(SkyPart::sky), 14.0, "sky, as far as the far city goes"});
  return meanings;
}

}  // namespace

SeenPlace seen_from(const Point3d& eye, const Point3d& p, Angle convergence) {
  const Point3d d = p - eye;
  return {turned(std::atan2(d.x, d.y) / rad_per_deg + convergence.degrees()),
          std::atan2(d.z, std::hypot(d.x, d.y)) / rad_per_deg};
}

double top_of_panorama_deg(const FarView& view, Angle convergence) {
  double top_deg = 0.0;
  for (const std::vector<float>* slopes : {&view.horizon.low, &view.horizon.estimate, &view.horizon.high})
    for (const float slope : *slopes)
      if (std::isfinite(slope)) top_deg = std::max(top_deg, std::atan(static_cast<double>(slope)) / rad_per_deg);
  for (const FarEdge& edge : view.horizon.edges)
    for (const Point3d& p : {edge.a_projected, edge.b_projected})
      top_deg = std::max(top_deg, seen_from(view.eye_projected, p, convergence).elevation_deg);
  return std::clamp(5.0 * std::ceil((top_deg + 0.5) / 5.0), 5.0, 90.0);
}

double place_along_sides(double true_azimuth_deg, const FarBoxView& map) {
  // From the west end of the north side
  const double turn_deg = turned(true_azimuth_deg - map.north_azimuth.degrees() + 45.0);
  const double side = std::min(std::floor(turn_deg / 90.0), 3.0);
  return side + 0.5 * (1.0 + std::tan((turn_deg - 90.0 * side - 45.0) * rad_per_deg));
}

void add_far_panorama(Drawing& drawing, const PageBox& where, const FarView& view, Angle convergence) {
  if (is_box(view))
    add_box(drawing, where, view);
  else
    add_horizon(drawing, where, view, convergence);
}

PagePoint add_panorama_legend(Drawing& drawing, PagePoint place, const FarView& view) {
  for (const Meaning& meaning : meanings_of(view)) {
    drawing.shapes.emplace_back(box({place.x, place.y + 0.5 * (14.0 - meaning.height)}, 22.0, meaning.height, meaning.colour));
    drawing.shapes.emplace_back(Text{{place.x + 32.0, place.y + 12.0}, meaning.words, text_height, Alignment::left, ink});
    place.y += 22.0;
  }
  return place;
}

}  // namespace farlod
