// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/relief_tiles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "farlod/error.hpp"
#include "package/pixel_middle.hpp"
#include "package/upper_facets.hpp"

namespace farlod {
namespace {

using package::TileEdge;

/// The pixels of a raster whose centres may lie in a cell; half open.
struct PixelsOfCell {
  std::size_t column_begin = 0, row_begin = 0, column_end = 0, row_end = 0;
  [[nodiscard]] std::size_t columns() const { return column_end - column_begin; }
};

PixelsOfCell pixels_around(const Box2d& square_grid, const PixelsInGrid& in_grid, const package::SurfacePixels& pixels) {
  // Turn the corners of the square back, and count pixels from the first
  Box2d box;
  const auto& [low, high] = square_grid;
  for (const Point2d p : {low, Point2d{high.x, low.y}, high, Point2d{low.x, high.y}}) {
    const Point2d p_city{in_grid.cos * p.x + in_grid.sin * p.y, in_grid.cos * p.y - in_grid.sin * p.x};
    box.add({(p_city.x - in_grid.first_x_m) / in_grid.step_m, (p_city.y - in_grid.first_y_m) / in_grid.step_m});
  }
  const auto place = [](double x, std::uint32_t count) {
    return static_cast<std::size_t>(std::clamp(x, 0.0, static_cast<double>(count)));
  };
  return {place(std::floor(box.low.x), pixels.columns), place(std::floor(box.low.y), pixels.rows),
          place(std::floor(box.high.x) + 2.0, pixels.columns), place(std::floor(box.high.y) + 2.0, pixels.rows)};
}

/// Notes sides of triangles, in ascending order, as TileEdge has them.
class SideNotes {
 public:
  /// Behind those of the first triangles.
  SideNotes(std::span<const TileEdge> sides, std::size_t triangles) : sides_(sides.begin(), sides.end()) {
    for (const TileEdge& e : sides) next_ += e.sides_skipped + (e.sides_skipped == TileEdge::skip_only ? 0U : 1U);
    first_ = 3 * triangles;
  }
  /// Counted from the first triangle behind them.
  void add(std::size_t side, AdjacentSlopes adjacent) {
    std::size_t skipped = first_ + side - next_;
    next_ = first_ + side + 1;
    for (; skipped >= TileEdge::skip_only; skipped -= TileEdge::skip_only)
      sides_.push_back({TileEdge::skip_only, AdjacentSlopes{0, 0}});
    sides_.push_back({static_cast<std::uint8_t>(skipped), adjacent});
  }
  [[nodiscard]] std::vector<TileEdge> take() { return std::move(sides_); }

 private:
  std::vector<TileEdge> sides_;
  std::size_t first_ = 0, next_ = 0;
};

/// Makes the squares of one cell.
class ReliefTileMaker {
 public:
  ReliefTileMaker(const TileView& stored, Cell cell, const PixelHeightsFile& heights, const package::SurfacePixels& pixels,
                  const Grid& grid)
      : stored_(stored),
        heights_(heights),
        in_grid_(*heights.in_grid()),
        columns_(pixels.columns),
        corner_(grid.corner_of(cell)),
        window_(pixels_around(grid.square_of(cell), in_grid_, pixels)),
        sides_(stored.edge_sides[static_cast<std::size_t>(EdgeRole::grounded)], stored.mesh.triangles.size()) {
    place_pixels(cell, grid);
    tile_.cell = *stored.cell;
    tile_.vertices.assign(stored.mesh.vertices.begin(), stored.mesh.vertices.end());
    tile_.triangles.assign(stored.mesh.triangles.begin(), stored.mesh.triangles.end());
    tile_.runs.assign(stored.surface_runs.begin(), stored.surface_runs.end());
    number_stored_vertices();
  }

  ReliefTile make() {
    for (std::size_t row = window_.row_begin; row < window_.row_end; ++row)
      for (std::size_t column = window_.column_begin; column < window_.column_end; ++column)
        if (const Place p = place_of(column, row); is_left_out(p)) add_square(p);
    if (tile_.triangles.size() > stored_.mesh.triangles.size()) end_run();
    tile_.grounded_sides = sides_.take();
    tile_.cell.vertex_count = static_cast<std::uint32_t>(tile_.vertices.size());
    tile_.cell.triangle_count = static_cast<std::uint32_t>(tile_.triangles.size());
    tile_.cell.edge_counts[static_cast<std::size_t>(EdgeRole::grounded)] =
        static_cast<std::uint32_t>(tile_.grounded_sides.size());
    return std::move(tile_);
  }

