// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/wedge_edges.hpp"

#include <algorithm>

#include "horizon/kernels.hpp"

namespace farlod {
namespace {

constexpr std::size_t edges_at_once = SilhouetteEdges::lanes;
/// No receiver sees a place as deep as this.
constexpr float infinitely_deep_m = -1e30F;

}  // namespace

void EndPlaces::find(EdgeLists edges, const BorderEnds& ends) {
  if (stamps_.size() < ends.size()) stamps_.resize(ends.size(), 0);
  ++stamp_;
  batches_.clear();
  add(edges, ends);
  first_further_ = batches_.size();
}

void EndPlaces::find_further(EdgeLists edges, const BorderEnds& ends) {
  batches_.resize(first_further_);
  add(edges, ends);
}

void EndPlaces::add(EdgeLists edges, const BorderEnds& ends) {
  count_ = 0;
  for (const SilhouetteEdges* list : edges)
    for (std::size_t n = 0; n < list->size(); ++n)
      for (const std::size_t side : {0U, 1U}) {
        const std::uint32_t place = ends.places()[2 * static_cast<std::size_t>(list->number(n)) + side];
        if (stamps_[place] == stamp_) continue;
        stamps_[place] = stamp_;
        add(ends.end(place).p);
      }
}

void EndPlaces::add(const Point3f& p) {
  const std::size_t lane = count_++ % std::size(EndBatch().x);
  if (lane == 0) {
    EndBatch& batch = batches_.emplace_back();
    std::fill(std::begin(batch.x), std::end(batch.x), p.x);
    std::fill(std::begin(batch.y), std::end(batch.y), p.y);
    std::fill(std::begin(batch.z), std::end(batch.z), infinitely_deep_m);
  }
  batches_.back().x[lane] = p.x;
  batches_.back().y[lane] = p.y;
  batches_.back().z[lane] = p.z;
}

void EdgesInWedges::begin(EdgeLists edges, const PacketBounds& bounds, const float* minima) {
  lists_.assign(edges.begin(), edges.end());
  bounds_ = bounds;
  minima_ = minima;
  has_spans_ = false;
  for (InWedge& wedge : wedges_) wedge.is_known = false;
}

RoomForSpans EdgesInWedges::room(std::size_t from) {
  return {number_.data() + from, first_.data() + from, count_.data() + from, max_slope_.data() + from};
}

void EdgesInWedges::find_spans() {
  std::size_t lanes = 0;
  for (const SilhouetteEdges* list : lists_) lanes += list->batches().size() * edges_at_once;
  for (auto* numbers : {&number_, &found_}) numbers->resize(lanes + edges_at_once);
  for (auto* wedges : {&first_, &count_}) wedges->resize(lanes + edges_at_once);
  max_slope_.resize(lanes + edges_at_once);
  std::size_t number = 0;
  span_count_ = 0;
  for (const SilhouetteEdges* list : lists_) {
    span_count_ += wedge_end_kernels().find_spans({list->batches(), list->role()}, static_cast<std::uint32_t>(number), bounds_,
                                                  azimuths_.view(), minima_, room(span_count_));
    number += list->batches().size() * edges_at_once;
  }
  // Those that fill up reach into no wedge
  std::fill_n(count_.begin() + static_cast<std::ptrdiff_t>(span_count_), edges_at_once, 0);
  has_spans_ = true;
}

const EdgesInWedges::InWedge& EdgesInWedges::reaching(std::size_t wedge) {
  InWedge& w = wedges_[wedge];
  if (w.is_known) return w;
  w.is_known = true;
  if (!has_spans_) find_spans();
  w.size = wedge_end_kernels().list_reaching(spans(), span_count_, static_cast<std::uint32_t>(wedge),
                                             static_cast<std::uint32_t>(wedges_.size()), minima_[wedge], found_.data());
  w.edges.resize((w.size + edges_at_once - 1) / edges_at_once);
  for (std::size_t n = 0; n < w.edges.size() * edges_at_once; ++n) copy(found_[std::min(n, w.size - 1)], n, w);
  return w;
}

void EdgesInWedges::mark_reached(std::span<std::uint8_t> wedges) {
  if (!has_spans_) find_spans();
  wedge_end_kernels().mark_reached(spans(), span_count_, minima_, static_cast<std::uint32_t>(wedges.size()), wedges.data());
}

void EdgesInWedges::copy(std::uint32_t number, std::size_t to, InWedge& wedge) const {
  std::size_t batch = number / edges_at_once, list = 0;
  while (batch >= lists_[list]->batches().size()) batch -= lists_[list++]->batches().size();
  const SilhouetteEdges::Batch& from = lists_[list]->batches()[batch];
  const std::size_t lane = number % edges_at_once, at = to % edges_at_once;
  WedgeEdges& edges = wedge.edges[to / edges_at_once];
  edges.ax[at] = from.ax[lane];
  edges.ay[at] = from.ay[lane];
  edges.az[at] = from.az[lane];
  edges.bx[at] = from.bx[lane];
  edges.by[at] = from.by[lane];
  edges.bz[at] = from.bz[lane];
}

}  // namespace farlod
