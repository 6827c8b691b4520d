// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <span>

#include "evaluate/sky_directions.hpp"
#include "farlod/sky/sky_partition.hpp"
#include "package/package.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

enum class Engine {
  rays,      ///< rays against the tiles of the neighbourhood, then the far map (paper, Listing 1)
  exact,     ///< rays against all tiles: the reference
  near_only  ///< the far field dropped, as by tools that cut a city into tiles: to measure what it is worth
};

struct SkySettings {
  Engine engine = Engine::rays;
  SkyWeight weight = SkyWeight::cosine;
  std::size_t rays = 1000;
};

/// Computes sky view factors from a package. May be asked from many threads; the same receivers give the same answers
/// whatever else is asked.
class SkyEvaluator {
 public:
  /// The package must outlive the evaluator.
  SkyEvaluator(const Package& package, const SkySettings& settings);
  ~SkyEvaluator();

  /// Writes the sky view factor of each receiver, in [0, 1], to `svf[receiver.index]`. A cell outside of the grid has no far map:
  /// its receivers are traced against the whole city, whatever the engine.
  void evaluate(const CellReceivers& cell, std::span<float> svf) const;

  /// Seconds spent so far, summed over threads.
  struct Effort {
    double scenes_s = 0.0, rays_s = 0.0;
  };
  [[nodiscard]] Effort effort() const;

 private:
  struct WholeCityOnDemand;
  const Package& package_;
  SkySettings settings_;
  SkyDirections directions_;
  std::unique_ptr<WholeCityOnDemand> city_;
  mutable std::atomic<double> scenes_s_ = 0.0, rays_s_ = 0.0;
};

}  // namespace farlod
