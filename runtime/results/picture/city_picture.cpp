// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/city_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>

#include "results/picture/sky_picture.hpp"

namespace farlod {
namespace {

/// What rises less above the ground is rounding, or a pavement.
constexpr double lowest_building_m = 0.1;
/// Ground that varies less than this has one grey, nearly.
constexpr double least_relief_m = 10.0;
constexpr Colour nothing_there{255, 255, 255}, cell_line_colour{96, 104, 128}, mark_colour{0, 92, 200};
constexpr double page_left = 24.0, step_of_rows = 24.0;
constexpr std::size_t side_height = 450;  // of the two scales
constexpr double closest_lines = 24.0;    // pixels between lines of the grid

double share_of_ground(double ground_m, const CityScale& scale) {
  return 1.0 - (scale.high_m - ground_m) / std::max(scale.high_m - scale.low_m, least_relief_m);
}

/// Whether a crown is what is seen from above.
bool is_crown_above(const CityScenery& scenery, std::size_t pixel) {
  if (scenery.crown_tops_m.empty()) return false;
  const float top_m = scenery.crown_tops_m[pixel];
  return !std::isnan(top_m) && !(top_m <= scenery.heights.highest_m[pixel]);
}

Picture map_of_city(const CityScenery& scenery, const CityScale& scale) {
  Picture map({scenery.plan.columns, scenery.plan.rows}, nothing_there);
  const std::vector<float>&ground_m = scenery.heights.ground_m, &highest_m = scenery.heights.highest_m;
  const std::vector<float> shading = shading_of(ground_m, scenery.plan);
  for (std::size_t n = 0; n < ground_m.size(); ++n) {
    const double ground = static_cast<double>(ground_m[n]), highest = static_cast<double>(highest_m[n]);
    const bool is_crown = is_crown_above(scenery, n), is_ground = highest - ground < lowest_building_m;
    const Colour seen = is_crown ? colour_of_crowns() : colour_in_city(ground, highest, scale);
    const bool is_lit = (is_ground || is_crown) && !shading.empty();
    map.set({n % scenery.plan.columns, n / scenery.plan.columns}, is_lit ? lit(seen, shading[n]) : seen);
  }
  return map;
}

/// Places of the map on the page.
class CityFrame {
 public:
  explicit CityFrame(const RasterPlan& plan) : plan_(plan), corner_(city_layout(plan).map) {}

  [[nodiscard]] PagePoint place_of(Point2d p_projected) const {
    return {static_cast<double>(corner_.x) + (p_projected.x - plan_.north_west_m.x) / plan_.step_m,
            static_cast<double>(corner_.y) + (plan_.north_west_m.y - p_projected.y) / plan_.step_m};
  }
  [[nodiscard]] bool shows(Point2d p_projected) const {
    const double column = (p_projected.x - plan_.north_west_m.x) / plan_.step_m,
                 row = (plan_.north_west_m.y - p_projected.y) / plan_.step_m;
    return 0.0 <= column && column <= static_cast<double>(plan_.columns) && 0.0 <= row && row <= static_cast<double>(plan_.rows);
  }

