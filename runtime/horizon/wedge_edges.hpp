// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "farlod/point.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/silhouette_edges.hpp"
#include "horizon/wedge_kernels.hpp"

namespace farlod {

using EdgeLists = std::span<const SilhouetteEdges* const>;

/// The places where edges end, each once.
class EndPlaces {
 public:
  /// The ends of the edges, as their numbers find them.
  void find(EdgeLists edges, const BorderEnds& ends);
  /// Those of further edges that are at other places.
  void find_further(EdgeLists edges, const BorderEnds& ends);
  [[nodiscard]] std::span<const EndBatch> batches() const { return std::span(batches_).first(first_further_); }
  [[nodiscard]] std::span<const EndBatch> further_batches() const { return std::span(batches_).subspan(first_further_); }

 private:
  void add(EdgeLists edges, const BorderEnds& ends);
  void add(const Point3f& p);

  std::vector<EndBatch> batches_;
  std::size_t first_further_ = 0, count_ = 0;
  std::vector<std::uint32_t> stamps_;  ///< of places that were added since stamp_ was new
  std::uint32_t stamp_ = 0;
};

/// The edges that may reach into the wedges of a packet. A wedge that nobody asks for costs nothing.
class EdgesInWedges {
 public:
  /// The azimuths must outlive it.
  explicit EdgesInWedges(const AzimuthSampling& azimuths) : azimuths_(azimuths), wedges_(azimuths.size()) {}
  /// Begins a packet with these bounds and the least of its horizons: LowerHorizons::minima. All must live as long as it is
  /// asked.
  void begin(EdgeLists edges, const PacketBounds& bounds, const float* minima);

  struct InWedge {
    bool is_known = false;
    std::size_t size = 0;           ///< edges
    std::vector<WedgeEdges> edges;  ///< sixteen at once; the last one fills up
  };
  /// Those of a wedge that may rise above the least horizon there.
  [[nodiscard]] const InWedge& reaching(std::size_t wedge);
  /// Marks the wedges into which some edge may rise above the least horizon.
  void mark_reached(std::span<std::uint8_t> wedges);

 private:
  void find_spans();
  [[nodiscard]] EdgeSpans spans() const { return {number_.data(), first_.data(), count_.data(), max_slope_.data()}; }
  [[nodiscard]] RoomForSpans room(std::size_t from);
  void copy(std::uint32_t number, std::size_t to, InWedge& wedge) const;

  const AzimuthSampling& azimuths_;
  std::vector<const SilhouetteEdges*> lists_;
  PacketBounds bounds_;
  const float* minima_ = nullptr;
  bool has_spans_ = false;
  std::size_t span_count_ = 0;
  std::vector<InWedge> wedges_;
  std::vector<std::uint32_t> number_, found_;
  std::vector<std::int32_t> first_, count_;
  std::vector<float> max_slope_;
};

}  // namespace farlod
