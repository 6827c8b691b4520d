// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "evaluate/sky_directions.hpp"
#include "farlod/sky/sky_partition.hpp"
#include "package/package.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

class HorizonPackets;
struct FreeRays;

enum class Engine {
  rays,      ///< rays against the tiles of the neighbourhood, then the far map (paper, Listing 1)
  exact,     ///< rays against all tiles: the reference
  near_only  ///< the far field dropped, as by tools that cut a city into tiles: to measure what it is worth
};

struct SkySettings {
  Engine engine = Engine::rays;
  SkyWeight weight = SkyWeight::cosine;
  std::size_t rays = 1000;
  /// Where the far map leaves an answer more uncertain than this, the directions that it leaves open are traced against the whole
  /// city. Needs far maps of the kind `horizon`.
  std::optional<double> max_far_error = std::nullopt;
};

/// Where answers go, by Receiver::index. `low` and `high` are wanted or empty.
struct SkyAnswers {
  std::span<float> svf, low, high;
  explicit SkyAnswers(std::span<float> s, std::span<float> l = {}, std::span<float> h = {}) : svf(s), low(l), high(h) {}
};

/// Computes sky view factors from a package. May be asked from many threads; the same receivers give the same answers
/// whatever else is asked.
class SkyEvaluator {
 public:
  /// The package must outlive the evaluator.
  SkyEvaluator(const Package& package, const SkySettings& settings);
  ~SkyEvaluator();

  /// Writes the sky view factor of each receiver, in [0, 1]. A cell outside of the grid has no far map: its receivers are traced
  /// against the whole city, whatever the engine.
  /// Where `low` and `high` are wanted, the engine `exact` with the same number of rays lies between them, up to the rounding of
  /// floats (docs/concepts.md, "Bounds"); the engine `rays` gives them only with far maps of the kind `horizon`.
  void evaluate(const CellReceivers& cell, const SkyAnswers& answers) const;
  void evaluate(const CellReceivers& cell, std::span<float> svf) const { evaluate(cell, SkyAnswers(svf)); }

  /// Seconds spent so far, summed over threads, and rays traced against the whole city because the far map did not settle them.
  struct Effort {
    double scenes_s = 0.0, rays_s = 0.0;
    std::uint64_t settled_rays = 0;
  };
  [[nodiscard]] Effort effort() const;

 private:
  struct WholeCityOnDemand;
  void evaluate_exactly(const CellReceivers& cell, const SkyAnswers& answers) const;
  void evaluate_with_box(const CellReceivers& cell, const SkyAnswers& answers) const;
  void evaluate_with_horizon(const CellReceivers& cell, const SkyAnswers& answers) const;

  void settle(Cell cell, std::span<const Receiver> receivers, HorizonPackets& packets, std::vector<FreeRays>& free) const;

  const Package& package_;
  SkySettings settings_;
  SkyDirections directions_;
  std::unique_ptr<WholeCityOnDemand> city_;
  mutable std::atomic<double> scenes_s_ = 0.0, rays_s_ = 0.0;
  mutable std::atomic<std::uint64_t> settled_rays_ = 0;
};

}  // namespace farlod
