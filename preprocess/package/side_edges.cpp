// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "package/side_edges.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

namespace farlod {
namespace {

using package::TileEdge;

/// Two vertices by number, the lower one first: edges and sides may run against each other.
using Ends = std::pair<std::uint32_t, std::uint32_t>;
Ends ends_of(std::uint32_t from, std::uint32_t to) { return std::minmax({from, to}); }

/// Edges that have not been met among the sides of the triangles.
class UnmetEdges {
 public:
  UnmetEdges(std::span<const HorizonEdge> edges, const SharedVertices& vertices) : edges_(edges), is_met_(edges.size()) {
    for (std::size_t n = 0; n < edges.size(); ++n) {
      const auto a = vertices.find(edges[n].a), b = vertices.find(edges[n].b);
      if (a && b) by_ends_.emplace(ends_of(*a, *b), Entry{n, *a});
    }
  }

  /// The adjacent slopes along the side, if it is an edge; those of the first one, if it is several.
  std::optional<AdjacentSlopes> meet(std::uint32_t from, std::uint32_t to) {
    const auto found = by_ends_.lower_bound(ends_of(from, to));
    if (found == by_ends_.end() || found->first != ends_of(from, to)) return std::nullopt;
    const auto [n, edge_from] = found->second;
    by_ends_.erase(found);
    is_met_[n] = true;
    const AdjacentSlopes adjacent = edges_[n].adjacent;
    return edge_from == from ? adjacent : AdjacentSlopes{adjacent.right, adjacent.left};
  }

  [[nodiscard]] std::vector<HorizonEdge> rest() const {
    std::vector<HorizonEdge> result;
    for (std::size_t n = 0; n < edges_.size(); ++n)
      if (!is_met_[n]) result.push_back(edges_[n]);
    return result;
  }

 private:
  struct Entry {
    std::size_t edge;
    std::uint32_t from;
  };
  std::span<const HorizonEdge> edges_;
  std::vector<bool> is_met_;
  std::multimap<Ends, Entry> by_ends_;
};

}  // namespace

SideEdges side_edges(std::span<const HorizonEdge> edges, std::span<const Triangle> triangles, const SharedVertices& vertices) {
  UnmetEdges unmet(edges, vertices);
  SideEdges result;
  std::size_t skipped = 0;
  for (const Triangle& t : triangles)
    for (const auto& [from, to] : {std::pair(t.a, t.b), std::pair(t.b, t.c), std::pair(t.c, t.a)}) {
      const std::optional<AdjacentSlopes> adjacent = unmet.meet(from, to);
      if (!adjacent) {
        ++skipped;
        continue;
      }
      // What one entry cannot skip, entries without an edge do
      for (; skipped >= TileEdge::skip_only; skipped -= TileEdge::skip_only)
        result.sides.push_back({TileEdge::skip_only, AdjacentSlopes{0, 0}});
      result.sides.push_back({static_cast<std::uint8_t>(skipped), *adjacent});
      skipped = 0;
    }
  result.loose = unmet.rest();
  return result;
}

}  // namespace farlod
