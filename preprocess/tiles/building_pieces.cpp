// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/building_pieces.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "city/geometry.hpp"
#include "tiles/facet_repair.hpp"
#include "tiles/facet_triangulation.hpp"
#include "tiles/foundations.hpp"
#include "tiles/solid_to_ground.hpp"

namespace farlod::tiles {
namespace {

struct Part {
  Point3d weighted_middle;
  double area_m2 = 0.0;
  double volume_m3 = 0.0;
};

}  // namespace

std::vector<double> outward_signs(std::span<const OrientedArea> facets) {
  std::map<std::uint16_t, Part> parts;
  for (const OrientedArea& f : facets) {
    Part& part = parts[f.part];
    const double area = norm(f.area_vector_m2);
    part.weighted_middle = part.weighted_middle + area * f.point;
    part.area_m2 += area;
  }
  for (const OrientedArea& f : facets) {
    Part& part = parts[f.part];
    if (part.area_m2 == 0.0) continue;
    const Point3d middle = (1.0 / part.area_m2) * part.weighted_middle;
    part.volume_m3 += dot(f.point - middle, f.area_vector_m2) / 3.0;
  }
  std::vector<double> signs;
  signs.reserve(facets.size());
  for (const OrientedArea& f : facets) signs.push_back(parts[f.part].volume_m3 < 0.0 ? -1.0 : 1.0);
  return signs;
}

namespace {

struct TriangulatedFacet {
  const Facet* facet;
  Triangulation triangulation;
  Point3d area_vector_m2;
  double outward = 1.0;  ///< −1 where it was drawn with its normal inward
};

class BuildingCutter {
 public:
  BuildingCutter(const CityModel& city, const Building& building, const Grid& grid, Assign assign, double height_origin_m)
      : city_(city), building_(building), grid_(grid), assign_(assign), height_origin_m_(height_origin_m) {}

  BuildingPieces run() {
    facets_.reserve(building_.facet_count);
    for (const Facet& f : city_.facets_of(building_)) triangulate_facet(f);
    make_surfaces();
    if (assign_ == Assign::whole) result_.only_cell = cell_of_footprint();
    for (const TriangulatedFacet& f : facets_) triangle_count_ += f.triangulation.triangles.size();
    result_.pieces.reserve(triangle_count_);
    for (const TriangulatedFacet& f : facets_) cut_facet(f);
    find_borders();
    return std::move(result_);
  }

 private:
  void report(ProblemCode code, const FacetFinding& finding, const Facet& facet) {
    const std::string surface = "surface " + std::to_string(facet.surface);
    result_.problems.push_back({.code = code,
                                .source = "",
                                .place = building_.id,
                                .detail = surface + ": " + finding.detail,
                                .position = finding.position,
                                .ring = surface + name_of_ring(finding.ring)});
  }

  void report(ProblemCode code, const Facet& facet, const std::string& detail) {
    report(code, {code, 0, detail, city_.ring(facet, 0).front()}, facet);
  }

  void triangulate_facet(const Facet& facet) {
    const RepairedFacet repaired = repaired_rings(city_, facet);
    for (const FacetFinding& finding : repaired.findings) report(finding.code, finding, facet);
    const std::span<const std::span<const Point3d>> rings = repaired.rings;
    Triangulation t = triangulate(rings);
    if (t.triangles.empty()) return report(ProblemCode::zero_area, facet, "its points lie on a line");
    if (t.rings_cross) report(ProblemCode::self_intersecting, facet, "what an odd number of its rings surrounds was kept");
    const Point3d area_vector_m2 = t.rings_cross ? area_vector(t) : area_vector(rings);
    if (const double d = distance_from_plane_m(rings, normalized(area_vector_m2)); d > planarity_tolerance_m)
      report(ProblemCode::not_planar, facet, "a point is " + metres(d) + " off its plane");
    facets_.push_back({&facet, std::move(t), area_vector_m2});
  }

