// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/tiles.hpp"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_pipeline.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/cancellation.hpp"
#include "base/expects.hpp"
#include "city/geometry.hpp"
#include "plausibility/standing_heights.hpp"
#include "tiles/border_roles.hpp"
#include "tiles/building_bases.hpp"
#include "tiles/building_pieces.hpp"
#include "tiles/tile_filler.hpp"
#include "tiles/undersides.hpp"

namespace farlod::tiles {
namespace {

/// Objects that one thread cuts in one batch, and batches that may wait to be placed. This bounds the memory of what waits.
constexpr std::size_t batch_size = 256, batches_at_once = 16;

double area_of(std::span<const Point3f> convex_polygon) {
  double area_m2 = 0.0;
  for (std::size_t n = 2; n < convex_polygon.size(); ++n)
    area_m2 += 0.5 * norm(cross(convex_polygon[n - 1] - convex_polygon[0], convex_polygon[n] - convex_polygon[0]));
  return area_m2;
}

/// Calls place(item, make(item)) for each item that `next` hands out: some at a time, none at the end. The calls of `make` run in
/// parallel; those of `place` run in order, one at a time.
template <class Next, class Make, class Place>
void make_and_place(const Next& next, const std::stop_token& stop, const Make& make, const Place& place) {
  namespace tbb = oneapi::tbb;
  using Items = decltype(next());
  using Batch = std::pair<Items, std::vector<decltype(make(std::declval<Items>().front()))>>;
  const auto begin_batch = [&](tbb::flow_control& flow) {
    Items items = next();
    if (items.empty()) flow.stop();
    return items;
  };
  const auto make_batch = [&](Items items) {
    Batch batch{std::move(items), {}};
    for (const auto& item : batch.first) {
      throw_if_cancelled(stop);
      batch.second.push_back(make(item));
    }
    return batch;
  };
  const auto place_batch = [&](Batch batch) {
    for (std::size_t k = 0; k < batch.second.size(); ++k) place(batch.first[k], batch.second[k]);
  };
  tbb::parallel_pipeline(batches_at_once, tbb::make_filter<void, Items>(tbb::filter_mode::serial_in_order, begin_batch) &
                                              tbb::make_filter<Items, Batch>(tbb::filter_mode::parallel, make_batch) &
                                              tbb::make_filter<Batch, void>(tbb::filter_mode::serial_in_order, place_batch));
}

/// Hands out the numbers below `count`.
class Numbers {
 public:
  explicit Numbers(std::size_t count) : count_(count) {}
  std::vector<std::size_t> next(std::size_t most) {
    std::vector<std::size_t> numbers;
    for (; numbers.size() < most && next_ < count_; ++next_) numbers.push_back(next_);
    return numbers;
  }

 private:
  std::size_t count_, next_ = 0;
};

class TileCutter {
 public:
  TileCutter(CityModel city_grid, const LocatedCity& located, const Grid& grid, Assign assign, Ground ground,
             std::span<const Base> bases, std::stop_token stop)
      : city_(std::move(city_grid)),
        sources_(located.sources),
        origin_m_(located.georeference.origin_m),
        grid_(grid),
        assign_(assign),
        ground_(std::move(ground)),
        bases_(bases),
        stop_(std::move(stop)),
        filler_(grid) {
    tiles_.cells = grid.cells;
    tiles_.tiles.resize(static_cast<std::size_t>(grid.cells.size()));
    tiles_.height_origin_m = lowest_whole_metre();
  }

