// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/tiles.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/cancellation.hpp"
#include "base/expects.hpp"
#include "city/geometry.hpp"
#include "plausibility/standing_heights.hpp"
#include "tiles/batches.hpp"
#include "tiles/border_roles.hpp"
#include "tiles/building_bases.hpp"
#include "tiles/building_pieces.hpp"
#include "tiles/contacts.hpp"
#include "tiles/foundations.hpp"
#include "tiles/rim.hpp"
#include "tiles/tile_filler.hpp"
#include "tiles/undersides.hpp"

namespace farlod::tiles {
namespace {

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
    if (on_ground) tiles_.squares_of_readers = on_ground(*ground_, tiles_.height_origin_m);
    place_ground();
    place_ground_edges();
    note_ground_heights();
    const auto buildings = city_.buildings();
    Numbers numbers(0, buildings.size());
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
    // What is stored of a surface comes before what is left to readers
    const SteppedSurface* const surface = ground_->surface();
    std::size_t left = surface != nullptr ? surface->stored_triangles : std::numeric_limits<std::size_t>::max();
    const auto next = [&] {
      auto batch = faces.next(std::min(batch_size, left));
      left -= batch.size();
      return batch;
    };
    place_faces(next);
    if (surface == nullptr) return;
    filler_.end_stored_polygons();
    left = surface->triangles.size() - surface->stored_triangles;
    place_faces(next);
  }

  template <class Next>
  void place_faces(const Next& next) {
    make_and_place(
        next, stop_, [&](const GroundFace& face) { return cut_within(face.corners, grid_, tiles_.height_origin_m); },
        [&](const GroundFace& face, const std::vector<CellPiece>& pieces) {
          const auto& [a, b, c] = face.corners;
          tiles_.surfaces[ground_surface].area_m2 += 0.5 * norm(cross(b - a, c - a));
          for (const CellPiece& piece : pieces) place_ground_piece(piece);
        });
  }

  void place_ground_piece(const CellPiece& piece) {
    if (!grid_.cells.contains(piece.cell)) return;  // a terrain may reach beyond the grid
    place(piece, ground_surface);
    for (const CellEdge& side : rim_of(piece, grid_)) place(side);
  }

  void place_ground_edges() {
    if (const SteppedSurface* const surface = ground_->surface()) {
      place_edges(surface->edges, Numbers(0, surface->stored_edges));
      filler_.end_stored_edges();
      place_edges(surface->edges, Numbers(surface->stored_edges, surface->edges.size()));
      return;
    }
    GroundFaces faces(*ground_);
    make_and_place([&] { return faces.next(batch_size); }, stop_, [&](const GroundFace& face) { return cut_edges_of(face); },
                   [&](const GroundFace&, const std::vector<CellEdge>& pieces) { place_on_ground(pieces); });
  }

  void place_edges(const PagedArray<HorizonSegment>& edges, Numbers numbers) {
    make_and_place([&] { return numbers.next(batch_size); }, stop_,
                   [&](std::size_t n) { return cut_edge(edges[n], grid_, tiles_.height_origin_m); },
                   [&](std::size_t, const std::vector<CellEdge>& pieces) { place_on_ground(pieces); });
  }

