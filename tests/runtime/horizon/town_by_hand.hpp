// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <vector>

#include "base/mesh_view.hpp"
#include "farlod/point.hpp"
#include "horizon/cell_silhouettes.hpp"
#include "occlusion/occluder.hpp"
#include "package/horizon_edge.hpp"
#include "tests/runtime/horizon/random_places.hpp"

namespace farlod {

/// A town of boxes that stand on the ground and of bodies that float: as silhouette edges, and as triangles for rays.
class TownByHand {
 public:
  using Corners = std::array<Point3f, 3>;
  using Quad = std::array<Point3f, 4>;

  /// A box on the ground, with a flat roof.
  void add_box(Point2d low, Point2d size, double height_m) {
    const std::array<Point3f, 8> c = corners(low, size, 0.0, height_m);
    for (std::size_t n = 0; n < 4; ++n) {
      const std::size_t next = (n + 1) % 4;
      add_edge({c[4 + n], c[4 + next], level_and_down, EdgeRole::grounded});
      add_facet({c[n], c[next], c[4 + next], c[4 + n]}, true);
    }
    add_facet({c[4], c[5], c[6], c[7]}, true);
  }
  /// A level slab without thickness.
  void add_slab(Point2d low, Point2d size, double z_m) {
    const std::array<Point3f, 8> c = corners(low, size, 0.0, z_m);
    add_facet({c[4], c[5], c[6], c[7]}, false);
    for (std::size_t n = 0; n < 4; ++n) add_border_of_slab(c[4 + n], c[4 + (n + 1) % 4]);
  }
  /// A box that floats.
  void add_beam(Point2d low, Point2d size, double low_m, double high_m) {
    const std::array<Point3f, 8> c = corners(low, size, low_m, high_m);
    for (std::size_t n = 0; n < 4; ++n) {
      const std::size_t next = (n + 1) % 4;
      add_edge({c[4 + n], c[4 + next], level_and_down, EdgeRole::overhang});
      add_edge({c[n], c[next], level_and_none, EdgeRole::underside});
      add_facet({c[n], c[next], c[4 + next], c[4 + n]}, false);
    }
    add_facet({c[4], c[5], c[6], c[7]}, false);
    add_facet({c[0], c[1], c[2], c[3]}, false);
  }
  /// A triangle that floats.
  void add_floating(const Corners& t) {
    overhanging_.push_back(t);
    city_.push_back(t);
    for (std::size_t n = 0; n < 3; ++n) {
      add_edge({t[n], t[(n + 1) % 3], {}, EdgeRole::overhang});
      add_edge({t[n], t[(n + 1) % 3], {AdjacentSlopes::straight_up, AdjacentSlopes::straight_up}, EdgeRole::underside});
    }
  }
  /// The edges are the caller's business.
  void add_facet(const Quad& q, bool is_grounded) {
    for (const Corners& t : {Corners{q[0], q[1], q[2]}, Corners{q[0], q[2], q[3]}}) {
      city_.push_back(t);
      if (!is_grounded) overhanging_.push_back(t);
    }
  }
  /// A border of a level slab that lies to the left of the way from a to b.
  void add_border_of_slab(const Point3f& a, const Point3f& b) {
    add_edge({a, b, level_and_down, EdgeRole::overhang});
    add_edge({a, b, level_and_none, EdgeRole::underside});
  }
  void add_edge(const HorizonEdge& e) {
    edges_.push_back(e);
    (e.role == EdgeRole::grounded   ? silhouettes_.grounded
     : e.role == EdgeRole::overhang ? silhouettes_.near.overhangs
                                    : silhouettes_.near.undersides)
        .add(e);
  }

  [[nodiscard]] const CellSilhouettes& silhouettes() const { return silhouettes_; }
  [[nodiscard]] std::vector<HorizonEdge> edges(EdgeRole role) const {
    std::vector<HorizonEdge> result;
    std::copy_if(edges_.begin(), edges_.end(), std::back_inserter(result),
                 [role](const HorizonEdge& e) { return e.role == role; });
    return result;
  }
  [[nodiscard]] std::vector<HorizonEdge> grounded() const { return edges(EdgeRole::grounded); }
  /// What belongs to bodies that can be seen under.
  [[nodiscard]] const std::vector<Corners>& overhanging() const { return overhanging_; }
  [[nodiscard]] Occluder city() const {
    std::vector<Point3f> vertices;
    std::vector<Triangle> triangles;
    for (const Corners& t : city_) {
      const auto first = static_cast<std::uint32_t>(vertices.size());
      vertices.insert(vertices.end(), t.begin(), t.end());
      triangles.push_back({first, first + 1, first + 2});
    }
    return {vertices, triangles};
  }

 private:
  // Counter-clockwise around a roof or a slab: it goes on level to the left; to the right a wall goes down, or nothing is
  static constexpr AdjacentSlopes level_and_down{0, AdjacentSlopes::straight_down},
      level_and_none{0, AdjacentSlopes::straight_up};

  static std::array<Point3f, 8> corners(Point2d low, Point2d size, double low_m, double high_m) {
    std::array<Point3f, 8> result;
    for (std::size_t n = 0; n < 8; ++n) {
      const bool east = n % 4 == 1 || n % 4 == 2, north = n % 4 >= 2;
      result[n] = {static_cast<float>(low.x + (east ? size.x : 0.0)), static_cast<float>(low.y + (north ? size.y : 0.0)),
                   static_cast<float>(n < 4 ? low_m : high_m)};
    }
    return result;
  }

  CellSilhouettes silhouettes_;
  std::vector<HorizonEdge> edges_;
  std::vector<Corners> city_, overhanging_;
};

/// A cell of 20 m without buildings, which receivers stand in, and a town around it.
inline void add_random_boxes(RandomPlaces& random, int count, TownByHand& town) {
  for (int n = 0; n < count;) {
    const Point2d low{random.between(-80.0, 90.0), random.between(-80.0, 90.0)};
    const Point2d size{random.between(4.0, 15.0), random.between(4.0, 15.0)};
    const bool is_off_cell = low.x > 21.0 || low.y > 21.0 || low.x + size.x < -1.0 || low.y + size.y < -1.0;
    if (!is_off_cell) continue;
    town.add_box(low, size, random.between(3.0, 35.0));
    ++n;
  }
}

/// Slabs and beams above the receivers' heads, or nearby.
inline void add_random_overhangs(RandomPlaces& random, int count, TownByHand& town) {
  for (int n = 0; n < count; ++n) {
    const Point2d low{random.between(-20.0, 30.0), random.between(-20.0, 30.0)};
    const Point2d size{random.between(1.0, 9.0), random.between(1.0, 9.0)};
    const double z_m = random.between(7.0, 15.0);
    if (n % 2 == 0)
      town.add_slab(low, size, z_m);
    else
      town.add_beam(low, size, z_m, z_m + random.between(0.2, 2.0));
  }
}

/// Sixteen receivers in a square of 10 m.
[[nodiscard]] inline std::vector<Receiver> receivers_in_a_square(RandomPlaces& random, const Point3f& normal) {
  const Point3f low = {random.between(0.0, 10.0), random.between(0.0, 10.0), random.between(0.5, 6.0)};
  std::vector<Receiver> receivers;
  for (std::size_t n = 0; n < ReceiverPacket::lanes; ++n)
    receivers.push_back({n, {low.x + random.between(0.0, 10.0), low.y + random.between(0.0, 10.0), low.z}, normal});
  return receivers;
}

}  // namespace farlod