  TileSet run(Report& report, const OnGround& on_ground) {
    if (on_ground) on_ground(*ground_, tiles_.height_origin_m);
    place_ground();
    place_ground_edges();
    note_ground_heights();
    const auto buildings = city_.buildings();
    Numbers numbers(buildings.size());
    make_and_place([&] { return numbers.next(batch_size); }, stop_,
                   [&](std::size_t n) { return cut_building(city_, buildings[n], grid_, assign_, tiles_.height_origin_m); },
                   [&](std::size_t n, BuildingPieces& pieces) {
                     place_building(buildings[n], pieces, report);
                     if (n % CityModel::buildings_held == 0) city_.let_go_before(n);
                   });
    // The tiles take as much room on the disk as what they are filled from: first make room
    city_ = CityModel();
    if (overhanging_.empty()) ground_.reset();
    filler_.fill_meshes(tiles_);
    place_overhanging_buildings();
    ground_.reset();
    filler_.fill_edges(tiles_);
    return std::move(tiles_);
  }

 private:
  /// A building with lower borders that none of its own facets closes.
  struct OverhangingBuilding {
    std::vector<UpperBorder> upper_borders;
    std::vector<CellEdge> undersides, corners;
    std::optional<Cell> only_cell;
    struct {
      std::uint32_t begin = 0, end = 0;
    } surfaces;  ///< in TileSet::surfaces
  };

  [[nodiscard]] double lowest_whole_metre() const {
    double lowest = ground_->lowest_m().value_or(std::numeric_limits<double>::infinity());
    city_.for_each_building([&](std::size_t, const Building& b) {
      for (const Point3d& p : city_.points_of(b)) lowest = std::min(lowest, p.z);
    });
    return std::isfinite(lowest) ? std::floor(lowest) : 0.0;
  }

  void place_ground() {
    tiles_.surfaces.push_back({ground_building, 0, 0, SurfaceKind::ground, {0.0, 0.0, 1.0}, 0.0});
    GroundFaces faces(*ground_);
    make_and_place([&] { return faces.next(batch_size); }, stop_,
                   [&](const GroundFace& face) { return cut_within(face.corners, grid_, tiles_.height_origin_m); },
                   [&](const GroundFace& face, const std::vector<CellPiece>& pieces) {
                     const auto& [a, b, c] = face.corners;
                     tiles_.surfaces[ground_surface].area_m2 += 0.5 * norm(cross(b - a, c - a));
                     for (const CellPiece& piece : pieces) place_ground_piece(piece);
                   });
  }

  void place_ground_piece(const CellPiece& piece) {
    if (!grid_.cells.contains(piece.cell)) return;  // a terrain may reach beyond the grid
    place(piece, ground_surface);
    place_rim(piece);
  }

  void place_ground_edges() {
    if (const auto* const edges = ground_->edges_of_surface()) {
      Numbers numbers(edges->size());
      make_and_place([&] { return numbers.next(batch_size); }, stop_,
                     [&](std::size_t n) { return cut_edge((*edges)[n], grid_, tiles_.height_origin_m); },
                     [&](std::size_t, const std::vector<CellEdge>& pieces) { place_on_ground(pieces); });
      return;
    }
    GroundFaces faces(*ground_);
    make_and_place([&] { return faces.next(batch_size); }, stop_, [&](const GroundFace& face) { return cut_edges_of(face); },
                   [&](const GroundFace&, const std::vector<CellEdge>& pieces) { place_on_ground(pieces); });
  }

  void place_on_ground(const std::vector<CellEdge>& pieces) {
    for (const CellEdge& piece : pieces)
      if (grid_.cells.contains(piece.cell) && !lies_on_rim(piece)) place(piece);
  }

  [[nodiscard]] std::vector<CellEdge> cut_edges_of(const GroundFace& face) const {
    std::vector<CellEdge> pieces;
    for (const HorizonSegment& edge : face.horizon_edges()) {
      const std::vector<CellEdge> of_edge = cut_edge(edge, grid_, tiles_.height_origin_m);
      pieces.insert(pieces.end(), of_edge.begin(), of_edge.end());
    }
    return pieces;
  }

  void note_ground_heights() {
    for (std::size_t n = 0; n < tiles_.tiles.size(); ++n) {
      const double height = ground_->height_at(grid_.centre_of(grid_.cells.cell_at(n)));
      tiles_.tiles[n].ground_at_centre_m = static_cast<float>(height - tiles_.height_origin_m);
    }
  }

