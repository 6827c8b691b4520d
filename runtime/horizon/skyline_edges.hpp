// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "farlod/horizon/horizon_edge.hpp"

namespace farlod {

/// A box that holds some receivers, cell frame.
struct ReceiverBox {
  Point3f low, high;
};

/// Edges that can be a silhouette, in batches that are computed at once, coordinate by coordinate. Cell frame.
class SkylineEdges {
 public:
  static constexpr std::size_t lanes = 16;
  /// Lanes without an edge hold nothing that is seen: both ends are one point.
  struct Batch {
    using Lanes = std::array<float, lanes>;
    alignas(64) Lanes ax{}, ay{}, az{}, bx{}, by{}, bz{};
  };

  [[nodiscard]] std::size_t size() const { return rises_.size(); }
  [[nodiscard]] bool empty() const { return size() == 0; }
  /// Makes room for so many.
  void reserve(std::size_t count) {
    batches_.reserve((count + lanes - 1) / lanes);
    rises_.reserve(count);
  }
  /// Turns an edge round if need be: if only one side is a wall, that is to the right of the way from a to b.
  void add(const HorizonEdge& e) {
    const bool turns = (e.rises.left == EdgeRises::straight_down) & (e.rises.right != EdgeRises::straight_down);
    const std::size_t lane = size() % lanes;
    if (lane == 0) batches_.emplace_back();
    // Both ends by their number: a branch would be guessed wrong for every other edge
    const std::size_t a = turns ? 1 : 0, b = 1 - a;
    const std::array x{e.a.x, e.b.x}, y{e.a.y, e.b.y}, z{e.a.z, e.b.z};
    put(lane, {x[a], y[a], z[a]}, {x[b], y[b], z[b]}, batches_.back());
    const std::array sides{e.rises.left, e.rises.right};
    rises_.push_back({sides[a], sides[b]});
  }
  [[nodiscard]] HorizonEdge at(std::size_t n) const {
    const Batch& batch = batches_[n / lanes];
    const std::size_t lane = n % lanes;
    return {{batch.ax[lane], batch.ay[lane], batch.az[lane]}, {batch.bx[lane], batch.by[lane], batch.bz[lane]}, rises_[n]};
  }
  [[nodiscard]] std::span<const Batch> batches() const { return batches_; }
  /// Those that can be a silhouette for receivers in a box, from near to far as seen from its middle, in steps of 3 %. All edges
  /// must have this role.
  [[nodiscard]] SkylineEdges facing(const ReceiverBox& box, EdgeRole role) const;

 private:
  static void put(std::size_t lane, const Point3f& a, const Point3f& b, Batch& batch) {
    batch.ax[lane] = a.x;
    batch.ay[lane] = a.y;
    batch.az[lane] = a.z;
    batch.bx[lane] = b.x;
    batch.by[lane] = b.y;
    batch.bz[lane] = b.z;
  }

  std::vector<Batch> batches_;
  std::vector<EdgeRises> rises_;
};

}  // namespace farlod
