// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "farlod/canopy.hpp"
#include "package/crown.hpp"

namespace farlod {

/// Crowns of one run and one frame, in batches of 16 whose reach is computed at once: an array for each coordinate. It is made
/// once for a cell, and serves all of its packets.
class CrownBatches {
 public:
  static constexpr std::size_t lanes = 16;
  struct Batch {
    using Lanes = std::array<float, lanes>;
    alignas(64) Lanes x{}, y{}, bottom{}, top{};
    Lanes half_width{};
    Lanes plan_radius{};  ///< of a circle around the crown's plan
    /// The spheroid that has the upper tangents of the crown: z of its middle, and its height over its width. That of an upright
    /// crown is flat.
    Lanes cap_z{}, cap_ratio{};
    Lanes cosine{}, sine{};  ///< of the turn of a prism
    Lanes transmissivity{};  ///< ψ, from 0 to 1
    Lanes optical_depth{};   ///< −ln ψ by the rule `each`, κ in 1/m by the rule `beer`
    std::array<CrownShape, lanes> shape{};
    std::uint32_t used = 0;  ///< a bit for each lane with a crown
  };

  CrownBatches() = default;
  CrownBatches(std::span<const Crown> crowns, const CanopySettings& settings);
  /// Makes them some crowns of others, which are numbered batch by batch. Rule and transmissivities stay those of all.
  void assign(const CrownBatches& all, std::span<const std::uint32_t> numbers);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] std::span<const Batch> batches() const { return batches_; }
  [[nodiscard]] CanopyRule rule() const { return rule_; }
  /// The smallest ψ and the largest one, between which there is no other: a run knows crowns in leaf and bare ones.
  [[nodiscard]] float least_transmissivity() const { return least_transmissivity_; }
  [[nodiscard]] float most_transmissivity() const { return most_transmissivity_; }

 private:
  void add(const Crown& crown, const CanopySettings& settings);
  /// The batch of the next crown, which is not counted yet.
  Batch& next_batch();

  CanopyRule rule_ = CanopyRule::once;
  std::vector<Batch> batches_;
  std::size_t size_ = 0;
  float least_transmissivity_ = 1.0F, most_transmissivity_ = 0.0F;
};

}  // namespace farlod
