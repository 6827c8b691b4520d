// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "run/zone_plan.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

namespace farlod {
namespace {

double x_at(const ZoneEdge& edge, double y) {
  return edge.low.x + (y - edge.low.y) / (edge.high.y - edge.low.y) * (edge.high.x - edge.low.x);
}

/// The upright plane through a side; it looks east.
HalfSpace east_of(const ZoneEdge& edge) {
  return {{edge.low.x, edge.low.y, 0.0}, {edge.high.y - edge.low.y, edge.low.x - edge.high.x, 0.0}};
}

/// All sides but those of constant y, which no line of constant y crosses.
std::vector<ZoneEdge> edges_of(const std::vector<std::vector<Point2d>>& rings) {
  std::vector<ZoneEdge> edges;
  for (const std::vector<Point2d>& ring : rings)
    for (std::size_t n = 0; n < ring.size(); ++n) {
      ZoneEdge edge{ring[n], ring[(n + 1) % ring.size()]};
      if (edge.low.y > edge.high.y) std::swap(edge.low, edge.high);
      if (edge.low.y < edge.high.y) edges.push_back(edge);
    }
  return edges;
}

/// The y of all corners, each once, ascending.
std::vector<double> levels_of(const std::vector<ZoneEdge>& edges) {
  std::vector<double> levels;
  for (const ZoneEdge& edge : edges) levels.insert(levels.end(), {edge.low.y, edge.high.y});
  std::ranges::sort(levels);
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  return levels;
}

}  // namespace

Box2d ZoneTrapezoid::outline() const {
  Box2d box;
  for (const double y : {y_low, y_high})
    for (const ZoneEdge& edge : {west, east}) box.add({x_at(edge, y), y});
  return box;
}

double ZoneTrapezoid::area_m2() const {
  const double y = 0.5 * (y_low + y_high);
  return (y_high - y_low) * (x_at(east, y) - x_at(west, y));
}

ZoneTrapezoid ZoneTrapezoid::moved_to(Point2d corner) const {
  const auto moved = [&](const ZoneEdge& edge) { return ZoneEdge{edge.low - corner, edge.high - corner}; };
  return {y_low - corner.y, y_high - corner.y, moved(west), moved(east)};
}

bool ZoneTrapezoid::contains(Point2d p) const {
  return y_low <= p.y && p.y < y_high && x_at(west, p.y) <= p.x && p.x < x_at(east, p.y);
}

std::array<double, 2> ZoneTrapezoid::span_at(double y) const {
  if (y < y_low || y >= y_high) return {0.0, 0.0};
  return {x_at(west, y), x_at(east, y)};
}

ConvexPiece ZoneTrapezoid::part_of(const ConvexPiece& piece) const {
  ConvexPiece part = part_in(piece, {{0.0, y_low, 0.0}, {0.0, 1.0, 0.0}});
  part = part_in(part, {{0.0, y_high, 0.0}, {0.0, -1.0, 0.0}});
  part = part_in(part, east_of(west));
  return part_in(part, east_of(east).opposite());
}

std::vector<ZoneTrapezoid> trapezoids_of(const std::vector<std::vector<Point2d>>& rings) {
  const std::vector<ZoneEdge> edges = edges_of(rings);
  const std::vector<double> levels = levels_of(edges);
  std::vector<ZoneTrapezoid> trapezoids;
  for (std::size_t n = 1; n < levels.size(); ++n) {
    const double low = levels[n - 1], high = levels[n], middle = 0.5 * (low + high);
    std::vector<ZoneEdge> crossed;
    std::ranges::copy_if(edges, std::back_inserter(crossed),
                         [&](const ZoneEdge& e) { return e.low.y <= low && high <= e.high.y; });
    std::ranges::stable_sort(crossed, {}, [&](const ZoneEdge& e) { return x_at(e, middle); });
    for (std::size_t k = 1; k < crossed.size(); k += 2) trapezoids.push_back({low, high, crossed[k - 1], crossed[k]});
  }
  return trapezoids;
}

std::vector<ConvexPiece> parts_within(const ConvexPiece& piece, const std::vector<ZoneTrapezoid>& trapezoids) {
  std::vector<ConvexPiece> parts;
  for (const ZoneTrapezoid& trapezoid : trapezoids)
    if (ConvexPiece part = trapezoid.part_of(piece); !part.empty()) parts.push_back(std::move(part));
  return parts;
}

}  // namespace farlod
