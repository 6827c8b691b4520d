// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/cell_picture.hpp"

#include <fmt/format.h>

#include <utility>

#include "results/picture/far_panorama.hpp"
#include "results/picture/map_ornaments.hpp"
#include "results/picture/picture_style.hpp"

namespace farlod {
namespace {

constexpr Colour white{255, 255, 255};
constexpr double heading_height = 17.0;
constexpr std::size_t margin = 24, plan_top = 100, panorama_left = margin + cell_plan_edge + 90;
constexpr PageBox panorama_box{{static_cast<double>(panorama_left), static_cast<double>(plan_top)}, 900.0, 300.0};
constexpr PixelSize cell_picture_size{panorama_left + 900 + 2 * margin, plan_top + cell_plan_edge + 110};

void add_text(Drawing& drawing, PagePoint place, const std::string& words, double height, Colour colour) {
  drawing.shapes.emplace_back(Text{place, words, height, Alignment::left, colour});
}

PagePoint on_page(PagePoint of_plan) {
  return {static_cast<double>(margin) + of_plan.x, static_cast<double>(plan_top) + of_plan.y};
}

/// The outline of some cells, from their south-west corner.
Line square_of_cells(const CellPlanFrame& frame, std::int32_t begin, std::int32_t end, double width) {
  Line line{{}, width, ink};
  for (const auto& [i, j] : {std::pair{begin, begin}, {end, begin}, {end, end}, {begin, end}, {begin, begin}})
    line.places.push_back(on_page(frame.corner(i, j)));
  return line;
}

void add_outlines(Drawing& drawing, const CellPlanFrame& frame, const BuildingOutlines& outlines) {
  const double edge = static_cast<double>(cell_plan_edge);
  Segments lines{{}, 0.5, white};
  for (const PlanSegment& s : outlines.segments)
    if (const auto seen = clipped({frame.place_of(s.a), frame.place_of(s.b)}, {0.0, 0.0}, {edge, edge}))
      lines.segments.push_back({on_page(seen->a), on_page(seen->b)});
  if (!lines.segments.empty()) drawing.shapes.emplace_back(std::move(lines));
}

void add_plan_legend(Drawing& drawing, const CellPlanFrame& frame) {
  const double top = static_cast<double>(plan_top + cell_plan_edge);
  add_scale_bar(drawing, {static_cast<double>(margin), top + 6.0}, frame.metres_per_pixel());
  PagePoint place{static_cast<double>(margin), top + 52.0};
  for (const auto& [zone, words] : {std::pair{CellZone::cell, "the cell"},
                                    {CellZone::near, "near: its neighborhood"},
                                    {CellZone::far, "far: in the far map"}}) {
    drawing.shapes.emplace_back(box(place, 16.0, 16.0, building_colour(zone)));
    drawing.shapes.emplace_back(box({place.x + 18.0, place.y}, 16.0, 16.0, street_colour(zone)));
    add_text(drawing, {place.x + 42.0, place.y + 13.0}, words, text_height, ink);
    place.x += 235.0;
  }
  add_text(drawing, {static_cast<double>(margin), top + 92.0}, "Dark: buildings; pale: streets, courts and all other ground.",
           text_height, muted);
  add_north_arrow(drawing, {static_cast<double>(margin + cell_plan_edge) - 14.0, top + 2.0});
}

void add_plan(Drawing& drawing, const CellScenery& scenery) {
  const CellPlanFrame frame(scenery.contents, cell_plan_edge);
  drawing.shapes.emplace_back(Image{{margin, plan_top}, draw_cell_plan(scenery.contents, scenery.around, frame)});
  if (scenery.outlines) add_outlines(drawing, frame, *scenery.outlines);
  const std::int32_t reach = scenery.contents.cell.i - scenery.contents.neighborhood.i_begin;
  drawing.shapes.emplace_back(square_of_cells(frame, -reach - 1, reach + 2, 0.6));
  drawing.shapes.emplace_back(square_of_cells(frame, -reach, reach + 1, 1.6));
  drawing.shapes.emplace_back(square_of_cells(frame, 0, 1, 2.6));
  add_plan_legend(drawing, frame);
}

std::vector<std::string> facts_of(const CellContents& c) {
  std::vector<std::string> facts;
  facts.push_back(fmt::format("Cell: {} triangles, {} vertices, {} buildings", c.triangles, c.vertices, c.buildings));
  facts.push_back(fmt::format("Edges: {} grounded, {} of overhangs, {} of undersides", c.grounded_edges, c.overhang_edges,
                              c.underside_edges));
  if (c.low_m && c.high_m) facts.push_back(fmt::format("Heights: {:.1f} m to {:.1f} m above sea level", *c.low_m, *c.high_m));
  std::uint64_t near_triangles = 0;
  for (const NeighborCell& near : c.near_cells) near_triangles += near.triangles;
  facts.push_back(fmt::format("Neighborhood: {} cells, {} triangles", c.near_cells.size(), near_triangles));
  facts.push_back(c.has_far_map ? fmt::format("Far map: {} bytes, {} explicit edges", c.far_map_bytes, c.explicit_edges)
                                : std::string("Far map: none (farlod-pack --area adds far maps)"));
  return facts;
}

void add_far(Drawing& drawing, const CellScenery& scenery) {
  const double left = panorama_box.upper_left.x, top = panorama_box.upper_left.y;
  PagePoint place{left, top + 20.0};
  if (scenery.far) {
    const Point3d& eye = scenery.far->eye_projected;
    add_text(drawing, {left, top - 14.0},
             fmt::format("The far map from the middle of the cell ({:.2f}, {:.2f}, {:.2f} m above sea level); true north", eye.x,
                         eye.y, eye.z),
             text_height, muted);
    add_far_panorama(drawing, panorama_box, *scenery.far, scenery.convergence);
    place = add_panorama_legend(drawing, {left, top + panorama_box.height + 44.0}, *scenery.far);
  }
  place.y += 24.0;
  for (const std::string& fact : facts_of(scenery.contents)) {
    add_text(drawing, {left, place.y}, fact, heading_height, ink);
    place.y += 26.0;
  }
}

}  // namespace

Drawing draw_cell(const CellScenery& scenery) {
  const CellPlace cell = scenery.contents.cell;
  Drawing drawing{cell_picture_size, fmt::format("Cell {},{} of {}", cell.i, cell.j, scenery.package)};
  const double left = static_cast<double>(margin);
  add_text(drawing, {left, left + title_height}, drawing.title, title_height, ink);
  add_text(drawing, {left, static_cast<double>(plan_top) - 22.0}, scenery.crs + ", grid north up", text_height, muted);
  add_plan(drawing, scenery);
  add_far(drawing, scenery);
  return drawing;
}

}  // namespace farlod