  void make_surfaces() {
    std::vector<OrientedArea> areas;
    areas.reserve(facets_.size());
    result_.surfaces.reserve(facets_.size());
    for (const TriangulatedFacet& f : facets_) areas.push_back({f.area_vector_m2, f.triangulation.points.front(), f.facet->part});
    const std::vector<double> outward = outward_signs(areas);
    std::vector<Point3d> total_vectors;
    total_vectors.reserve(facets_.size());
    for (std::size_t n = 0; n < facets_.size(); ++n) {
      const Facet& facet = *facets_[n].facet;
      if (facet.surface >= place_of_surface_.size()) place_of_surface_.resize(facet.surface + 1, no_place);
      std::size_t& place = place_of_surface_[facet.surface];
      if (place == no_place) {
        place = result_.surfaces.size();
        result_.surfaces.push_back({{0, facet.surface, facet.part, facet.kind, {}, 0.0}, {}});
        total_vectors.emplace_back();
      }
      facets_[n].outward = outward[n];
      add_to_surface(place, facets_[n], total_vectors[place]);
    }
    for (std::size_t s = 0; s < result_.surfaces.size(); ++s) finish_surface(result_.surfaces[s], total_vectors[s]);
  }

  void add_to_surface(std::size_t s, const TriangulatedFacet& f, Point3d& total_vector) {
    BuildingSurface& surface = result_.surfaces[s];
    total_vector = total_vector + f.outward * f.area_vector_m2;
    for (const Triangle& t : f.triangulation.triangles) {
      const Point3d &a = f.triangulation.points[t.a], &b = f.triangulation.points[t.b], &c = f.triangulation.points[t.c];
      const double area = 0.5 * norm(cross(b - a, c - a));
      surface.surface.area_m2 += area;
      surface.middle = surface.middle + (area / 3.0) * (a + b + c);
    }
  }

  /// The kind that the file gives overrules the orientation of the polygon: the normal of a roof points upwards.
  static void finish_surface(BuildingSurface& s, const Point3d& total_vector) {
    Point3d normal = normalized(total_vector);
    SurfaceKind& kind = s.surface.kind;
    if (kind == SurfaceKind::unknown) kind = kind_of_normal(normal);
    const bool upside_down = (kind == SurfaceKind::roof && normal.z < 0.0) || (kind == SurfaceKind::floor && normal.z > 0.0);
    s.surface.normal = upside_down ? -1.0 * normal : normal;
    if (s.surface.area_m2 > 0.0) s.middle = (1.0 / s.surface.area_m2) * s.middle;
  }

  [[nodiscard]] Cell cell_of_footprint() const {
    Point2d weighted;
    double area = 0.0;
    for (const BuildingSurface& s : result_.surfaces) {
      const double share = s.surface.area_m2 * std::abs(s.surface.normal.z);
      weighted = weighted + share * horizontal(s.middle);
      area += share;
    }
    const auto points = city_.points_of(building_);
    return grid_.cell_of(area > 0.0 ? (1.0 / area) * weighted : horizontal(points.front()));
  }

  void cut_facet(const TriangulatedFacet& f) {
    const auto surface = static_cast<std::uint32_t>(place_of_surface_[f.facet->surface]);
    for (const Triangle& t : f.triangulation.triangles) {
      const std::array corners{f.triangulation.points[t.a], f.triangulation.points[t.b], f.triangulation.points[t.c]};
      pieces_.clear();
      cut_unless_whole(corners, result_.only_cell, grid_, height_origin_m_, pieces_);
      for (const CellPiece& piece : pieces_) result_.pieces.push_back({piece, surface});
    }
  }

  static FacetLook look_of(const TriangulatedFacet& f) {
    return f.outward * f.area_vector_m2.z > 0.0 ? FacetLook::up : FacetLook::down;
  }

