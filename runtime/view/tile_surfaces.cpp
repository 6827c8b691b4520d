// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/tile_surfaces.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "view/vertex_clusters.hpp"

namespace farlod {
namespace {

using Corners = std::array<Point3d, 3>;

double square_of_edge(const Corners& c, std::size_t k) {
  const Point3d edge = c[(k + 1) % 3] - c[k];
  return dot(edge, edge);
}

double longest_square_of(const Corners& c) {
  return std::max({square_of_edge(c, 0), square_of_edge(c, 1), square_of_edge(c, 2)});
}

/// Divides triangles at the middle of their longest edge until no edge is too long, and keeps those whose middle is in a square.
class FacetsOfSquare {
 public:
  FacetsOfSquare(const ViewFrame& frame, const TileSquare& square, double longest_edge_m)
      : frame_(frame), square_(square), longest_square_(longest_edge_m * longest_edge_m) {}

  void add(const Corners& corners, const Point3d& normal, std::uint32_t feature) {
    if (!meets_square(corners)) return;
    std::size_t longest = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (square_of_edge(corners, k) > square_of_edge(corners, longest)) longest = k;
    if (square_of_edge(corners, longest) > longest_square_) {
      const Point3d a = corners[longest], b = corners[(longest + 1) % 3], c = corners[(longest + 2) % 3], m = 0.5 * (a + b);
      add({a, m, c}, normal, feature);
      add({m, b, c}, normal, feature);
      return;
    }
    const Point3d middle = (1.0 / 3.0) * (corners[0] + corners[1] + corners[2]);
    if (square_.contains(frame_.grid_from_local(horizontal(middle)))) facets_.push_back({corners, middle, normal, feature});
  }
  [[nodiscard]] std::vector<TileFacet> facets() && { return std::move(facets_); }

 private:
  [[nodiscard]] bool meets_square(const Corners& corners) const {
    Box2d box;
    for (const Point3d& corner : corners) box.add(frame_.grid_from_local(horizontal(corner)));
    const Point2d high = square_.low + Point2d{square_.edge_m, square_.edge_m};
    return box.low.x < high.x && box.high.x >= square_.low.x && box.low.y < high.y && box.high.y >= square_.low.y;
  }

  const ViewFrame& frame_;
  TileSquare square_;
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

}  // namespace

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

}  // namespace farlod
