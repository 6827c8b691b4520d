// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/stepped_surface.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "tiles/level_areas.hpp"
#include "tiles/pixel_square.hpp"
#include "tiles/wall_lines.hpp"

namespace farlod::tiles {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

class SurfaceMaker {
 public:
  SurfaceMaker(const TerrainRaster& raster, const PixelSteps& steps, const GridRotation& rotation, SquaresOfReaders squares)
      : raster_(raster), steps_(steps), squares_(squares), at_(raster, rotation), walls_(at_, raster.columns, surface_) {}

  SteppedSurface make() {
    std::vector<PixelSquare> below, row;
    for (std::size_t r = 0; r <= raster_.rows; ++r) {
      row.clear();
      level_rows_ = {no_heights(), no_heights()};
      for (std::size_t c = 0; c <= raster_.columns; ++c) {
        const PixelSquare& square = row.emplace_back(raster_, steps_, c, r);
        add_square(square);
        if (c > 0) add_side_between(row[c - 1], 1, square);
        if (r > 0) add_side_between(below[c], 2, square);
      }
      add_level_rows(r);
      walls_.end_line_along_x();
      std::swap(below, row);
    }
    areas_.end([this](const LevelAreas::Rectangle& r) { add_area(r); });
    walls_.end();
    surface_.stored_triangles = surface_.triangles.size();
    surface_.stored_edges = surface_.edges.size();
    surface_.triangles.append({of_readers_.triangles.data(), of_readers_.triangles.size()});
    surface_.edges.append({of_readers_.edges.data(), of_readers_.edges.size()});
    return std::move(surface_);
  }

 private:
  [[nodiscard]] std::vector<double> no_heights() const { return std::vector<double>(2 * raster_.columns, none); }

  void add_triangle(const Point3d& a, const Point3d& b, const Point3d& c) { surface_.triangles.push_back({a, b, c}); }

  static void add_edge(const Point3d& a, const Point3d& b, const Point3d& left, const Point3d& right, SteppedSurface& to) {
    EdgeSides edge(a, b);
    edge.add(left, FacetLook::up);
    edge.add(right, FacetLook::up);
    if (edge.can_be_horizon()) to.edges.push_back({edge.edge(), edge.adjacent()});
  }
  void add_edge(const Point3d& a, const Point3d& b, const Point3d& left, const Point3d& right) {
    add_edge(a, b, left, right, surface_);
  }

  [[nodiscard]] bool is_left_out(const PixelSquare& s) const {
    const auto column = static_cast<std::size_t>(s.middle.x / 2), row = static_cast<std::size_t>(s.middle.y / 2);
    return column > 0 && row > 0 && steps_.is_left_out(column - 1, row - 1);
  }
  /// Where something goes that readers make, or not; nothing where it goes nowhere.
  [[nodiscard]] SteppedSurface* place_of(bool left_out) {
    if (!left_out) return &surface_;
    return squares_ == SquaresOfReaders::behind ? &of_readers_ : nullptr;
  }

  [[nodiscard]] Point3d centre(const PixelSquare& s, std::size_t k) const { return at_(s.centre_of(k), s.height_m[k]); }
  [[nodiscard]] Point3d middle(const PixelSquare& s, std::size_t k) const { return at_(s.middle, s.middle_height_m[k]); }
  /// What follows pixel k around the middle: the next pixel, or where the surface is torn on the way there.
  [[nodiscard]] Point3d after(const PixelSquare& s, std::size_t k) const {
    return s.joined[k] ? centre(s, PixelSquare::next(k)) : at_(s.middle_of_side(k), s.height_m[k]);
  }
  [[nodiscard]] Point3d ahead_of(const PixelSquare& s, std::size_t k) const {
    const std::size_t b = PixelSquare::before(k);
    return s.joined[b] ? centre(s, b) : at_(s.middle_of_side(b), s.height_m[k]);
  }

  void add_square(const PixelSquare& s) {
    if (s.is_whole() && !s.is_level[0]) {
      if (SteppedSurface* const to = place_of(is_left_out(s))) add_whole_square(s, *to);
      return;
    }
    for (std::size_t k = 0; k < 4; ++k) {
      if (!s.has_height[k]) continue;
      if (s.is_level[k])
        note_level_quarter(s, k);
      else
        add_around_middle(s, k);
    }
    // From south to north, and from west to east, so that pieces continue each other
    for (const std::size_t k : {0U, 2U, 3U, 1U})
      if (!s.joined[k] && (s.has_height[k] || s.has_height[PixelSquare::next(k)])) add_torn(s, k);
  }

  void add_whole_square(const PixelSquare& s, SteppedSurface& to) const {
    const std::size_t a = s.fold(), b = a + 1, c = a + 2, d = PixelSquare::next(c);
    to.triangles.push_back({centre(s, a), centre(s, b), centre(s, c)});
    to.triangles.push_back({centre(s, a), centre(s, c), centre(s, d)});
    add_edge(centre(s, a), centre(s, c), centre(s, d), centre(s, b), to);
  }

