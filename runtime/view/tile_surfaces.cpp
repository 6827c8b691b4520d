// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/tile_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <tuple>
#include <utility>

#include "farlod/points.hpp"

namespace farlod {
namespace {

/// What shares no vertices.
enum class Layer : std::uint8_t { ground, buildings };

/// The clusters that vertices of a tile have come into, each with their mean height.
class ClustersOfTile {
 public:
  explicit ClustersOfTile(const ClusterLattice& lattice) : lattice_(lattice) {}

  std::uint32_t number_of(const Point3d& p_local, Layer layer) {
    const ClusterPlace place = lattice_.place_of(p_local);
    const auto [found, is_new] = numbers_.try_emplace({place, layer}, static_cast<std::uint32_t>(clusters_.size()));
    if (is_new) clusters_.push_back({place, 0.0, 0});
    Cluster& cluster = clusters_[found->second];
    cluster.sum_of_heights += p_local.z;
    ++cluster.count;
    return found->second;
  }
  [[nodiscard]] Point3d point_local(std::uint32_t number) const {
    const Cluster& c = clusters_[number];
    const Point2d p = lattice_.point_local(c.place);
    return {p.x, p.y, c.sum_of_heights / static_cast<double>(c.count)};
  }

 private:
  struct Cluster {
    ClusterPlace place;
    double sum_of_heights;
    std::size_t count;
  };