 private:
  const RasterPlan& plan_;
  Pixel corner_;
};

void add_words(Drawing& drawing, PagePoint place, const std::string& words, Colour colour = ink) {
  drawing.shapes.emplace_back(Text{place, words, text_height, Alignment::left, colour});
}

/// Cells from a line that is drawn to the next.
std::int64_t cells_between_lines(const CityScenery& scenery) {
  return static_cast<std::int64_t>(std::max(std::ceil(closest_lines * scenery.plan.step_m / scenery.grid.cell_edge_m), 1.0));
}

void add_grid(Drawing& drawing, const CityScenery& scenery, const CityFrame& frame) {
  const auto& [south_west, south_east, north_east, north_west] = scenery.grid.corners_projected;
  Segments lines{{}, 0.4, cell_line_colour};
  const auto add = [&](std::int64_t cells, Point2d a0, Point2d a1, Point2d b0, Point2d b1) {
    for (std::int64_t n = 0; n <= cells; n += cells_between_lines(scenery)) {
      const double share = static_cast<double>(n) / static_cast<double>(cells);
      lines.segments.push_back({frame.place_of(a0 + share * (a1 - a0)), frame.place_of(b0 + share * (b1 - b0))});
    }
  };
  add(scenery.grid.columns, south_west, south_east, north_west, north_east);
  add(scenery.grid.rows, south_west, north_west, south_east, north_east);
  drawing.shapes.emplace_back(std::move(lines));
}

void mark_place(Drawing& drawing, PagePoint place) {
  drawing.shapes.emplace_back(disc(place, 5.0, nothing_there));
  drawing.shapes.emplace_back(disc(place, 3.8, mark_colour));
}

/// A column of colours, with words beside it at shares of its height from below.
void add_scale(Drawing& drawing, Pixel upper_left, PixelSize size, const std::function<Colour(double)>& colour_at,
               const std::vector<std::pair<double, std::string>>& ticks) {
  Picture colours(size, ink);
  const auto last = static_cast<double>(size.height - 1);
  for (std::size_t y = 0; y < size.height; ++y)
    colours.fill({0, y}, {size.width, 1}, colour_at(1.0 - static_cast<double>(y) / last));
  drawing.shapes.emplace_back(Image{upper_left, std::move(colours)});
  const double right = static_cast<double>(upper_left.x + size.width);
  for (const auto& [share, words] : ticks) {
    const double y = static_cast<double>(upper_left.y) + 0.5 + (1.0 - share) * last;
    drawing.shapes.emplace_back(Line{{{right, y}, {right + 6.0, y}}, 1.5, ink});
    add_words(drawing, {right + 10.0, y + half_digit_height * text_height}, words);
  }
}

/// What the ground of a surface model is: buildings and trees are in it.
const char* word_of_ground(const CityScenery& scenery) { return scenery.is_surface_model ? "Surface" : "Ground"; }

/// To a decimetre, without zeros behind the point: "0 m", "12.3 m".
std::string elevation_text(double z_m) {
  const double rounded_m = std::round(10.0 * z_m) / 10.0;
  return fmt::format("{:.10g} m", rounded_m == 0.0 ? 0.0 : rounded_m);  // and not -0
}

void add_scales(Drawing& drawing, Pixel place, const CityScenery& scenery, const CityScale& scale) {
  constexpr std::size_t width = 28;
  constexpr int steps = 5;
  const auto words_at = [&](std::size_t y, const std::string& words) {
    add_words(drawing, {static_cast<double>(place.x), static_cast<double>(place.y + y)}, words);
  };
  std::vector<std::pair<double, std::string>> ticks;
  for (int n = 0; n <= steps; ++n)
    ticks.emplace_back(static_cast<double>(n) / steps,
                       fmt::format("{}{:g} m", n == steps && scale.highest_m > scale.top_m ? "≥ " : "", n * scale.top_m / steps));
  std::vector<std::pair<double, std::string>> elevations{{0.0, elevation_text(scale.low_m)}};
  // Level ground has one
  if (elevation_text(scale.high_m) != elevations.front().second) elevations.emplace_back(1.0, elevation_text(scale.high_m));
  if (scale.top_m > 0.0) {
    words_at(14, "Buildings");
    words_at(34, "above ground");
    add_scale(drawing, {place.x, place.y + 48}, {width, 200}, colour_of_height, ticks);
  }
  words_at(294, word_of_ground(scenery));
  words_at(314, "z");
  add_scale(
      drawing, {place.x, place.y + 328}, {width, 100},
      [&](double share) { return colour_of_ground(share_of_ground(std::lerp(scale.low_m, scale.high_m, share), scale)); },
      elevations);
}

/// Names crowns where any are seen.
void add_sign_of_crowns(Drawing& drawing, const CityScenery& scenery, PagePoint place) {
  for (std::size_t n = 0; n < scenery.crown_tops_m.size(); ++n) {
    if (!is_crown_above(scenery, n)) continue;
    drawing.shapes.emplace_back(box(place, 28.0, 14.0, colour_of_crowns()));
    add_words(drawing, {place.x + 38.0, place.y + 12.0}, "crowns");
    return;
  }
}

std::string words_of_grid(const CityScenery& scenery) {
  const std::int64_t step = cells_between_lines(scenery);
  return fmt::format("{}cells of {:g} m",
                     step > 1 ? fmt::format("a line for each {} ", step) : "lines: ", scenery.grid.cell_edge_m);
}

std::string words_of_highest(const CityScenery& scenery, const CityScale& scale) {
  if (scenery.is_surface_model) return "A surface model: buildings are a part of the surface.";
  if (!(scale.top_m > 0.0)) return "No building rises above the ground.";
  const Point2d p = scenery.plan.centre_m(scale.highest_at % scenery.plan.columns, scale.highest_at / scenery.plan.columns);
  return fmt::format("Highest pixel (ring): {:.1f} m above the ground, at {:.0f}, {:.0f}", scale.highest_m, p.x, p.y);
}

void add_footer(Drawing& drawing, const CityScenery& scenery, const CityScale& scale, PagePoint place) {
  add_scale_bar(drawing, place, scenery.plan.step_m, scenery.plan.columns);
  add_words(drawing, {place.x + 230.0, place.y + 27.0}, words_of_grid(scenery));
  place.y += 27.0 + step_of_rows;
  std::vector<std::string> rows{words_of_highest(scenery, scale)};
  if (!scenery.place.empty()) rows.push_back("Middle: " + scenery.place);
  for (const std::string& words : rows) {
    add_words(drawing, place, words);
    place.y += step_of_rows;
  }
  if (scenery.marked.file.empty()) return;
  const CityFrame frame(scenery.plan);
  const auto shown = std::ranges::count_if(scenery.marked.places_projected, [&](Point2d p) { return frame.shows(p); });
  const auto beyond = static_cast<std::ptrdiff_t>(scenery.marked.places_projected.size()) - shown;
  mark_place(drawing, {place.x + 6.0, place.y - 5.0});
  add_words(drawing, {place.x + 18.0, place.y},
            fmt::format("{} of {}{}", shown, scenery.marked.file, beyond > 0 ? fmt::format("; {} beyond the map", beyond) : ""));
}

}  // namespace

CityScale scale_of(const PlanHeights& heights) {
  CityScale scale;
  std::vector<float> risen_m;
  bool has_ground = false;
  for (std::size_t n = 0; n < heights.ground_m.size(); ++n) {
    const double ground_m = static_cast<double>(heights.ground_m[n]);
    if (std::isnan(ground_m)) continue;
    scale.low_m = has_ground ? std::min(scale.low_m, ground_m) : ground_m;
    scale.high_m = has_ground ? std::max(scale.high_m, ground_m) : ground_m;
    has_ground = true;
    const double rise_m = static_cast<double>(heights.highest_m[n]) - ground_m;
    if (!(rise_m >= lowest_building_m)) continue;
    risen_m.push_back(static_cast<float>(rise_m));
    if (rise_m > scale.highest_m) std::tie(scale.highest_m, scale.highest_at) = std::pair(rise_m, n);
  }
  if (risen_m.empty()) return scale;
  const auto end = risen_m.begin() + static_cast<std::ptrdiff_t>(risen_m.size() - 1 - risen_m.size() / 100);
  std::ranges::nth_element(risen_m, end);
  scale.top_m = 5.0 * std::ceil(static_cast<double>(*end) / 5.0);
  return scale;
}

Colour colour_in_city(double ground_m, double highest_m, const CityScale& scale) {
  if (highest_m - ground_m >= lowest_building_m) return colour_of_height((highest_m - ground_m) / scale.top_m);
  if (!std::isnan(ground_m)) return colour_of_ground(share_of_ground(ground_m, scale));
  return nothing_there;
}

Colour colour_of_crowns() { return colour_of(SkyPart::crown); }

PreviewLayout city_layout(const RasterPlan& plan) {
  PreviewLayout layout = layout_with_footer({plan.columns, std::max(plan.rows, side_height)});
  layout.map_size = {plan.columns, plan.rows};
  layout.picture.width += 32;  // "above ground"
  layout.picture.height += static_cast<std::size_t>(3.0 * step_of_rows);
  return layout;
}

Drawing draw_city(const CityScenery& scenery) {
  const PreviewLayout layout = city_layout(scenery.plan);
  const CityScale scale = scale_of(scenery.heights);
  const CityFrame frame(scenery.plan);
  Drawing drawing{layout.picture, "Plan of " + scenery.package};
  drawing.shapes.emplace_back(Text{{page_left, page_left + title_height}, drawing.title, title_height, Alignment::left, ink});
  add_words(drawing, {page_left, page_left + 50.0}, scenery.crs + ", grid north up", muted);
  drawing.shapes.emplace_back(Image{layout.map, map_of_city(scenery, scale)});
  add_grid(drawing, scenery, frame);
  for (const Point2d p : scenery.marked.places_projected)
    if (frame.shows(p)) mark_place(drawing, frame.place_of(p));
  if (scale.top_m > 0.0)
    add_ring(
        drawing,
        frame.place_of(scenery.plan.centre_m(scale.highest_at % scenery.plan.columns, scale.highest_at / scenery.plan.columns)),
        8.0, ink);
  add_scales(drawing, layout.colour_bar, scenery, scale);
  add_sign_of_crowns(drawing, scenery,
                     {static_cast<double>(layout.colour_bar.x), static_cast<double>(layout.colour_bar.y + 444)});
  const PagePoint footer{static_cast<double>(layout.footer.x), static_cast<double>(layout.footer.y)};
  add_footer(drawing, scenery, scale, footer);
  add_north_arrow(drawing, {static_cast<double>(layout.colour_bar.x) + 48.0, footer.y - 4.0});
  return drawing;
}

}  // namespace farlod
