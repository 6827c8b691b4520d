// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "farlod/point.hpp"
#include "horizon/receiver_packet.hpp"

namespace farlod {

/// Triangles that sky may be seen below, in batches of 16 that are culled at once: an array for each coordinate. Sixteen batches
/// are culled by their boxes first. Cell frame.
class OverhangFacets {
 public:
  static constexpr std::size_t lanes = packet_lanes;
  using Lanes = std::array<float, lanes>;
  using Corners = std::array<Point3f, 3>;
  /// The corners of a lane without a triangle are one point, which hides nothing.
  struct Batch {
    alignas(64) std::array<Lanes, 3> x{}, y{}, z{};
  };
  /// The boxes around the triangles of sixteen batches. Those of lanes without a batch are empty.
  struct Boxes {
    alignas(64) Lanes low_x, low_y, low_z, high_x, high_y, high_z;
    Boxes() {
      for (Lanes* low : {&low_x, &low_y, &low_z}) low->fill(std::numeric_limits<float>::max());
      for (Lanes* high : {&high_x, &high_y, &high_z}) high->fill(std::numeric_limits<float>::lowest());
    }
  };

  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] std::span<const Batch> batches() const { return batches_; }
  [[nodiscard]] std::span<const Boxes> boxes() const { return boxes_; }
  void clear() {
    batches_.clear();
    boxes_.clear();
    count_ = 0;
  }
  void add(const Corners& t) {
    const std::size_t lane = count_ % lanes, batch = count_ / lanes;
    if (lane == 0) batches_.emplace_back();
    if (count_ % (lanes * lanes) == 0) boxes_.emplace_back();
    Batch& to = batches_.back();
    for (std::size_t n = 0; n < 3; ++n) {
      to.x[n][lane] = t[n].x;
      to.y[n][lane] = t[n].y;
      to.z[n][lane] = t[n].z;
      widen(t[n], batch % lanes);
    }
    ++count_;
  }
  [[nodiscard]] Corners at(std::size_t number) const {
    const Batch& batch = batches_[number / lanes];
    const std::size_t lane = number % lanes;
    Corners t;
    for (std::size_t n = 0; n < 3; ++n) t[n] = {batch.x[n][lane], batch.y[n][lane], batch.z[n][lane]};
    return t;
  }

 private:
  void widen(const Point3f& p, std::size_t lane) {
    Boxes& boxes = boxes_.back();
    boxes.low_x[lane] = std::min(boxes.low_x[lane], p.x);
    boxes.low_y[lane] = std::min(boxes.low_y[lane], p.y);
    boxes.low_z[lane] = std::min(boxes.low_z[lane], p.z);
    boxes.high_x[lane] = std::max(boxes.high_x[lane], p.x);
    boxes.high_y[lane] = std::max(boxes.high_y[lane], p.y);
    boxes.high_z[lane] = std::max(boxes.high_z[lane], p.z);
  }

  std::vector<Batch> batches_;
  std::vector<Boxes> boxes_;
  std::size_t count_ = 0;
};

}  // namespace farlod