  /// The grid covers all buildings: a piece beyond it would be a bug.
  void place(const CellPiece& piece, std::uint32_t surface) {
    FARLOD_EXPECTS(grid_.cells.contains(piece.cell));
    filler_.add_polygon(piece.cell, piece.polygon, surface);
  }

  /// The cut along the outer border of the grid is an edge of the remaining ground.
  void place_rim(const CellPiece& piece) {
    for (std::size_t k = 0; k < piece.polygon.size(); ++k) {
      const CellEdge side{piece.cell, {piece.polygon[k], piece.polygon[(k + 1) % piece.polygon.size()], {}}};
      if (lies_on_rim(side)) place(side);
    }
  }

  [[nodiscard]] bool lies_on_rim(const CellEdge& piece) const {
    const auto edge_m = static_cast<float>(grid_.cell_edge_m);
    const Point3f &a = piece.edge.a, &b = piece.edge.b;
    return (piece.cell.i == grid_.cells.i_begin && a.x == 0.0F && b.x == 0.0F) ||
           (piece.cell.j == grid_.cells.j_begin && a.y == 0.0F && b.y == 0.0F) ||
           (piece.cell.i == grid_.cells.i_end - 1 && a.x == edge_m && b.x == edge_m) ||
           (piece.cell.j == grid_.cells.j_end - 1 && a.y == edge_m && b.y == edge_m);
  }

  void place(const CellEdge& piece) {
    FARLOD_EXPECTS(grid_.cells.contains(piece.cell));
    filler_.add_edge(piece.cell, piece.edge);
  }

  void place_building(const Building& building, BuildingPieces& cut_building, Report& report) {
    for (Problem& problem : cut_building.problems) {
      if (building.source < sources_.size()) problem.source = sources_[building.source];
      if (problem.position) problem.position = p_projected(*problem.position);
      report.add(std::move(problem));
    }
    const auto number = static_cast<std::uint32_t>(tiles_.building_ids.size());
    const auto first_surface = static_cast<std::uint32_t>(tiles_.surfaces.size());
    tiles_.building_ids.push_back(building.id);
    tiles_.sources.buildings.push_back({building.source, building.origin_bytes});
    tiles_.sources.origins.append(city_.origin_of(building));
    tiles_.polygon_count += cut_building.surfaces.size();
    for (BuildingSurface& s : cut_building.surfaces) {
      s.surface.building = number;
      tiles_.surfaces.push_back(s.surface);
    }
    for (const SurfacePiece& p : cut_building.pieces) place(p.piece, first_surface + p.surface);
    std::vector<HorizonSegment> undersides = above_ground(cut_building.undersides);
    double foundation_top_m = -std::numeric_limits<double>::infinity();
    if (!undersides.empty() && (bases_[number] != Base::above_ground || building.foot == Foot::on_ground))
      if (const auto foundation = take_foundation(city_.points_of(building), building.foot, undersides, ground_height())) {
        place_foundation(building, cut_building, *foundation, report);
        foundation_top_m = foundation->top_m;
      }
    if (undersides.empty()) {
      for (const CellEdge& edge : cut_building.upper_pieces) place(edge);
      return;
    }
    OverhangingBuilding& overhanging = overhanging_.emplace_back();
    overhanging.only_cell = cut_building.only_cell;
    overhanging.surfaces = {first_surface, static_cast<std::uint32_t>(tiles_.surfaces.size())};
    if (!cut_building.walls) cut_building.walls = wall_profiles(city_, building);
    BordersWithRoles borders = borders_with_roles(cut_building, undersides, [this, foundation_top_m](Point2d p) {
      return std::max(ground_->height_at(p), foundation_top_m);
    });
    overhanging.upper_borders = std::move(borders.upper);
    overhanging.undersides = cut(borders.undersides, cut_building.only_cell);
    overhanging.corners = cut(borders.corners, cut_building.only_cell);
  }

