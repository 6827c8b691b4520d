// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "farlod/horizon/horizon_edge.hpp"
#include "farlod/mesh_view.hpp"
#include "farlod/point.hpp"
#include "horizon/cell_skyline.hpp"
#include "occlusion/occluder.hpp"
#include "tests/runtime/horizon/random_places.hpp"

namespace farlod {

/// A town of boxes that stand on the ground and of slabs that hang: as a skyline, and as triangles for a judge.
class TownByHand {
 public:
  /// A box with a flat roof.
  void add_box(Point2d low, Point2d size, double height_m) {
    const std::array<Point3f, 8> c = corners(low, size, 0.0, height_m);
    for (std::size_t n = 0; n < 4; ++n) {
      const std::size_t next = (n + 1) % 4;
      // Counter-clockwise around the roof: it goes on level to the left, and a wall goes down to the right
      standing_.push_back({c[4 + n], c[4 + next], {0, EdgeRises::straight_down}});
      skyline_.standing.add(standing_.back());
      add_quad({c[n], c[next], c[4 + next], c[4 + n]}, city_);
    }
    add_quad({c[4], c[5], c[6], c[7]}, city_);
  }
  /// A level slab without thickness.
  void add_slab(Point2d low, Point2d size, double z_m) {
    const std::array<Point3f, 8> c = corners(low, size, 0.0, z_m);
    add_hanging({c[4], c[5], c[6]});
    add_hanging({c[4], c[6], c[7]});
  }
  void add_hanging(const std::array<Point3f, 3>& t) {
    skyline_.hanging.push_back(t);
    city_.push_back(t);
  }

  [[nodiscard]] const CellSkyline& skyline() const { return skyline_; }
  /// The edges of all boxes.
  [[nodiscard]] const std::vector<HorizonEdge>& standing() const { return standing_; }
  /// The edges of all that hangs.
  [[nodiscard]] std::vector<HorizonEdge> outlines() const {
    std::vector<HorizonEdge> edges;
    for (const auto& t : skyline_.hanging)
      for (std::size_t n = 0; n < 3; ++n) edges.push_back({t[n], t[(n + 1) % 3]});
    return edges;
  }
  [[nodiscard]] Occluder city() const {
    std::vector<Point3f> vertices;
    std::vector<Triangle> triangles;
    for (const auto& t : city_) {
      const auto first = static_cast<std::uint32_t>(vertices.size());
      vertices.insert(vertices.end(), t.begin(), t.end());
      triangles.push_back({first, first + 1, first + 2});
    }
    return {vertices, triangles};
  }

 private:
  using Corners = std::array<Point3f, 3>;
  static std::array<Point3f, 8> corners(Point2d low, Point2d size, double low_m, double high_m) {
    std::array<Point3f, 8> result;
    for (std::size_t n = 0; n < 8; ++n) {
      const bool east = n % 4 == 1 || n % 4 == 2, north = n % 4 >= 2;
      result[n] = {static_cast<float>(low.x + (east ? size.x : 0.0)), static_cast<float>(low.y + (north ? size.y : 0.0)),
                   static_cast<float>(n < 4 ? low_m : high_m)};
    }
    return result;
  }
  static void add_quad(const std::array<Point3f, 4>& q, std::vector<Corners>& to) {
    to.push_back({q[0], q[1], q[2]});
    to.push_back({q[0], q[2], q[3]});
  }

  CellSkyline skyline_;
  std::vector<HorizonEdge> standing_;
  std::vector<Corners> city_;
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

/// Sixteen receivers in a square of 10 m.
[[nodiscard]] inline std::vector<Receiver> receivers_in_a_square(RandomPlaces& random, const Point3f& normal) {
  const Point3f low = {random.between(0.0, 10.0), random.between(0.0, 10.0), random.between(0.5, 6.0)};
  std::vector<Receiver> receivers;
  for (std::size_t n = 0; n < ReceiverPacket::lanes; ++n)
    receivers.push_back({n, {low.x + random.between(0.0, 10.0), low.y + random.between(0.0, 10.0), low.z}, normal});
  return receivers;
}

}  // namespace farlod