  void place_on_ground(const std::vector<CellEdge>& pieces) {
    for (const CellEdge& piece : pieces)
      if (grid_.cells.contains(piece.cell) && !lies_on_rim(piece, grid_)) place(piece);
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

  void place(const CellEdge& piece) {
    FARLOD_EXPECTS(grid_.cells.contains(piece.cell));
    filler_.add_edge(piece.cell, piece.edge);
  }

  void place_building(const Building& building, BuildingPieces& cut_building, Report& report) {
    for (Problem& problem : cut_building.problems) add_problem(std::move(problem), building, report);
    if (auto buried = below_ground(building, city_.points_of(building), ground_height()))
      add_problem(std::move(*buried), building, report);
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
    std::vector<HorizonSegment> undersides = above_ground(cut_building.undersides, *ground_);
    double foundation_top_m = -std::numeric_limits<double>::infinity();
    if (!undersides.empty() && (bases_[number] != Base::above_ground || building.foot == Foot::on_ground))
      foundation_top_m = close_below(building, cut_building, undersides, report);
    std::optional<std::uint32_t> closing_surface;
    place_closing(cut_building.closing, first_surface, cut_building.only_cell, closing_surface);
    if (undersides.empty()) {
      for (const CellEdge& edge : cut_building.upper_pieces) place(edge);
      const auto closing = closing_below(std::move(cut_building.corners), cut_building.grounded_ends, ground_height());
      return place_closing(closing, first_surface, cut_building.only_cell, closing_surface);
    }
    OverhangingBuilding& overhanging = overhanging_.emplace_back();
    overhanging.only_cell = cut_building.only_cell;
    overhanging.closing_surface = closing_surface;
    if (!cut_building.walls) cut_building.walls = wall_profiles(city_, building);
    BordersWithRoles borders = borders_with_roles(cut_building, undersides, [this, foundation_top_m](Point2d p) {
      return std::max(ground_->height_at(p), foundation_top_m);
    });
    overhanging.first_surface = first_surface;
    overhanging.end_surface = static_cast<std::uint32_t>(tiles_.surfaces.size());
    overhanging.walls = walls_of(city_, building, borders.upper);
    place_closing(borders.closing, first_surface, cut_building.only_cell, overhanging.closing_surface);
    overhanging.upper_borders = std::move(borders.upper);
    overhanging.undersides = cut(borders.undersides, cut_building.only_cell);
    overhanging.corners = cut(borders.corners, cut_building.only_cell);
  }

  /// Places what closes cracks, above the ground, as one more surface of the building that `surface` is one of. It looks down, so
  /// that nothing below it counts as inside.
  void place_closing(const std::vector<ClosingTriangle>& closing, std::uint32_t surface, const std::optional<Cell>& only_cell,
                     std::optional<std::uint32_t>& number) {
    const auto is_on_ground = [this](const Point3d& p) { return p.z <= ground_->height_at(horizontal(p)) + ground_contact_m; };
    for (const ClosingTriangle& triangle : closing) {
      if (std::all_of(triangle.begin(), triangle.end(), is_on_ground)) continue;
      for (const CellPiece& piece : cut_unless_whole(triangle, only_cell, grid_, tiles_.height_origin_m)) {
        if (!grid_.cells.contains(piece.cell)) continue;
        if (!number) number = add_closing_surface(surface);
        place_as(*number, piece);
      }
    }
  }

  std::uint32_t add_closing_surface(std::uint32_t of_building) {
    const Surface beside = tiles_.surfaces[of_building];
    tiles_.surfaces.push_back({beside.building, closing_number, closing_part, SurfaceKind::foundation, {0.0, 0.0, -1.0}, 0.0});
    return static_cast<std::uint32_t>(tiles_.surfaces.size() - 1);
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

  /// Closes the space below low floors of the building that was placed last. Below the result it counts as closed everywhere.
  double close_below(const Building& building, BuildingPieces& pieces, std::vector<HorizonSegment>& undersides, Report& report) {
    const auto foundation = take_foundation(city_.points_of(building), building.foot, undersides, ground_height());
    if (foundation) place_foundation(building, pieces, *foundation, report);
    bool is_closed = foundation.has_value();
    for (const LowFloor& low : take_low_floors(pieces.slabs, undersides, ground_height())) {
      is_closed = is_closed || !low.walls.empty();
      low.walls.empty() ? add_problem(floor_in_the_air(building, low), building, report) : place_low_floor(low, pieces);
    }
    tiles_.foundation_count += is_closed ? 1 : 0;
    return foundation ? foundation->top_m : -std::numeric_limits<double>::infinity();
  }

  /// Adds what closes the space below a floor as one more surface of the building that was placed last. It looks up, as the lid
  /// of a foundation does, so that the space below the floor counts as inside.
  std::uint32_t add_foundation_surface(const BuildingPieces& pieces) {
    const Surface last = tiles_.surfaces.back();
    const auto part = static_cast<std::uint16_t>(last_part(pieces) + 1);
    tiles_.surfaces.push_back({last.building, last.number + 1, part, SurfaceKind::foundation, {0.0, 0.0, 1.0}, 0.0});
    return static_cast<std::uint32_t>(tiles_.surfaces.size() - 1);
  }

  void place_as(std::uint32_t surface, const CellPiece& piece) {
    place(piece, surface);
    tiles_.surfaces[surface].area_m2 += area_of(piece.polygon);
  }

  /// The ends of a border were computed, and may lie beyond the grid by their rounding.
  void place_within_grid(std::span<const std::array<Point3d, 3>> triangles, std::uint32_t surface,
                         const std::optional<Cell>& only_cell) {
    for (const auto& triangle : triangles)
      for (const CellPiece& piece : cut_unless_whole(triangle, only_cell, grid_, tiles_.height_origin_m))
        if (grid_.cells.contains(piece.cell)) place_as(surface, piece);
  }

  void place_foundation(const Building& building, const BuildingPieces& pieces, const Foundation& foundation, Report& report) {
    if (foundation.gap_m > storey_m) add_problem(floor_in_the_air(building, foundation), building, report);
    const std::uint32_t number = add_foundation_surface(pieces);
    place_within_grid(foundation.walls, number, pieces.only_cell);
    const auto low = static_cast<float>(foundation.top_m - tiles_.height_origin_m);
    for (const SurfacePiece& p : pieces.pieces)
      if (pieces.surfaces[p.surface].surface.kind == SurfaceKind::floor &&
          std::all_of(p.piece.polygon.begin(), p.piece.polygon.end(), [low](const Point3f& v) { return v.z <= low; }))
        place_as(number, p.piece);
  }

  void place_low_floor(const LowFloor& low, BuildingPieces& pieces) {
    const std::uint32_t number = add_foundation_surface(pieces);
    place_within_grid(low.walls, number, pieces.only_cell);
    place_within_grid(low.lid, number, pieces.only_cell);
    if (pieces.walls) add_wall_profiles(low, *pieces.walls);
  }

  /// Its position is in the grid frame.
  void add_problem(Problem problem, const Building& of, Report& report) const {
    if (of.source < sources_.size()) problem.source = sources_[of.source];
    if (problem.position) problem.position = p_projected(*problem.position);
    report.add(std::move(problem));
  }

  [[nodiscard]] GroundHeightAt ground_height() const {
    return [this](Point2d p_grid) { return ground_->height_at(p_grid); };
  }

  /// Runs after all buildings are placed: the triangles that close a lower border may belong to any building.
  void place_overhanging_buildings() {
    oneapi::tbb::parallel_for(std::size_t{0}, overhanging_.size(), [this](std::size_t n) {
      throw_if_cancelled(stop_);
      find_contacts(overhanging_[n]);
    });
    close_contacts();
    for (const OverhangingBuilding& building : overhanging_) {
      tell_what_overhangs(std::span(tiles_.surfaces).first(building.end_surface).subspan(building.first_surface),
                          building.undersides.empty() ? building.walls.all : building.walls.hidden);
      for (const CellEdge& edge : cut(placed_borders(building.upper_borders, !building.undersides.empty()), building.only_cell))
        place(edge);
      for (const CellEdge& underside : building.undersides) place(underside);
    }
    overhanging_.clear();
  }

  void find_contacts(OverhangingBuilding& building) const {
    std::vector<CellEdge> open;
    std::vector<ClosingTriangle> closing;
    for (const CellEdge& underside : building.undersides) {
      closing.clear();
      for (const HorizonEdge& part : without_contacts(underside.edge, tiles_.tile(underside.cell), closing))
        open.push_back({underside.cell, part});
      const Point2d corner = grid_.corner_of(underside.cell);
      for (ClosingTriangle& triangle : closing) {
        for (Point3d& p : triangle) p = p + Point3d{corner.x, corner.y, tiles_.height_origin_m};
        building.closing.push_back(triangle);
      }
    }
    add_ends(building.closing, building.upper_borders);
    open.insert(open.end(), building.corners.begin(), building.corners.end());
    building.undersides = std::move(open);
  }

  /// The meshes have been filled without it: only now it is known what touches.
  void close_contacts() {
    bool some = false;
    for (OverhangingBuilding& building : overhanging_) {
      place_closing(building.closing, building.first_surface, building.only_cell, building.closing_surface);
      if (building.closing_surface) tiles_.surfaces[*building.closing_surface].grounded = false;
      some = some || !building.closing.empty();
    }
    if (some) filler_.fill_meshes(tiles_);
  }

  [[nodiscard]] Point3d p_projected(const Point3d& p_grid) const {
    const Point2d p = origin_m_ + grid_.rotation.city_from_grid(horizontal(p_grid));
    return {p.x, p.y, p_grid.z};
  }

  /// No surface of a file has so high a number, and no part.
  static constexpr std::uint32_t closing_number = 0xFFFFFFFE;
  static constexpr std::uint16_t closing_part = 0xFFFE;

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
    plausibility::report_standing(located,
                                  {ground_height, plausibility::extent_of_survey(terrain, located.relief_points),
                                   terrain.has_value(), terrain ? terrain->offset_m : 0.0, terrain ? terrain->source : ""},
                                  report);
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