  [[nodiscard]] std::vector<CellEdge> cut(const std::vector<HorizonSegment>& borders,
                                          const std::optional<Cell>& only_cell) const {
    std::vector<CellEdge> pieces;
    for (const HorizonSegment& border : borders) {
      const auto edges = cut_edge_unless_whole(border, only_cell, grid_, tiles_.height_origin_m);
      pieces.insert(pieces.end(), edges.begin(), edges.end());
    }
    return pieces;
  }

  /// Places the walls and the lid of a foundation as one more surface of the building that was placed last.
  void place_foundation(const Building& building, const BuildingPieces& pieces, const Foundation& foundation, Report& report) {
    if (foundation.gap_m > storey_m) report_gap(building, foundation, report);
    const Surface& last = tiles_.surfaces.back();
    const auto part = static_cast<std::uint16_t>(last_part(pieces) + 1);
    const Surface surface{last.building, last.number + 1, part, SurfaceKind::foundation, {0.0, 0.0, 1.0}, 0.0};
    const auto number = static_cast<std::uint32_t>(tiles_.surfaces.size());
    tiles_.surfaces.push_back(surface);
    const auto place_piece = [&](const CellPiece& piece) {
      place(piece, number);
      tiles_.surfaces[number].area_m2 += area_of(piece.polygon);
    };
    // The ends of a border were computed, and may lie beyond the grid by their rounding
    for (const auto& triangle : foundation.walls)
      for (const CellPiece& piece : cut_unless_whole(triangle, pieces.only_cell, grid_, tiles_.height_origin_m))
        if (grid_.cells.contains(piece.cell)) place_piece(piece);
    // The floor is the lid of the foundation too, so that the space below the floor counts as inside
    const auto low = static_cast<float>(foundation.top_m - tiles_.height_origin_m);
    for (const SurfacePiece& p : pieces.pieces)
      if (pieces.surfaces[p.surface].surface.kind == SurfaceKind::floor &&
          std::all_of(p.piece.polygon.begin(), p.piece.polygon.end(), [low](const Point3f& v) { return v.z <= low; }))
        place_piece(p.piece);
    ++tiles_.foundation_count;
  }

  void report_gap(const Building& building, const Foundation& foundation, Report& report) const {
    Problem problem{ProblemCode::floor_in_the_air,
                    {},
                    building.id,
                    "the lowest floor is up to " + metres(foundation.gap_m) + " above the ground: closed down to it"};
    if (building.source < sources_.size()) problem.source = sources_[building.source];
    problem.position = p_projected(foundation.place);
    report.add(std::move(problem));
  }

  static std::uint16_t last_part(const BuildingPieces& pieces) {
    std::uint16_t last = 0;
    for (const BuildingSurface& s : pieces.surfaces) last = std::max(last, s.surface.part);
    return last;
  }

  [[nodiscard]] GroundHeightAt ground_height() const {
    return [this](Point2d p_grid) { return ground_->height_at(p_grid); };
  }

  /// Runs after all buildings are placed: the triangles that close a lower border may belong to any building.
  void place_overhanging_buildings() {
    oneapi::tbb::parallel_for(std::size_t{0}, overhanging_.size(), [this](std::size_t n) {
      throw_if_cancelled(stop_);
      std::vector<CellEdge> open;
      for (const CellEdge& underside : overhanging_[n].undersides)
        for (const HorizonEdge& part : without_contacts(underside.edge, tiles_.tile(underside.cell)))
          open.push_back({underside.cell, part});
      open.insert(open.end(), overhanging_[n].corners.begin(), overhanging_[n].corners.end());
      overhanging_[n].undersides = std::move(open);
    });
    for (const OverhangingBuilding& building : overhanging_) {
      // A roof whose borders all touch walls shows no sky below them. A receiver below it still has it overhead
      for (std::uint32_t s = building.surfaces.begin; s < building.surfaces.end; ++s) tiles_.surfaces[s].grounded = false;
      for (const CellEdge& edge : cut(placed_borders(building.upper_borders, !building.undersides.empty()), building.only_cell))
        place(edge);
      for (const CellEdge& underside : building.undersides) place(underside);
    }
    overhanging_.clear();
  }

