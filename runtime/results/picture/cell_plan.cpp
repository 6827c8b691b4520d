// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/cell_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "results/picture/sky_picture.hpp"

namespace farlod {
namespace {

using PageTriangle = std::array<PagePoint, 3>;

double side_of(PagePoint a, PagePoint b, PagePoint p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); }

bool covers(const PageTriangle& t, PagePoint p) {
  const double ab = side_of(t[0], t[1], p), bc = side_of(t[1], t[2], p), ca = side_of(t[2], t[0], p);
  return (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0);
}

/// Fills the pixels whose middles a triangle covers.
void fill(Picture& picture, const PageTriangle& t, Colour colour) {
  if (side_of(t[0], t[1], t[2]) == 0.0) return;  // upright
  const auto [west, east] = std::minmax({t[0].x, t[1].x, t[2].x});
  const auto [top, bottom] = std::minmax({t[0].y, t[1].y, t[2].y});
  const auto begin = [](double low) { return static_cast<std::size_t>(std::max(0.0, std::floor(low))); };
  const auto end = [](double high, std::size_t size) {
    return static_cast<std::size_t>(std::clamp(std::ceil(high), 0.0, static_cast<double>(size)));
  };
  for (std::size_t y = begin(top); y < end(bottom, picture.size().height); ++y)
    for (std::size_t x = begin(west); x < end(east, picture.size().width); ++x)
      if (covers(t, {static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5})) picture.set({x, y}, colour);
}

CellZone zone_of(CellPlace place, const CellContents& contents) {
  if (place == contents.cell) return CellZone::cell;
  return contents.neighborhood.contains(place) ? CellZone::near : CellZone::far;
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
      fill(picture, {place(t.vertices[0]), place(t.vertices[1]), place(t.vertices[2])}, colour);
  }
  return picture;
}

}  // namespace farlod
