// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>

#include <algorithm>
#include <span>
#include <utility>

#include "tiles/ring_sides.hpp"

namespace farlod::tiles {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

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
