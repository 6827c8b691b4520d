// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "base/expects.hpp"
#include "tiles/ring_sides.hpp"

namespace farlod::tiles {

BoxTree::BoxTree(const std::vector<Box2d>& boxes) : order_(boxes.size()) {
  if (boxes.empty()) return;
  // Sort into strips from west to east, and each strip from south to north
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  const auto west = [&](std::size_t a, std::size_t b) { return boxes[a].low.x < boxes[b].low.x; };
  const auto south = [&](std::size_t a, std::size_t b) { return boxes[a].low.y < boxes[b].low.y; };
  std::stable_sort(order_.begin(), order_.end(), west);
  const auto strip = fan_out * static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(boxes.size()) / fan_out)));
  for (std::size_t k = 0; k < order_.size(); k += strip) {
    const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(k);
    std::stable_sort(begin, begin + static_cast<std::ptrdiff_t>(std::min(strip, order_.size() - k)), south);
  }
  for (const std::size_t number : order_) {
    if (levels_.empty()) levels_.emplace_back();
    levels_[0].push_back(boxes[number]);
  }
  while (levels_.back().size() > fan_out) {
    const std::vector<Box2d>& below = levels_.back();
    std::vector<Box2d> above((below.size() + fan_out - 1) / fan_out);
    for (std::size_t k = 0; k < below.size(); ++k) {
      above[k / fan_out].add(below[k].low);
      above[k / fan_out].add(below[k].high);
    }
    levels_.push_back(std::move(above));
  }
}

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// The side of an edge on which a place is: 1 to the west of it, -1 to the east, 0 on its line. Exact.
int turn(const RisingEdge& edge, Point2d p) {
  const auto exact = [](Point2d q) { return Kernel::Point_2(q.x, q.y); };
  return static_cast<int>(CGAL::orientation(exact(edge.low), exact(edge.high), exact(p)));
}

/// Where an edge lies with regard to another one, at the lower and the upper end of what they have in common: 1 to the west of
/// it, -1 to the east, 0 on it.
struct Relation {
  int below = 0, above = 0;

  [[nodiscard]] bool is_crossing() const { return below * above < 0; }
  [[nodiscard]] int side() const { return below != 0 ? below : above; }
};

Relation relation_of(const RisingEdge& edge, const RisingEdge& other) {
  Relation relation;
  relation.below = is_lower(edge.low, other.low) ? -turn(edge, other.low) : turn(other, edge.low);
  relation.above = is_lower(other.high, edge.high) ? -turn(edge, other.high) : turn(other, edge.high);
  return relation;
}

}  // namespace

bool is_lower(Point2d a, Point2d b) { return a.y < b.y || (a.y == b.y && a.x < b.x); }

RisingEdge rising(Point2d a, Point2d b) { return is_lower(b, a) ? RisingEdge{b, a} : RisingEdge{a, b}; }

bool edges_cross(const RisingEdge& a, const RisingEdge& b) {
  if (!is_lower(a.low, b.high) || !is_lower(b.low, a.high)) return false;
  return relation_of(a, b).is_crossing();
}

SlabTree::SlabTree(std::span<const RisingEdge> edges, std::vector<Point2d> borders)
    : edges_(edges), borders_(std::move(borders)) {
  std::sort(borders_.begin(), borders_.end(), is_lower);
  borders_.erase(std::unique(borders_.begin(), borders_.end()), borders_.end());
  leaf_count_ = std::bit_ceil(std::max<std::size_t>(borders_.size(), 2));
  nodes_.resize(2 * leaf_count_);
  for (std::uint32_t e = 0; e < edges_.size(); ++e) enter(e);
  order_nodes();
}

/// The row of a place that is a border.
std::size_t SlabTree::border_row(Point2d p) const {
  const auto found = std::lower_bound(borders_.begin(), borders_.end(), p, is_lower);
  FARLOD_EXPECTS(found != borders_.end() && *found == p);
  return static_cast<std::size_t>(found - borders_.begin());
}

void SlabTree::enter(std::uint32_t edge) {
  std::size_t begin = border_row(edges_[edge].low) + leaf_count_, end = border_row(edges_[edge].high) + leaf_count_;
  const auto add = [&](std::size_t node) {
    const auto n = static_cast<std::uint32_t>(node);
    entries_.push_back({n, edge, key_of(n, edges_[edge])});
  };
  for (; begin < end; begin /= 2, end /= 2) {
    if (begin % 2 == 1) add(begin++);
    if (end % 2 == 1) add(--end);
  }
}

