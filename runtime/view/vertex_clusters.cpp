// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/vertex_clusters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

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

}  // namespace farlod