  ClusterLattice lattice_;
  std::map<std::pair<ClusterPlace, Layer>, std::uint32_t> numbers_;
  std::vector<Cluster> clusters_;
};

using ClusterTriangle = std::array<std::uint32_t, 3>;

bool is_degenerate(const ClusterTriangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

ClusterTriangle sorted(ClusterTriangle t) {
  std::ranges::sort(t);
  return t;
}

using Corners = std::array<Point3d, 3>;

double square_of_edge(const Corners& c, std::size_t k) {
  const Point3d edge = c[(k + 1) % 3] - c[k];
  return dot(edge, edge);
}

double longest_square_of(const Corners& c) {
  return std::max({square_of_edge(c, 0), square_of_edge(c, 1), square_of_edge(c, 2)});
}

/// A side of a square in the grid frame: a coordinate of a place, from the side inwards.
struct SideOfSquare {
  double Point2d::*across;
  double place_m, inwards;

  [[nodiscard]] double inside_m(Point2d p_grid) const { return inwards * (p_grid.*across - place_m); }
};

/// Vertices of packages are rounded to less: what is cut at the border of a cell already is not cut again.
constexpr double on_side_m = 1e-4;

/// The part of a convex polygon on the inner side (Sutherland and Hodgman 1974).
std::vector<Point3d> part_inside(const ViewFrame& frame, const SideOfSquare& side, const std::vector<Point3d>& polygon_local) {
  std::vector<Point3d> part;
  for (std::size_t k = 0; k < polygon_local.size(); ++k) {
    const Point3d &a = polygon_local[k], &b = polygon_local[(k + 1) % polygon_local.size()];
    const double from_m = side.inside_m(frame.grid_from_local(horizontal(a))),
                 to_m = side.inside_m(frame.grid_from_local(horizontal(b)));
    const bool is_from_inside = from_m >= -on_side_m, is_to_inside = to_m >= -on_side_m;
    if (is_from_inside) part.push_back(a);
    if (is_from_inside != is_to_inside) part.push_back(a + std::clamp(from_m / (from_m - to_m), 0.0, 1.0) * (b - a));
  }
  return part;
}

/// Cuts triangles at the border of a square, and divides what is in it at the middle of the longest edge until no edge is too
/// long. Tiles of all levels end at the same lines, so that no part of a triangle is in none of two neighbors.
class FacetsOfSquare {
 public:
  FacetsOfSquare(const ViewFrame& frame, const TileSquare& square, double longest_edge_m)
      : frame_(frame),
        square_(square),
        sides_{{{&Point2d::x, square.low.x, 1.0},
                {&Point2d::x, square.low.x + square.edge_m, -1.0},
                {&Point2d::y, square.low.y, 1.0},
                {&Point2d::y, square.low.y + square.edge_m, -1.0}}},
        longest_square_(longest_edge_m * longest_edge_m) {}

  void add(const Corners& corners, const Point3d& normal, std::uint32_t feature) {
    std::vector<Point3d> part(corners.begin(), corners.end());
    for (const SideOfSquare& side : sides_) part = part_inside(frame_, side, part);
    for (std::size_t k = 2; k < part.size(); ++k) divide({part[0], part[k - 1], part[k]}, normal, feature);
  }
  [[nodiscard]] std::vector<TileFacet> facets() && { return std::move(facets_); }

 private:
  void divide(const Corners& corners, const Point3d& normal, std::uint32_t feature) {
    std::size_t longest = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (square_of_edge(corners, k) > square_of_edge(corners, longest)) longest = k;
    if (square_of_edge(corners, longest) > longest_square_) {
      const Point3d a = corners[longest], b = corners[(longest + 1) % 3], c = corners[(longest + 2) % 3], m = 0.5 * (a + b);
      divide({a, m, c}, normal, feature);
      divide({m, b, c}, normal, feature);
      return;
    }
    // A wall on the border belongs to one of the tiles beside it
    const Point3d middle = (1.0 / 3.0) * (corners[0] + corners[1] + corners[2]);
    const bool has_area = cross(corners[1] - corners[0], corners[2] - corners[0]) != Point3d{};
    if (has_area && square_.contains(frame_.grid_from_local(horizontal(middle))))
      facets_.push_back({corners, middle, normal, feature});
  }

  const ViewFrame& frame_;
  TileSquare square_;
  std::array<SideOfSquare, 4> sides_;
  double longest_square_;
  std::vector<TileFacet> facets_;
};

/// Numbers the features of a tile in the order in which they come.
class FeatureNumbers {
 public:
  std::uint32_t of(const MeshPart& part, const MeshTriangle& triangle) {
    const bool is_ground = !part.building;
    const std::uint32_t surface = is_ground ? 0 : triangle.surface;
    const std::uint64_t building = is_ground ? 0 : std::uint64_t{*part.building} + 1;
    const auto next = static_cast<std::uint32_t>(features_.size());
    const auto [found, is_new] = numbers_.try_emplace({building, surface, triangle.kind}, next);
    if (is_new) features_.push_back({part.id, surface, is_ground ? SurfaceKind::ground : triangle.kind});
    return found->second;
  }
  [[nodiscard]] std::vector<TileFeature> features() && { return std::move(features_); }

 private:
  std::map<std::tuple<std::uint64_t, std::uint32_t, SurfaceKind>, std::uint32_t> numbers_;
  std::vector<TileFeature> features_;
};

/// Which triangles of a larger tile are a line or a point once their vertices have moved into clusters: nearly all of them.
class VanishingTriangles {
 public:
  VanishingTriangles(const ClusterLattice& lattice, double longest_edge_m)
      : lattice_(lattice), longest_square_(longest_edge_m * longest_edge_m) {}

  void enter(const std::vector<Point3d>& vertices_local) {
    places_.clear();
    for (const Point3d& p : vertices_local) places_.push_back(lattice_.place_of(p));
  }
  /// A triangle that will be divided does not vanish: its parts fill the gap between those of its neighbors.
  [[nodiscard]] bool contain(const MeshTriangle& triangle, const Corners& corners) const {
    const auto& [a, b, c] = triangle.vertices;
    const bool is_line = places_[a] == places_[b] || places_[b] == places_[c] || places_[c] == places_[a];
    return is_line && longest_square_of(corners) <= longest_square_;
  }

 private:
  ClusterLattice lattice_;
  double longest_square_;
  std::vector<ClusterPlace> places_;  ///< of the vertices of the part that was entered
};

/// Leaves features out that no facet has any more, and keeps the order of the others.
void drop_unused_features(TileSurfaces& surfaces) {
  constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number_of(surfaces.features.size(), unused);
  for (const TileFacet& facet : surfaces.facets) number_of[facet.feature] = 0;
  std::uint32_t used = 0;
  for (std::size_t n = 0; n < number_of.size(); ++n) {
    if (number_of[n] == unused) continue;
    number_of[n] = used;
    std::swap(surfaces.features[used++], surfaces.features[n]);
  }
  surfaces.features.resize(used);
  for (TileFacet& facet : surfaces.facets) facet.feature = number_of[facet.feature];
}

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Receivers, coordinate by coordinate.
struct ReceiverColumns {
  std::vector<double> x_m, y_m, z_m;
  std::vector<Angle> azimuth, tilt;

  void add_on_ground(const Point3d& p_projected) { add({p_projected.x, p_projected.y, none}, Angle{}, Angle{}); }
  void add_on_surface(const Point3d& p_projected, const Point3d& normal, Angle convergence) {
    const Angle bearing = Angle::radians(std::atan2(normal.x, normal.y)) + convergence;
    add(p_projected + receiver_offset_m * normal, bearing, Angle::radians(std::acos(std::clamp(normal.z, -1.0, 1.0))));
  }
  [[nodiscard]] std::vector<float> values(const Package& package, std::size_t azimuths) const {
    if (x_m.empty()) return {};
    EvaluationSettings settings;
    settings.azimuths = azimuths;
    return evaluate_points(package, {x_m, y_m, z_m, azimuth, tilt}, {}, settings).svf;
  }

 private:
  void add(const Point3d& p, Angle bearing, Angle inclination) {
    x_m.push_back(p.x);
    y_m.push_back(p.y);
    z_m.push_back(p.z);
    azimuth.push_back(bearing);
    tilt.push_back(inclination);
  }
};

bool is_ground(const TileSurfaces& surfaces, const TileFacet& facet) {
  return surfaces.features[facet.feature].kind == SurfaceKind::ground;
}

/// Adds where the value of a facet is computed: at a place of its plane.
void add_receiver(const ViewFrame& frame, const TileSurfaces& surfaces, const TileFacet& facet, const Point3d& p_local,
                  ReceiverColumns& receivers) {
  const Point3d p = frame.projected_from_local(p_local);
  if (is_ground(surfaces, facet))
    receivers.add_on_ground(p);
  else
    receivers.add_on_surface(p, facet.normal, frame.convergence);
}

/// Places of a facet nearer to its corners than to its middle, in the plane in which it is computed: corners of simplified tiles
/// have moved out of it.
std::array<Point3d, 3> places_at_corners(const TileFacet& facet) {
  constexpr double share = 0.6;
  std::array<Point3d, 3> places;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Point3d way = share * (facet.corners_local[k] - facet.middle_local);
    places[k] = facet.middle_local + way - dot(way, facet.normal) * facet.normal;
  }
  return places;
}

/// A receiver that sees less is in a building, or in the gap between two that touch.
constexpr float least_free_svf = 0.02F;

/// The mean of the values that are not below `least`; NaN where there are none.
float mean_from(float least, std::span<const float> values) {
  float sum = 0.0F, count = 0.0F;
  for (const float value : values)
    if (value >= least) sum += value, count += 1.0F;
  return sum / count;
}

/// Looks at facets whose middle is covered nearer to their corners: a building may cut them, and the part beside it is seen. With
/// the value of the middle it would be a grey or a dark tooth.
void fill_cut_facets(const Package& package, const ViewFrame& frame, const TileSurfaces& surfaces, std::size_t azimuths,
                     std::vector<float>& values) {
  std::vector<std::size_t> facets;
  ReceiverColumns receivers;
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (values[n] >= least_free_svf) continue;
    const TileFacet& facet = surfaces.facets[n];
    facets.push_back(n);
    for (const Point3d& place : places_at_corners(facet)) add_receiver(frame, surfaces, facet, place, receivers);
  }
  const std::vector<float> further = receivers.values(package, azimuths);
  for (std::size_t n = 0; n < facets.size(); ++n) {
    const auto of_facet = std::span<const float>(further).subspan(3 * n, 3);
    float& value = values[facets[n]];
    if (const float free = mean_from(least_free_svf, of_facet); !std::isnan(free))
      value = free;
    else if (std::isnan(value))
      value = mean_from(0.0F, of_facet);
  }
}

}  // namespace

