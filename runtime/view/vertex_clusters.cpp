// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/vertex_clusters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <tuple>
#include <vector>

namespace farlod {
namespace {

/// What shares no vertices.
enum class Layer : std::uint8_t { ground, buildings };

/// A point of a lattice, of the vertices of one layer.
struct ClusterPlace {
  std::int32_t x = 0, y = 0, z = 0;
  Layer layer = Layer::ground;
  auto operator<=>(const ClusterPlace&) const = default;
};

/// In the plan, vertices go to the nearest point of a lattice that divides the square's edges evenly; in height, to the mean of
/// those that have the same nearest level. With a step s they move by s/√2 in the plan, and by s in height at the most: √1.5 s.
class ClustersOfTile {
 public:
  ClustersOfTile(const ViewFrame& frame, const TileSquare& square, double error_m)
      : frame_(frame), square_(square), step_m_(square.edge_m / std::ceil(square.edge_m * std::sqrt(1.5) / error_m)) {}

  std::uint32_t number_of(const Point3d& p_local, Layer layer) {
    const Point2d p = frame_.grid_from_local(horizontal(p_local)) - square_.low;
    const auto nearest = [&](double along) { return static_cast<std::int32_t>(std::lround(along / step_m_)); };
    const ClusterPlace place{nearest(p.x), nearest(p.y), nearest(p_local.z), layer};
    const auto [found, is_new] = numbers_.try_emplace(place, static_cast<std::uint32_t>(clusters_.size()));
    if (is_new) clusters_.push_back({place, 0.0, 0});
    Cluster& cluster = clusters_[found->second];
    cluster.sum_of_heights += p_local.z;
    ++cluster.count;
    return found->second;
  }
  [[nodiscard]] Point3d point_local(std::uint32_t number) const {
    const Cluster& c = clusters_[number];
    const Point2d p = frame_.local_from_grid(square_.low + Point2d{c.place.x * step_m_, c.place.y * step_m_});
    return {p.x, p.y, c.sum_of_heights / static_cast<double>(c.count)};
  }

 private:
  struct Cluster {
    ClusterPlace place;
    double sum_of_heights;
    std::size_t count;
  };

  const ViewFrame& frame_;
  TileSquare square_;
  double step_m_;
  std::map<ClusterPlace, std::uint32_t> numbers_;
  std::vector<Cluster> clusters_;
};

using ClusterTriangle = std::array<std::uint32_t, 3>;

bool is_degenerate(const ClusterTriangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

ClusterTriangle sorted(ClusterTriangle t) {
  std::ranges::sort(t);
  return t;
}

}  // namespace

void move_into_clusters(const ViewFrame& frame, const TileSquare& square, double error_m, TileSurfaces& surfaces) {
  ClustersOfTile clusters(frame, square, error_m);
  std::vector<std::pair<TileFacet, ClusterTriangle>> kept;
  std::set<ClusterTriangle> known;
  for (const TileFacet& facet : surfaces.facets) {
    const bool is_ground = surfaces.features[facet.feature].kind == SurfaceKind::ground;
    const Layer layer = is_ground ? Layer::ground : Layer::buildings;
    ClusterTriangle triangle;
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = clusters.number_of(facet.corners_local[k], layer);
    if (!is_degenerate(triangle) && known.insert(sorted(triangle)).second) kept.emplace_back(facet, triangle);
  }
  surfaces.facets.clear();
  for (auto& [facet, triangle] : kept) {
    for (std::size_t k = 0; k < 3; ++k) facet.corners_local[k] = clusters.point_local(triangle[k]);
    surfaces.facets.push_back(facet);
  }
}

}  // namespace farlod
