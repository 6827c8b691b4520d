// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "farlod/point.hpp"
#include "package/horizon_edge.hpp"

namespace farlod {

/// A box that holds some receivers, cell frame.
struct ReceiverBox {
  Point3f low, high;
};

/// Edges of one role that can be a silhouette, in batches of 16 that are computed at once: an array for each coordinate. Cell
/// frame.
class SilhouetteEdges {
 public:
  static constexpr std::size_t lanes = 16;
  /// Both ends of a lane without an edge are one point, which no receiver sees.
  struct Batch {
    using Lanes = std::array<float, lanes>;
    alignas(64) Lanes ax{}, ay{}, az{}, bx{}, by{}, bz{};
    Lanes left{}, right{};  ///< slopes of the adjacent facets: AdjacentSlopes::slope
    std::array<std::int32_t, lanes> number{};

    void copy_lane(std::size_t lane, const Batch& from, std::size_t of) {
      for (const auto member :
           {&Batch::ax, &Batch::ay, &Batch::az, &Batch::bx, &Batch::by, &Batch::bz, &Batch::left, &Batch::right})
        (this->*member)[lane] = (from.*member)[of];
      number[lane] = from.number[of];
    }
  };

  explicit SilhouetteEdges(EdgeRole role = EdgeRole::grounded) : role_(role) {}

  [[nodiscard]] EdgeRole role() const { return role_; }
  [[nodiscard]] std::size_t size() const { return adjacent_.size(); }
  [[nodiscard]] bool empty() const { return size() == 0; }
  /// Allocates memory for so many.
  void reserve(std::size_t count) {
    batches_.reserve((count + lanes - 1) / lanes);
    adjacent_.reserve(count);
  }
  /// Swaps the ends if only the facet to the left of the way from a to b is a wall: then it is to the right. Of an edge right
  /// above a receiver, the left side hides the sky. The edge must have the role of all.
  void add(const HorizonEdge& e) {
    // Without a branch. NOLINTNEXTLINE(readability-implicit-bool-conversion)
    const bool swaps = (e.adjacent.left == AdjacentSlopes::straight_down) & (e.adjacent.right != AdjacentSlopes::straight_down);
    const std::size_t lane = size() % lanes;
    if (lane == 0) batches_.emplace_back();
    // Swap by indexing: a branch would be mispredicted for every other edge
    const std::size_t a = swaps ? 1 : 0, b = 1 - a;
    const std::array x{e.a.x, e.b.x}, y{e.a.y, e.b.y}, z{e.a.z, e.b.z};
    const std::array sides{e.adjacent.left, e.adjacent.right};
    batches_.back().number[lane] = static_cast<std::int32_t>(size());
    put(lane, {{x[a], y[a], z[a]}, {x[b], y[b], z[b]}, {sides[a], sides[b]}, role_}, batches_.back());
    adjacent_.push_back({sides[a], sides[b]});
  }
  [[nodiscard]] HorizonEdge at(std::size_t n) const {
    const Batch& batch = batches_[n / lanes];
    const std::size_t lane = n % lanes;
    return {
        {batch.ax[lane], batch.ay[lane], batch.az[lane]}, {batch.bx[lane], batch.by[lane], batch.bz[lane]}, adjacent_[n], role_};
  }
  /// Each edge has a number: its place in the list that add() or facing() made, unless number_from() said another. Those that
  /// assign() chooses keep theirs.
  [[nodiscard]] std::int32_t number(std::size_t n) const { return batches_[n / lanes].number[n % lanes]; }
  void number_from(std::int32_t first) {
    for (std::size_t n = 0; n < size(); ++n) batches_[n / lanes].number[n % lanes] = first + static_cast<std::int32_t>(n);
  }
  [[nodiscard]] std::span<const Batch> batches() const { return batches_; }
  /// The edges that can be a silhouette for some receiver in a box, from near to far in the plan from its centre, in steps of 3
  /// %.
  [[nodiscard]] SilhouetteEdges facing(const ReceiverBox& box) const;
  /// Makes it those of `edges` whose bits are set, in their order: a bit for each lane of each batch.
  void assign(const SilhouetteEdges& edges, std::span<const std::uint16_t> chosen);

 private:
  static void put(std::size_t lane, const HorizonEdge& e, Batch& batch) {
    batch.ax[lane] = e.a.x;
    batch.ay[lane] = e.a.y;
    batch.az[lane] = e.a.z;
    batch.bx[lane] = e.b.x;
    batch.by[lane] = e.b.y;
    batch.bz[lane] = e.b.z;
    batch.left[lane] = static_cast<float>(AdjacentSlopes::slope(e.adjacent.left));
    batch.right[lane] = static_cast<float>(AdjacentSlopes::slope(e.adjacent.right));
  }

  EdgeRole role_;
  std::vector<Batch> batches_;
  std::vector<AdjacentSlopes> adjacent_;
};

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
  [[nodiscard]] std::span<const End> all() const { return ends_; }
  /// For each end the least number of an end at its place.
  [[nodiscard]] std::span<const std::uint32_t> places() const { return places_; }

 private:
  void join_places();

  std::vector<End> ends_;
  std::vector<std::uint32_t> places_;
};

}  // namespace farlod
