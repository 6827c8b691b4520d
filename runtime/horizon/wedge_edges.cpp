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

std::vector<std::uint32_t> numbers_of(std::span<const SilhouetteEdges* const> lists) {
  std::vector<std::uint32_t> numbers;
  for (const SilhouetteEdges* list : lists)
    for (std::size_t n = 0; n < list->size(); ++n) numbers.push_back(static_cast<std::uint32_t>(list->number(n)));
  return numbers;
}

void EndPlaces::find(std::span<const std::uint32_t> numbers, const BorderEnds& ends) {
  if (stamps_.size() < ends.size()) stamps_.resize(ends.size(), 0);
  ++stamp_;
  batches_.clear();
  add(numbers, ends);
  first_further_ = batches_.size();
}

void EndPlaces::find_further(std::span<const std::uint32_t> numbers, const BorderEnds& ends) {
  batches_.resize(first_further_);
  add(numbers, ends);
}

void EndPlaces::add(std::span<const std::uint32_t> numbers, const BorderEnds& ends) {
  count_ = 0;
  for (const std::size_t number : numbers)
    for (const std::size_t side : {0U, 1U}) {
      const std::uint32_t place = ends.places()[2 * number + side];
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

void find_rising(DrawnLists drawn, const float* minima, std::size_t wedges, DrawnEdges& rising) {
  rising.clear();
  for (const DrawnEdges* list : drawn)
    rising.added(wedge_end_kernels().keep_rising(list->spans(), list->size(), minima, static_cast<std::uint32_t>(wedges),
                                                 rising.room_for(list->size())));
}

void EdgesInWedges::begin(DrawnLists drawn, const float* minima) {
  drawn_.assign(drawn.begin(), drawn.end());
  minima_ = minima;
  for (InWedge& wedge : wedges_) wedge.is_known = false;
}

const EdgesInWedges::InWedge& EdgesInWedges::reaching(std::size_t wedge) {
  InWedge& w = wedges_[wedge];
  if (w.is_known) return w;
  w.is_known = true;
  w.size = 0;
  for (const DrawnEdges* list : drawn_) {
    found_.resize(std::max(found_.size(), w.size + list->size()));
    w.size +=
        wedge_end_kernels().list_reaching(list->spans(), list->size(), static_cast<std::uint32_t>(wedge),
                                          static_cast<std::uint32_t>(wedges_.size()), minima_[wedge], found_.data() + w.size);
  }
  w.edges.resize((w.size + edges_at_once - 1) / edges_at_once);
  for (std::size_t n = 0; n < w.edges.size() * edges_at_once; ++n) {
    const std::size_t number = found_[std::min(n, w.size - 1)];
    w.edges[n / edges_at_once].put(n % edges_at_once, ends_.end(2 * number).p, ends_.end(2 * number + 1).p);
  }
  return w;
}

}  // namespace farlod
