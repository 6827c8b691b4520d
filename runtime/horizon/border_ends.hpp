// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "farlod/point.hpp"
#include "horizon/silhouette_edges.hpp"

namespace farlod {

/// The ends of edges by their numbers, and which of them are at one place. Cell frame.
class BorderEnds {
 public:
  /// Ends 2n and 2n + 1 are those of the edge with the number n. An end leads to another end at its place, and so on around all
  /// that are there, back to itself.
  struct End {
    Point3f p;
    std::uint32_t next = 0;
  };

  BorderEnds() = default;
  /// Together, the lists must have the numbers 0, 1, 2 …, in their order.
  explicit BorderEnds(std::span<const SilhouetteEdges* const> lists);

  [[nodiscard]] const End& end(std::size_t n) const { return ends_[n]; }
  [[nodiscard]] std::size_t size() const { return ends_.size(); }

 private:
  void join_places();

  std::vector<End> ends_;
};

}  // namespace farlod