double SlabTree::key_of(std::uint32_t node, const RisingEdge& edge) const {
  FARLOD_EXPECTS(node > 0);  // the root is 1
  const auto depth = static_cast<std::size_t>(std::bit_width(node)) - 1;
  const std::size_t width = leaf_count_ >> depth, first = (node - (std::size_t{1} << depth)) * width;
  const Point2d bottom = borders_[first], top = borders_[std::min(first + width, borders_.size() - 1)];
  if (edge.low.y == edge.high.y) return 0.5 * (bottom.x + top.x);
  const double y = 0.5 * (bottom.y + top.y);
  return edge.low.x + (y - edge.low.y) / (edge.high.y - edge.low.y) * (edge.high.x - edge.low.x);
}

/// The keys are rounded, so each order is verified; a node where it is not from west to east is searched edge by edge.
void SlabTree::order_nodes() {
  std::sort(entries_.begin(), entries_.end(),
            [](const Entry& a, const Entry& b) { return std::tuple(a.node, a.key, a.edge) < std::tuple(b.node, b.key, b.edge); });
  for (std::uint32_t k = 0; k < entries_.size(); ++k) {
    Node& node = nodes_[entries_[k].node];
    if (node.begin == node.end) node.begin = k;
    node.end = k + 1;
    if (k == node.begin || !node.is_ordered) continue;
    const Relation relation = relation_of(edge_at(k), edge_at(k - 1));
    node.is_ordered = relation.below <= 0 && relation.above <= 0;
  }
}

std::optional<std::size_t> SlabTree::west_of(const Node& node, Point2d p) const {
  std::uint32_t begin = node.begin, end = node.end;
  if (!node.is_ordered) {
    std::size_t count = 0;
    for (std::uint32_t k = begin; k < end; ++k) {
      const int side = turn(edge_at(k), p);
      if (side == 0) return std::nullopt;
      count += side < 0 ? 1 : 0;
    }
    return count;
  }
  while (begin < end) {
    const std::uint32_t middle = begin + (end - begin) / 2;
    const int side = turn(edge_at(middle), p);
    if (side == 0) return std::nullopt;
    if (side < 0)
      begin = middle + 1;
    else
      end = middle;
  }
  return begin - node.begin;
}

RingSide SlabTree::side_of(Point2d p) const {
  const auto above = std::upper_bound(borders_.begin(), borders_.end(), p, is_lower);
  if (above == borders_.begin()) return RingSide::outside;
  if (*std::prev(above) == p) return RingSide::on_ring;
  if (above == borders_.end()) return RingSide::outside;
  std::size_t west = 0;
  for (std::size_t n = leaf_count_ + static_cast<std::size_t>(above - borders_.begin()) - 1; n > 0; n /= 2) {
    const auto count = west_of(nodes_[n], p);
    if (!count) return RingSide::on_ring;
    west += *count;
  }
  return west % 2 == 1 ? RingSide::inside : RingSide::outside;
}

bool SlabTree::crosses(const Node& node, const RisingEdge& edge) const {
  std::uint32_t begin = node.begin, end = node.end;
  if (!node.is_ordered) {
    while (begin < end && !relation_of(edge, edge_at(begin)).is_crossing()) ++begin;
    return begin < end;
  }
  // An edge between two neighbors that it does not cross lies between all others, too, as far as the slab reaches
  while (begin < end) {
    const std::uint32_t middle = begin + (end - begin) / 2;
    const Relation relation = relation_of(edge, edge_at(middle));
    if (relation.is_crossing()) return true;
    if (relation.side() < 0)
      begin = middle + 1;
    else
      end = middle;
  }
  return false;
}

bool SlabTree::crosses(const RisingEdge& edge) const {
  const std::size_t low = border_row(edge.low), high = border_row(edge.high);
  // A node, the first leaf below it, and their number
  struct Part {
    std::size_t node, first, width;
  };
  std::vector<Part> open{{1, 0, leaf_count_}};
  while (!open.empty()) {
    const Part part = open.back();
    open.pop_back();
    if (part.first >= high || part.first + part.width <= low) continue;
    if (crosses(nodes_[part.node], edge)) return true;
    if (part.width == 1 || (low <= part.first && part.first + part.width <= high)) continue;
    const std::size_t half = part.width / 2;
    open.push_back({2 * part.node, part.first, half});
    open.push_back({2 * part.node + 1, part.first + half, half});
  }
  return false;
}