  /// The parts of undersides that are above the ground.
  [[nodiscard]] std::vector<HorizonSegment> above_ground(const std::vector<HorizonSegment>& undersides) const {
    std::vector<HorizonSegment> result;
    for (const HorizonSegment& underside : undersides) {
      const Point3d &a = underside.segment.a, &b = underside.segment.b;
      const auto intervals = static_cast<std::size_t>(ground_sampling_intervals(norm(horizontal(b - a))));
      const auto point_at = [&](std::size_t k) { return a + static_cast<double>(k) / static_cast<double>(intervals) * (b - a); };
      std::vector<bool> is_above;
      for (std::size_t k = 0; k <= intervals; ++k) is_above.push_back(ground_->is_above(point_at(k), ground_contact_m));
      // An interval counts as above the ground when one of its ends is; join consecutive intervals
      for (std::size_t from = 0, to = 0; from < intervals; from = to + 1) {
        for (to = from; to < intervals && (is_above[to] || is_above[to + 1]); ++to) {
        }
        if (to > from) result.push_back({{point_at(from), point_at(to)}, underside.adjacent, underside.role});
      }
    }
    return result;
  }

  [[nodiscard]] Point3d p_projected(const Point3d& p_grid) const {
    const Point2d p = origin_m_ + grid_.rotation.city_from_grid(horizontal(p_grid));
    return {p.x, p.y, p_grid.z};
  }

  CityModel city_;  ///< until all is cut
  std::span<const std::string> sources_;
  Point2d origin_m_;
  const Grid& grid_;
  Assign assign_;
  std::optional<Ground> ground_;  ///< until no building asks for it any more
  std::span<const Base> bases_;   ///< for each building
  std::stop_token stop_;
  std::vector<OverhangingBuilding> overhanging_;
  TileFiller filler_;
  TileSet tiles_;
};

}  // namespace

TileSet cut_into_tiles(LocatedCity located, const Grid& grid, Assign assign, const std::optional<TerrainRaster>& terrain,
                       Report& report, const std::stop_token& stop, const OnGround& on_ground) {
  throw_if_cancelled(stop);
  // The ground covers the whole grid between and around buildings. Of a terrain alone nothing is known beyond its points
  const GroundExtent extent = located.city.buildings().empty() ? GroundExtent::points : GroundExtent::rectangle;
  std::optional<Ground> surveyed = surveyed_ground(terrain, located.relief_points, grid, extent);
  const auto ground_height = [&](Point2d p_city) -> std::optional<double> {
    // Gaps of the raster, and places beyond it, get the height of the network through its nodes
    if (const auto height_m = terrain ? terrain->height_at(p_city) : std::nullopt) return height_m;
    return surveyed ? std::optional(surveyed->height_at(grid.rotation.grid_from_city(p_city))) : std::nullopt;
  };
  if (surveyed)
    plausibility::report_standing(
        located, {ground_height, plausibility::extent_of_survey(terrain, located.relief_points), terrain.has_value()}, report);
  lift_onto_terrain(located, ground_height, report);
  CityModel city = std::move(located.city);
  city.for_each_building([&](std::size_t, const Building& b) {
    for (Point3d& p : city.points_of(b)) p = grid.rotation.grid_from_city(p);  // exactness begins here
  });
  // The bases of buildings define the ground only where no survey does
  const std::vector<Base> bases = surveyed ? bases_on_survey(city) : bases_of(city);
  Ground ground = surveyed ? std::move(*surveyed) : Ground(base_points(city, bases), grid.rectangle(), extent);
  return TileCutter(std::move(city), located, grid, assign, std::move(ground), bases, stop).run(report, on_ground);
}

}  // namespace farlod::tiles
