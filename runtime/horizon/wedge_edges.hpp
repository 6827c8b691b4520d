// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "farlod/point.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/drawn_edges.hpp"
#include "horizon/silhouette_edges.hpp"
#include "horizon/wedge_kernels.hpp"

namespace farlod {

/// The numbers of all edges of some lists.
[[nodiscard]] std::vector<std::uint32_t> numbers_of(std::span<const SilhouetteEdges* const> lists);

/// The places where edges end, each once.
class EndPlaces {
 public:
  /// The ends of the edges with these numbers.
  void find(std::span<const std::uint32_t> numbers, const BorderEnds& ends);
  /// Those of further edges that are at other places.
  void find_further(std::span<const std::uint32_t> numbers, const BorderEnds& ends);
  [[nodiscard]] std::span<const EndBatch> batches() const { return std::span(batches_).first(first_further_); }
  [[nodiscard]] std::span<const EndBatch> further_batches() const { return std::span(batches_).subspan(first_further_); }

 private:
  void add(std::span<const std::uint32_t> numbers, const BorderEnds& ends);
  void add(const Point3f& p);

  std::vector<EndBatch> batches_;
  std::size_t first_further_ = 0, count_ = 0;
  std::vector<std::uint32_t> stamps_;  ///< of places that were added since stamp_ was new
  std::uint32_t stamp_ = 0;
};

/// What was drawn for a packet, list by list.
using DrawnLists = std::span<const DrawnEdges* const>;

/// Those that may rise above the least horizon of some wedge: LowerHorizons::minima.
void find_rising(DrawnLists drawn, const float* minima, std::size_t wedges, DrawnEdges& rising);

/// The edges that may reach into the wedges of a packet. A wedge that nobody asks for costs nothing.
class EdgesInWedges {
 public:
  /// Both must outlive it. `ends` has the numbers of the edges.
  EdgesInWedges(const AzimuthSampling& azimuths, const BorderEnds& ends) : ends_(ends), wedges_(azimuths.size()) {}
  /// Begins a packet with edges that were drawn for it, and the least of its horizons (LowerHorizons::minima). All must live as
  /// long as it is asked.
  void begin(DrawnLists drawn, const float* minima);

  struct InWedge {
    bool is_known = false;
    std::size_t size = 0;           ///< edges
    std::vector<WedgeEdges> edges;  ///< sixteen at once; the last one fills up
  };
  /// Those of a wedge that may rise above the least horizon there.
  [[nodiscard]] const InWedge& reaching(std::size_t wedge);

 private:
  const BorderEnds& ends_;
  const float* minima_ = nullptr;
  std::vector<const DrawnEdges*> drawn_;
  std::vector<InWedge> wedges_;
  std::vector<std::uint32_t> found_;
};

}  // namespace farlod