ClusterLattice::ClusterLattice(const ViewFrame& frame, const TileSquare& square, double error_m)
    : frame_(frame), square_(square), step_m_(square.edge_m / std::ceil(square.edge_m * std::sqrt(1.5) / error_m)) {}

ClusterPlace ClusterLattice::place_of(const Point3d& p_local) const {
  const Point2d p = frame_.grid_from_local(horizontal(p_local)) - square_.low;
  const auto nearest = [&](double along) { return static_cast<std::int32_t>(std::floor(along / step_m_ + 0.5)); };
  return {nearest(p.x), nearest(p.y), nearest(p_local.z)};
}

Point2d ClusterLattice::point_local(const ClusterPlace& place) const {
  return frame_.local_from_grid(square_.low + Point2d{place.x * step_m_, place.y * step_m_});
}

void move_into_clusters(const ViewFrame& frame, const TileSquare& square, double error_m, TileSurfaces& surfaces) {
  ClustersOfTile clusters(ClusterLattice(frame, square, error_m));
  std::vector<std::pair<TileFacet, ClusterTriangle>> kept;
  std::map<ClusterTriangle, std::size_t> known;
  for (const TileFacet& facet : surfaces.facets) {
    const bool is_ground = surfaces.features[facet.feature].kind == SurfaceKind::ground;
    const Layer layer = is_ground ? Layer::ground : Layer::buildings;
    ClusterTriangle triangle;
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = clusters.number_of(facet.corners_local[k], layer);
    if (is_degenerate(triangle)) continue;
    const auto [found, is_new] = known.try_emplace(sorted(triangle), kept.size());
    if (is_new)
      kept.emplace_back(facet, triangle);
    else if (facet.normal.z > kept[found->second].first.normal.z)  // A flat building shows its roof, not its floor
      kept[found->second] = {facet, triangle};
  }
  surfaces.facets.clear();
  for (auto& [facet, triangle] : kept) {
    for (std::size_t k = 0; k < 3; ++k) facet.corners_local[k] = clusters.point_local(triangle[k]);
    surfaces.facets.push_back(facet);
  }
}