namespace {

/// So many questions are answered by a look at each edge before trees are made, which cost about as much.
constexpr std::size_t searches_without_tree = 16;
/// Below so many pairs of edges, each pair is looked at.
constexpr std::size_t few_pairs = 4096;

RingSide linear_side(Point2d p, const std::vector<Point2d>& ring) {
  std::vector<Kernel::Point_2> outline;
  outline.reserve(ring.size());
  for (const Point2d& q : ring) outline.emplace_back(q.x, q.y);
  switch (CGAL::bounded_side_2(outline.begin(), outline.end(), Kernel::Point_2(p.x, p.y), Kernel())) {
    case CGAL::ON_BOUNDED_SIDE:
      return RingSide::inside;
    case CGAL::ON_UNBOUNDED_SIDE:
      return RingSide::outside;
    default:
      return RingSide::on_ring;
  }
}

Box2d box_of(const RisingEdge& edge) {
  Box2d box;
  box.add(edge.low);
  box.add(edge.high);
  return box;
}

bool any_cross(const std::vector<RisingEdge>& some, const std::vector<RisingEdge>& others) {
  if (some.size() * others.size() <= few_pairs)
    return std::any_of(some.begin(), some.end(), [&](const RisingEdge& a) {
      return std::any_of(others.begin(), others.end(), [&](const RisingEdge& b) { return edges_cross(a, b); });
    });
  std::vector<Point2d> borders;
  for (const auto* edges : {&some, &others})
    for (const RisingEdge& edge : *edges) borders.insert(borders.end(), {edge.low, edge.high});
  for (const auto& [edges, asked] : {std::pair(&some, &others), std::pair(&others, &some)}) {
    const SlabTree tree(*edges, borders);
    if (std::any_of(asked->begin(), asked->end(), [&](const RisingEdge& edge) { return tree.crosses(edge); })) return true;
  }
  return false;
}

}  // namespace

RingSides::RingSides(std::vector<Point2d> ring) : ring_(std::move(ring)) {
  for (const Point2d& p : ring_) box_.add(p);
  edges_.reserve(ring_.size());
  for (std::size_t k = 0; k < ring_.size(); ++k) edges_.push_back(rising(ring_[k], ring_[(k + 1) % ring_.size()]));
}

RingSide RingSides::side_of(Point2d p) {
  if (!box_.contains(p)) return RingSide::outside;
  if (!slabs_ && linear_searches_ < searches_without_tree) {
    ++linear_searches_;
    work_ += ring_.size();
    return linear_side(p, ring_);
  }
  if (!slabs_) slabs_.emplace(edges_, ring_);
  ++work_;
  return slabs_->side_of(p);
}

RingSide RingSides::side_of(const RingSides& other) {
  const std::vector<Point2d>& corners = other.ring_;
  for (const Point2d& p : corners)
    if (const auto side = side_of(p); side != RingSide::on_ring) return side;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Point2d middle = 0.5 * (corners[k] + corners[(k + 1) % corners.size()]);
    if (const auto side = side_of(middle); side != RingSide::on_ring) return side;
  }
  return RingSide::on_ring;
}

std::vector<RisingEdge> RingSides::edges_meeting(const Box2d& box) {
  std::vector<RisingEdge> found;
  if (edges_.size() <= searches_without_tree) {
    for (const RisingEdge& edge : edges_)
      if (boxes_meet(box_of(edge), box)) found.push_back(edge);
  } else {
    if (!edge_boxes_) {
      std::vector<Box2d> boxes(edges_.size());
      std::transform(edges_.begin(), edges_.end(), boxes.begin(), box_of);
      edge_boxes_.emplace(boxes);
    }
    edge_boxes_->for_each_meeting(box, [&](std::size_t e) { found.push_back(edges_[e]); });
  }
  work_ += found.size();
  return found;
}

bool RingSides::has_on_both_sides(const RingSides& other, const std::vector<RisingEdge>& near) {
  bool is_outside = !box_.contains(other.box_.low) || !box_.contains(other.box_.high), is_inside = false;
  for (const RisingEdge& edge : near)
    for (const Point2d p : {edge.low, edge.high}) {
      const RingSide side = side_of(p);
      is_outside |= side == RingSide::outside;
      is_inside |= side == RingSide::inside;
      if (is_outside && is_inside) return true;
    }
  return false;
}

bool RingSides::crosses(RingSides& other) {
  if (!boxes_meet(box_, other.box_)) return false;
  const std::vector<RisingEdge> own = edges_meeting(other.box_), others = other.edges_meeting(box_);
  return has_on_both_sides(other, others) || other.has_on_both_sides(*this, own) || any_cross(own, others);
}

}  // namespace farlod::tiles