  /// The triangles that begin at pixel k, of those around the middle.
  void add_around_middle(const PixelSquare& s, std::size_t k) {
    const Point3d m = middle(s, k), p = centre(s, k);
    add_triangle(m, p, after(s, k));
    if (!s.joined[PixelSquare::before(k)]) add_triangle(m, ahead_of(s, k), p);
    add_edge(m, p, after(s, k), ahead_of(s, k));
  }

  void note_level_quarter(const PixelSquare& s, std::size_t k) {
    const std::int64_t x = s.middle.x + (PixelSquare::aside[k].x - 1) / 2;
    level_rows_[PixelSquare::aside[k].y < 0 ? 0 : 1][static_cast<std::size_t>(x)] = s.height_m[k];
  }

  void add_level_rows(std::size_t r) {
    const auto take = [this](const LevelAreas::Rectangle& area) { add_area(area); };
    if (r > 0) areas_.add_row(level_rows_[0], take);
    if (r < raster_.rows) areas_.add_row(level_rows_[1], take);
  }

  void add_area(const LevelAreas::Rectangle& r) {
    const Point3d a = at_({r.x_begin, r.y_begin}, r.height_m), b = at_({r.x_end, r.y_begin}, r.height_m),
                  c = at_({r.x_end, r.y_end}, r.height_m), d = at_({r.x_begin, r.y_end}, r.height_m);
    add_triangle(a, b, c);
    add_triangle(a, c, d);
  }

  /// The third corner of the triangle of `s` at its side k, or at that half of it which belongs to pixel `of`.
  [[nodiscard]] Point3d third(const PixelSquare& s, std::size_t k, std::size_t of) const {
    if (!s.is_whole()) return middle(s, of);
    return centre(s, PixelSquare::third(s.fold(), k));
  }

  /// The edges on the side between two squares: side k of the first one.
  void add_side_between(const PixelSquare& s, std::size_t k, const PixelSquare& beyond) {
    const std::size_t l = (k + 2) % 4, a = k, b = PixelSquare::next(k), a_beyond = PixelSquare::next(l), b_beyond = l;
    const auto is_level = [&](std::size_t here, std::size_t there) { return s.is_level[here] && beyond.is_level[there]; };
    if (s.joined[k]) {
      SteppedSurface* const to = is_level(a, a_beyond) ? nullptr : place_of(is_left_out(s) && is_left_out(beyond));
      if (to != nullptr) add_edge(centre(s, a), centre(s, b), third(beyond, l, a_beyond), third(s, k, a), *to);
      return;
    }
    if (s.has_height[a] && !is_level(a, a_beyond)) add_edge(centre(s, a), after(s, a), middle(beyond, a_beyond), middle(s, a));
    if (s.has_height[b] && !is_level(b, b_beyond)) add_edge(centre(s, b), ahead_of(s, b), middle(s, b), middle(beyond, b_beyond));
  }

  /// The torn half of side k: from its middle to the corner that the four pixels share.
  void add_torn(const PixelSquare& s, std::size_t k) {
    const std::size_t b = PixelSquare::next(k);
    const auto heights = [&](std::size_t pixel, bool begins_at_corner) -> std::array<double, 2> {
      if (!s.has_height[pixel]) return {none, none};
      if (begins_at_corner) return {s.middle_height_m[pixel], s.height_m[pixel]};
      return {s.height_m[pixel], s.middle_height_m[pixel]};
    };
    // The south side is torn along y, before the corner; the east side along x, behind it; and so on
    const bool is_northward = k % 2 == 0, is_behind = k == 1 || k == 2, first_is_k = k == 0 || k == 1;
    const std::int64_t line = is_northward ? s.middle.x : s.middle.y, corner = is_northward ? s.middle.y : s.middle.x;
    const std::array<double, 2> of_k = heights(k, is_behind), of_b = heights(b, is_behind);
    walls_.add({is_northward ? TornPiece::Along::y : TornPiece::Along::x,
                line,
                is_behind ? corner : corner - 1,
                is_behind ? corner + 1 : corner,
                {first_is_k ? of_k : of_b, first_is_k ? of_b : of_k}});
  }

  const TerrainRaster& raster_;
  const PixelSteps& steps_;
  SquaresOfReaders squares_;
  PixelPlaces at_;
  SteppedSurface surface_, of_readers_;
  LevelAreas areas_;
  std::array<std::vector<double>, 2> level_rows_;  ///< of quarters: below the middle of squares, and above it
  WallLines walls_;
};

}  // namespace

SteppedSurface stepped_surface(const TerrainRaster& raster, const PixelSteps& steps, const GridRotation& rotation,
                               SquaresOfReaders squares) {
  return SurfaceMaker(raster, steps, rotation, squares).make();
}

}  // namespace farlod::tiles
