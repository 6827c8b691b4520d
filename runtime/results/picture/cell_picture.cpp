// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/cell_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "results/picture/far_panorama.hpp"
#include "results/picture/picture.hpp"
#include "results/picture/sky_picture.hpp"

namespace farlod {
namespace {

CellZone zone_of(CellPlace place, const CellContents& contents) {
  if (place == contents.cell) return CellZone::cell;
  return contents.neighborhood.contains(place) ? CellZone::near : CellZone::far;
}

constexpr Colour white{255, 255, 255};
constexpr double fact_height = 17.0;
constexpr std::size_t page_margin = 24, plan_top = 100, panorama_left = page_margin + cell_plan_edge + 90;
constexpr PageBox panorama_box{{static_cast<double>(panorama_left), static_cast<double>(plan_top)}, 900.0, 300.0};
constexpr PixelSize cell_picture_size{panorama_left + 900 + 2 * page_margin, plan_top + cell_plan_edge + 110};

void add_text(Drawing& drawing, PagePoint place, const std::string& words, double height, Colour colour) {
  drawing.shapes.emplace_back(Text{place, words, height, Alignment::left, colour});
}

PagePoint on_page(PagePoint of_plan) {
  return {static_cast<double>(page_margin) + of_plan.x, static_cast<double>(plan_top) + of_plan.y};
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

void add_plan_legend(Drawing& drawing, const CellPlanFrame& frame, const CellScenery& scenery) {
  const double top = static_cast<double>(plan_top + cell_plan_edge);
  add_scale_bar(drawing, {static_cast<double>(page_margin), top + 6.0}, frame.metres_per_pixel(), cell_plan_edge);
  PagePoint place{static_cast<double>(page_margin), top + 52.0};
  for (const auto& [zone, words] : {std::pair{CellZone::cell, "the cell"},
                                    {CellZone::near, "near: its neighborhood"},
                                    {CellZone::far, "far: in the far map"}}) {
    const auto is_in_zone = [&, named = zone](const MeshPart& part) { return zone_of(part.cell, scenery.contents) == named; };
    if (std::ranges::none_of(scenery.around, is_in_zone)) continue;
    drawing.shapes.emplace_back(box(place, 16.0, 16.0, building_colour(zone)));
    drawing.shapes.emplace_back(box({place.x + 18.0, place.y}, 16.0, 16.0, street_colour(zone)));
    add_text(drawing, {place.x + 42.0, place.y + 13.0}, words, text_height, ink);
    place.x += 235.0;
  }
  add_text(drawing, {static_cast<double>(page_margin), top + 92.0},
           "Dark: buildings; pale: streets, courts and all other ground.", text_height, muted);
  add_north_arrow(drawing, {static_cast<double>(page_margin + cell_plan_edge) - 14.0, top + 2.0});
}

void add_plan(Drawing& drawing, const CellScenery& scenery) {
  const CellPlanFrame frame(scenery.contents, cell_plan_edge);
  drawing.shapes.emplace_back(Image{{page_margin, plan_top}, draw_cell_plan(scenery.contents, scenery.around, frame)});
  if (scenery.outlines) add_outlines(drawing, frame, *scenery.outlines);
  const std::int32_t reach = scenery.contents.cell.i - scenery.contents.neighborhood.i_begin;
  drawing.shapes.emplace_back(square_of_cells(frame, -reach - 1, reach + 2, 0.6));
  drawing.shapes.emplace_back(square_of_cells(frame, -reach, reach + 1, 1.6));
  drawing.shapes.emplace_back(square_of_cells(frame, 0, 1, 2.6));
  add_plan_legend(drawing, frame, scenery);
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
    add_text(drawing, {left, place.y}, fact, fact_height, ink);
    place.y += 26.0;
  }
}

}  // namespace

Colour building_colour(CellZone zone) {
  // As in the picture of the sky; the blue of Okabe and Ito (2008) for the cell itself
  if (zone == CellZone::cell) return {0, 114, 178};
  return colour_of(zone == CellZone::near ? SkyPart::near : SkyPart::far);
}

Colour street_colour(CellZone zone) {
  if (zone == CellZone::cell) return {205, 229, 242};
  return zone == CellZone::near ? Colour{224, 224, 228} : Colour{250, 238, 214};
}

CellRectangle cells_of_plan(const CellContents& contents) {
  const CellRectangle& n = contents.neighborhood;
  return {n.i_begin - 1, n.j_begin - 1, n.i_end + 1, n.j_end + 1};
}

CellPlanFrame::CellPlanFrame(const CellContents& contents, std::size_t edge)
    : corner_m_(contents.corners_projected[0]),
      east_m_(contents.corners_projected[1] - corner_m_),
      north_m_(contents.corners_projected[3] - corner_m_),
      edge_(edge) {
  const CellRectangle cells = cells_of_plan(contents);
  const double along = cells.i_end - cells.i_begin;
  // The square of the cells is turned against the paper
  const double wide_m = along * (std::abs(east_m_.x) + std::abs(north_m_.x)),
               high_m = along * (std::abs(east_m_.y) + std::abs(north_m_.y));
  metres_per_pixel_ = std::max(wide_m, high_m) / static_cast<double>(edge_);
}

PagePoint CellPlanFrame::place_of(Point2d p_projected) const {
  const Point2d from_middle = p_projected - (corner_m_ + 0.5 * (east_m_ + north_m_));
  const double half = 0.5 * static_cast<double>(edge_);
  return {half + from_middle.x / metres_per_pixel_, half - from_middle.y / metres_per_pixel_};
}

PagePoint CellPlanFrame::corner(std::int32_t i, std::int32_t j) const {
  return place_of(corner_m_ + static_cast<double>(i) * east_m_ + static_cast<double>(j) * north_m_);
}

Box2d CellPlanFrame::part() const {
  const Point2d middle = corner_m_ + 0.5 * (east_m_ + north_m_);
  const double half_m = 0.5 * static_cast<double>(edge_) * metres_per_pixel_;
  return {{middle.x - half_m, middle.y - half_m}, {middle.x + half_m, middle.y + half_m}};
}

Picture draw_cell_plan(const CellContents& contents, const std::vector<MeshPart>& around, const CellPlanFrame& frame) {
  Picture picture({frame.edge(), frame.edge()}, {255, 255, 255});
  // The ground comes first
  for (const MeshPart& part : around) {
    const CellZone zone = zone_of(part.cell, contents);
    const Colour colour = part.building ? building_colour(zone) : street_colour(zone);
    const auto place = [&](std::uint32_t vertex) { return frame.place_of(horizontal(part.vertices_projected[vertex])); };
    for (const MeshTriangle& t : part.triangles)
      for_each_pixel({place(t.vertices[0]), place(t.vertices[1]), place(t.vertices[2])}, picture.size(),
                     [&](Pixel pixel) { picture.set(pixel, colour); });
  }
  return picture;
}

Drawing draw_cell(const CellScenery& scenery) {
  const CellPlace cell = scenery.contents.cell;
  Drawing drawing{cell_picture_size, fmt::format("Cell {},{} of {}", cell.i, cell.j, scenery.package)};
  const double left = static_cast<double>(page_margin);
  add_text(drawing, {left, left + title_height}, drawing.title, title_height, ink);
  add_text(drawing, {left, static_cast<double>(plan_top) - 22.0}, scenery.crs + ", grid north up", text_height, muted);
  add_plan(drawing, scenery);
  add_far(drawing, scenery);
  return drawing;
}

}  // namespace farlod