  void find_borders() {
    EdgeTable table;
    // Most triangles share their three edges with others
    table.reserve(2 * triangle_count_);
    for (const TriangulatedFacet& f : facets_) {
      for (const Triangle& t : f.triangulation.triangles)
        table.add_triangle(f.triangulation.points[t.a], f.triangulation.points[t.b], f.triangulation.points[t.c], look_of(f));
    }
    result_.upper_borders = table.horizon_edges();
    result_.upper_pieces.reserve(result_.upper_borders.size());
    for (const HorizonSegment& edge : result_.upper_borders) {
      const auto pieces = cut_edge_unless_whole(edge, result_.only_cell, grid_, height_origin_m_);
      result_.upper_pieces.insert(result_.upper_pieces.end(), pieces.begin(), pieces.end());
    }
    result_.undersides = undersides(table.edges(), result_.closing);
    find_leaning_corners(table.edges());
    if (result_.undersides.empty()) result_.upper_borders = {};
    if (!has_undersides_above_floor()) return;
    result_.walls = wall_profiles(city_, building_);
    for (const EdgeSides& e : table.edges())
      if (e.triangle_count() % 2 != 0) result_.loose_edges.push_back(e.edge());
    find_slabs();
  }

  void find_leaning_corners(std::span<const EdgeSides> edges) {
    result_.corners = leaning_corners(edges);
    if (result_.corners.empty()) return;
    for (const TriangulatedFacet& f : facets_)
      for (const Triangle& t : f.triangulation.triangles)
        add_facet({f.triangulation.points[t.a], f.triangulation.points[t.b], f.triangulation.points[t.c]}, result_.corners);
    result_.grounded_ends = ends_of(result_.upper_borders);
  }

  void find_slabs() {
    for (const TriangulatedFacet& f : facets_)
      for (const Triangle& t : f.triangulation.triangles) {
        const std::array corners{f.triangulation.points[t.a], f.triangulation.points[t.b], f.triangulation.points[t.c]};
        if (const auto slab = slab_of(corners, look_of(f))) result_.slabs.push_back(*slab);
      }
  }

  [[nodiscard]] bool has_undersides_above_floor() const {
    if (result_.undersides.empty()) return false;
    double lowest_m = std::numeric_limits<double>::infinity();
    for (const Point3d& p : city_.points_of(building_)) lowest_m = std::min(lowest_m, p.z);
    return std::any_of(result_.undersides.begin(), result_.undersides.end(), [&](const HorizonSegment& s) {
      return std::max(s.segment.a.z, s.segment.b.z) > lowest_m + lowest_floor_thickness_m;
    });
  }

  const CityModel& city_;
  const Building& building_;
  const Grid& grid_;
  Assign assign_;
  double height_origin_m_;
  std::vector<TriangulatedFacet> facets_;
  static constexpr std::size_t no_place = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> place_of_surface_;  ///< in the result, by number
  std::size_t triangle_count_ = 0;
  std::vector<CellPiece> pieces_;  ///< of one triangle
  BuildingPieces result_;
};

}  // namespace

std::uint16_t last_part(const BuildingPieces& pieces) {
  std::uint16_t last = 0;
  for (const BuildingSurface& s : pieces.surfaces) last = std::max(last, s.surface.part);
  return last;
}

BuildingPieces cut_building(const CityModel& city_grid, const Building& building, const Grid& grid, Assign assign,
                            double height_origin_m) {
  return BuildingCutter(city_grid, building, grid, assign, height_origin_m).run();
}

std::vector<WallProfile> wall_profiles(const CityModel& city_grid, const Building& building) {
  std::vector<WallProfile> walls;
  for (const Facet& facet : city_grid.facets_of(building)) {
    const RepairedFacet repaired = repaired_rings(city_grid, facet);
    if (repaired.rings.size() != 1) continue;
    std::optional<WallProfile> wall = wall_profile(repaired.rings.front());
    if (!wall) continue;
    const Triangulation t = triangulate(repaired.rings);
    if (!t.triangles.empty() && !t.rings_cross) walls.push_back(std::move(*wall));
  }
  return walls;
}

}  // namespace farlod::tiles
