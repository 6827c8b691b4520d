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

/// Edges that can be a horizon, in batches that are computed at once, coordinate by coordinate. Cell frame.
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
  /// Turns an edge round if need be: if only one side is a wall, that is to the right of the way from a to b.
  void add(const HorizonEdge& given) {
    const bool turns = given.rises.left == EdgeRises::straight_down && given.rises.right != EdgeRises::straight_down;
    const HorizonEdge e = turns ? HorizonEdge{given.b, given.a, {given.rises.right, given.rises.left}} : given;
    const std::size_t lane = size() % lanes;
    if (lane == 0) batches_.emplace_back();
    Batch& batch = batches_.back();
    batch.ax[lane] = e.a.x;
    batch.ay[lane] = e.a.y;
    batch.az[lane] = e.a.z;
    batch.bx[lane] = e.b.x;
    batch.by[lane] = e.b.y;
    batch.bz[lane] = e.b.z;
    rises_.push_back(e.rises);
  }
  [[nodiscard]] HorizonEdge at(std::size_t n) const {
    const Batch& batch = batches_[n / lanes];
    const std::size_t lane = n % lanes;
    return {{batch.ax[lane], batch.ay[lane], batch.az[lane]}, {batch.bx[lane], batch.by[lane], batch.bz[lane]}, rises_[n]};
  }
  [[nodiscard]] std::span<const Batch> batches() const { return batches_; }
  /// Those that can be a horizon for receivers in a box, from near to far as seen from its middle.
  [[nodiscard]] SkylineEdges facing(const ReceiverBox& box) const;

 private:
  std::vector<Batch> batches_;
  std::vector<EdgeRises> rises_;
};

}  // namespace farlod