TileSurfaces surfaces_of(const Package& package, const ViewFrame& frame, const TileTree& tree, const TileAddress& tile) {
  const double error_m = tree.geometric_error_m(tile.level), longest_edge_m = 2.0 * error_m;
  const TileSquare square = tree.square_of(tile);
  const bool is_simplified = tile.level < tree.level_of_cells();
  FacetsOfSquare facets(frame, square, longest_edge_m);
  VanishingTriangles vanishing(ClusterLattice(frame, square, error_m), longest_edge_m);
  FeatureNumbers features;
  std::vector<Point3d> vertices_local;
  for (const MeshPart& part : geometry_of(package, tree.cells_of(tile))) {
    vertices_local.clear();
    for (const Point3d& p : part.vertices_projected) vertices_local.push_back(frame.local_from_projected(p));
    if (is_simplified) vanishing.enter(vertices_local);
    for (const MeshTriangle& triangle : part.triangles) {
      const auto& [a, b, c] = triangle.vertices;
      const Corners corners{vertices_local[a], vertices_local[b], vertices_local[c]};
      if (is_simplified && vanishing.contain(triangle, corners)) continue;
      const Point3d normal = normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
      if (normal != Point3d{}) facets.add(corners, normal, features.of(part, triangle));
    }
  }
  TileSurfaces surfaces{std::move(facets).facets(), std::move(features).features()};
  if (is_simplified) move_into_clusters(frame, square, error_m, surfaces);
  drop_unused_features(surfaces);
  return surfaces;
}

std::vector<float> values_of(const Package& package, const ViewFrame& frame, const TileSurfaces& surfaces, std::size_t azimuths) {
  ReceiverColumns receivers;
  for (const TileFacet& facet : surfaces.facets) add_receiver(frame, surfaces, facet, facet.middle_local, receivers);
  std::vector<float> values = receivers.values(package, azimuths);
  fill_cut_facets(package, frame, surfaces, azimuths, values);
  return values;
}

}  // namespace farlod