 private:
  static constexpr std::uint32_t no_vertex = std::numeric_limits<std::uint32_t>::max();
  /// A share of a cube of the pixels' edge: far more than rounding makes of numbers of these sizes.
  static constexpr double certainly_above = 1e-6;
  /// A pixel of the raster, and its place in the window.
  struct Place {
    std::size_t pixel, in_window;
  };
  /// A pixel's centre: in the grid frame with heights as in tiles; not in the cell: a place that no square has.
  struct Centre {
    Point3d p_grid;
    bool is_in_cell;
  };

  [[nodiscard]] Place place_of(std::size_t column, std::size_t row) const {
    return {row * columns_ + column, (row - window_.row_begin) * window_.columns() + column - window_.column_begin};
  }
  [[nodiscard]] Place corner_of(const Place& p, std::size_t k) const {
    const std::size_t east = k == 1 || k == 2 ? 1 : 0, north = k >= 2 ? 1 : 0;
    return {p.pixel + east + north * columns_, p.in_window + east + north * window_.columns()};
  }
  [[nodiscard]] const Point3d& centre(const Place& p, std::size_t k) const { return centres_[corner_of(p, k).in_window].p_grid; }
  /// A square of this cell: it lies in one with all of its corners.
  [[nodiscard]] bool is_left_out(const Place& p) const {
    return (heights_.joined()[p.pixel] & PixelSquares::left_out) != 0 && centres_[p.in_window].is_in_cell;
  }
  [[nodiscard]] std::size_t fold(const Place& p) const {
    return (heights_.joined()[p.pixel] & PixelSquares::folds_aside) != 0 ? 1 : 0;
  }

  void place_pixels(Cell cell, const Grid& grid) {
    centres_.reserve(window_.columns() * (window_.row_end - window_.row_begin));
    for (std::size_t row = window_.row_begin; row < window_.row_end; ++row)
      for (std::size_t column = window_.column_begin; column < window_.column_end; ++column) {
        const Point2d p = in_grid_.centre_of(column, row);
        centres_.push_back({{p.x, p.y, static_cast<double>(heights_.height_m()[row * columns_ + column])},
                            in_grid_.cell_around(column, row, grid) == cell});
      }
    numbers_.assign(centres_.size(), no_vertex);
  }

  /// As each vertex is rounded.
  [[nodiscard]] Point3f p_cell(const Point3d& p_grid) const {
    return {static_cast<float>(p_grid.x - corner_.x), static_cast<float>(p_grid.y - corner_.y), static_cast<float>(p_grid.z)};
  }

  /// Those that lie at the centre of a pixel are found again.
  void number_stored_vertices() {
    for (std::uint32_t n = 0; n < tile_.vertices.size(); ++n) {
      const Point3f& v = tile_.vertices[n];
      const Point2d p = Point2d{v.x, v.y} + corner_;
      const double column = std::round((in_grid_.cos * p.x + in_grid_.sin * p.y - in_grid_.first_x_m) / in_grid_.step_m),
                   row = std::round((in_grid_.cos * p.y - in_grid_.sin * p.x - in_grid_.first_y_m) / in_grid_.step_m);
      const auto is_between = [](double x, std::size_t begin, std::size_t end) {
        return x >= static_cast<double>(begin) && x < static_cast<double>(end);
      };
      if (!is_between(column, window_.column_begin, window_.column_end) || !is_between(row, window_.row_begin, window_.row_end))
        continue;
      const std::size_t place = place_of(static_cast<std::size_t>(column), static_cast<std::size_t>(row)).in_window;
      if (p_cell(centres_[place].p_grid) == v) numbers_[place] = n;
    }
  }

  std::uint32_t vertex(const Place& p, std::size_t k) {
    const std::size_t place = corner_of(p, k).in_window;
    if (numbers_[place] == no_vertex) {
      numbers_[place] = static_cast<std::uint32_t>(tile_.vertices.size());
      const Point3f v = p_cell(centres_[place].p_grid);
      tile_.vertices.push_back(v);
      tile_.cell.z_low_m = std::min(tile_.cell.z_low_m, v.z);
      tile_.cell.z_high_m = std::max(tile_.cell.z_high_m, v.z);
    }
    return numbers_[place];
  }

  void add_square(const Place& p) {
    // Both triangles begin at the fold; their sides are numbered from the first side of the first triangle
    const std::size_t a = fold(p), b = a + 1, c = a + 2, d = FourPixels::next(c);
    const std::size_t first_side = 3 * (tile_.triangles.size() - stored_.mesh.triangles.size());
    tile_.triangles.push_back({vertex(p, a), vertex(p, b), vertex(p, c)});
    tile_.triangles.push_back({vertex(p, a), vertex(p, c), vertex(p, d)});
    // The fold, and the sides that another such square shares: to the east, and to the north
    if (a == 0) {
      add_side_to(p, 1, first_side + 1);
      add_edge(centre(p, a), centre(p, c), centre(p, d), centre(p, b), first_side + 3);
      add_side_to(p, 2, first_side + 4);
    } else {
      add_side_to(p, 1, first_side);
      add_side_to(p, 2, first_side + 1);
      add_edge(centre(p, a), centre(p, c), centre(p, d), centre(p, b), first_side + 3);
    }
  }

