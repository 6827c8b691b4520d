// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

#include "farlod/shard.hpp"

namespace farlod {

/// The parts of a work that a shard does, ascending: a run of neighbouring ones, so that all shards cost about the same, as far
/// as parts can be divided. Each part is of exactly one shard. The same on every machine.
[[nodiscard]] inline std::vector<std::size_t> parts_of_shard(std::span<const double> costs, Shard shard) {
  const double all = std::accumulate(costs.begin(), costs.end(), 0.0);
  std::vector<std::size_t> parts;
  double before = 0.0;
  for (std::size_t n = 0; n < costs.size(); ++n) {
    // A part belongs to the shard in whose share its middle lies
    const double middle = all > 0.0 ? (before + 0.5 * costs[n]) / all : 0.0;
    const auto owner = std::min(static_cast<std::size_t>(middle * static_cast<double>(shard.count)), shard.count - 1);
    if (owner == shard.index) parts.push_back(n);
    before += costs[n];
  }
  return parts;
}

}  // namespace farlod
