// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/side_edges.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace farlod {
namespace {

using package::TileEdge;

/// Edges that have not been met among the sides of the triangles. Edges and sides may run against each other.
class UnmetEdges {
 public:
  UnmetEdges(std::span<const HorizonEdge> edges, const SharedVertices& vertices)
      : edges_(edges), is_met_(edges.size()), begin_of_vertex_(vertices.vertices().size() + 1) {
    std::vector<std::optional<Entry>> found(edges.size());
    for (std::size_t n = 0; n < edges.size(); ++n) {
      const auto a = vertices.find(edges[n].a), b = vertices.find(edges[n].b);
      if (!a || !b) continue;
      const auto [low, high] = std::minmax(*a, *b);
      found[n] = Entry{static_cast<std::uint32_t>(n), *a, low, high};
      ++begin_of_vertex_[low + 1];
    }
    // Sort them by their lower vertex; those of one vertex keep their order
    std::partial_sum(begin_of_vertex_.begin(), begin_of_vertex_.end(), begin_of_vertex_.begin());
    entries_.resize(begin_of_vertex_.back());
    std::vector<std::uint32_t> next = begin_of_vertex_;
    for (std::size_t n = 0; n < edges.size(); ++n)
      if (found[n]) entries_[next[found[n]->low]++] = *found[n];
  }

  /// The adjacent slopes along the side, if it is an edge; those of the first one, if it is several.
  std::optional<AdjacentSlopes> meet(std::uint32_t from, std::uint32_t to) {
    const auto [low, high] = std::minmax(from, to);
    for (std::uint32_t k = begin_of_vertex_[low]; k < begin_of_vertex_[low + 1]; ++k) {
      const Entry& entry = entries_[k];
      if (entry.high != high || is_met_[entry.edge]) continue;
      is_met_[entry.edge] = true;
      const AdjacentSlopes adjacent = edges_[entry.edge].adjacent;
      return entry.from == from ? adjacent : AdjacentSlopes{adjacent.right, adjacent.left};
    }
    return std::nullopt;
  }

  [[nodiscard]] std::vector<HorizonEdge> rest() const {
    std::vector<HorizonEdge> result;
    for (std::size_t n = 0; n < edges_.size(); ++n)
      if (!is_met_[n]) result.push_back(edges_[n]);
    return result;
  }

 private:
  struct Entry {
    std::uint32_t edge = 0, from = 0;  ///< `from`: the vertex where it begins
    std::uint32_t low = 0, high = 0;   ///< its vertices, the lower number first
  };
  std::span<const HorizonEdge> edges_;
  std::vector<bool> is_met_;
  std::vector<std::uint32_t> begin_of_vertex_;  ///< of the entries whose lower vertex it is
  std::vector<Entry> entries_;
};

}  // namespace

SideEdges side_edges(std::span<const HorizonEdge> edges, std::span<const Triangle> triangles, const SharedVertices& vertices) {
  SideEdges result;
  if (edges.empty()) return result;
  UnmetEdges unmet(edges, vertices);
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