  /// Side k is the eastern or the northern one.
  void add_side_to(const Place& p, std::size_t k, std::size_t side) {
    const Place beyond = corner_of(p, k == 1 ? 1 : 3);
    if (!is_left_out(beyond)) return;
    add_edge(centre(p, k), centre(p, FourPixels::next(k)), centre(p, FourPixels::third(fold(p), k)),
             centre(beyond, FourPixels::third(fold(beyond), (k + 2) % 4)), side);
  }

  void add_edge(const Point3d& a, const Point3d& b, const Point3d& left, const Point3d& right, std::size_t side) {
    // A valley is soon told: the corner on the right lies above the plane of the facet on the left
    const double above = dot(cross(b - a, left - a), right - a);
    if (above > certainly_above * in_grid_.step_m * in_grid_.step_m * in_grid_.step_m) return;
    UpperFacets facets;
    facets.add(a, b, left);
    facets.add(a, b, right);
    if (facets.can_be_horizon(a, b)) sides_.add(side, facets.adjacent());
  }

  /// All squares are of the ground.
  void end_run() {
    const auto ground = std::find_if(stored_.surfaces.begin(), stored_.surfaces.end(),
                                     [](const package::SurfaceRecord& s) { return s.building == package::no_building; });
    if (ground == stored_.surfaces.end())
      throw PackageDamaged(heights_.name() +
                           " is damaged: it has squares of the ground in a block without ground. Pack the city again.");
    tile_.runs.push_back(
        {static_cast<std::uint32_t>(ground - stored_.surfaces.begin()), static_cast<std::uint32_t>(tile_.triangles.size())});
  }

  const TileView& stored_;
  const PixelHeightsFile& heights_;
  const PixelsInGrid& in_grid_;
  std::size_t columns_;
  Point2d corner_;
  PixelsOfCell window_;
  std::vector<Centre> centres_;         ///< of the window's pixels
  std::vector<std::uint32_t> numbers_;  ///< of their vertices
  SideNotes sides_;
  ReliefTile tile_;
};

}  // namespace

std::size_t ReliefTile::bytes() const {
  return sizeof(ReliefTile) + vertices.capacity() * sizeof(Point3f) + triangles.capacity() * sizeof(Triangle) +
         runs.capacity() * sizeof(package::SurfaceRun) + grounded_sides.capacity() * sizeof(TileEdge);
}

ReliefTile relief_tile(const TileView& stored, Cell cell, const PixelHeightsFile& heights, const package::SurfacePixels& pixels,
                       const Grid& grid) {
  return ReliefTileMaker(stored, cell, heights, pixels, grid).make();
}

ReliefTiles::ReliefTiles(const PixelHeightsFile& heights, const package::SurfacePixels& pixels, const Grid& grid)
    : heights_(heights), pixels_(pixels), grid_(grid) {
  used_.keep_at_most(most_bytes);
}

std::shared_ptr<const ReliefTile> ReliefTiles::find(std::size_t number) {
  const std::lock_guard lock(mutex_);
  const auto known = kept_.find(number);
  if (known == kept_.end()) return nullptr;
  (void)used_.use(number, known->second->bytes());
  return known->second;
}

void ReliefTiles::keep(std::size_t number, const std::shared_ptr<const ReliefTile>& tile) {
  const std::lock_guard lock(mutex_);
  kept_[number] = tile;
  for (const std::size_t other : used_.use(number, tile->bytes())) kept_.erase(other);
  if (++made_ % tiles_between_pauses == 0) heights_.let_go();
}

TileView ReliefTiles::whole(const TileView& stored, Cell cell) {
  const std::size_t number = grid_.cells.index_of(cell);
  std::shared_ptr<const ReliefTile> tile = find(number);
  if (!tile) {
    // Two threads may make the same one
    tile = std::make_shared<const ReliefTile>(relief_tile(stored, cell, heights_, pixels_, grid_));
    keep(number, tile);
  }
  TileView whole = stored;
  whole.cell = &tile->cell;
  whole.mesh = {tile->vertices, tile->triangles, tile};
  whole.surface_runs = tile->runs;
  whole.edge_sides[static_cast<std::size_t>(EdgeRole::grounded)] = tile->grounded_sides;
  return whole;
}

}  // namespace farlod
