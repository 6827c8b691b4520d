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
#include "horizon/azimuth_ring.hpp"
#include "horizon/sky_partition.hpp"
#include "package/package.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

class RayEngine;
struct SvfInterval;
struct FreeRays;

enum class Engine {
  automatic,  ///< horizons, and rays where too much sky may be seen below something
  horizon,    ///< horizons alone
  rays,       ///< rays, as in the paper (Listing 1); only those that may pass below something are traced
  exact,      ///< rays against all tiles: the reference
  near_only   ///< the far field dropped, as by tools that cut a city into tiles: to measure what it is worth
};

struct SkySettings {
  Engine engine = Engine::automatic;
  SkyWeight weight = SkyWeight::cosine;
  std::size_t rays = 1000;
  /// Where the far map leaves an answer more uncertain than this, the directions that it leaves open are traced against the whole
  /// city. Needs far maps of the kind `horizon`.
  std::optional<double> max_far_error = std::nullopt;
  DirectionSet directions = DirectionSet::partition;
  std::size_t azimuths = 256;  ///< of horizons
};

/// How far the samples of the sky alone may lead astray: of rays, or of azimuths, whichever errs more and may be used.
[[nodiscard]] double sampling_error_of(const SkySettings& settings);

/// Where answers go, by Receiver::index. `low` and `high` are wanted or empty.
struct SkyAnswers {
  std::span<float> svf, low, high;
  explicit SkyAnswers(std::span<float> s, std::span<float> l = {}, std::span<float> h = {}) : svf(s), low(l), high(h) {}
};

/// Computes sky view factors from a package. May be asked from many threads; the same receivers give the same answers whatever
/// else is asked, up to the rounding of floats (docs/concepts.md, "Edges that a packet passes over").
class SkyEvaluator {
 public:
  /// The package must outlive the evaluator.
  SkyEvaluator(const Package& package, const SkySettings& settings);
  ~SkyEvaluator();

  /// Writes the sky view factor of each receiver, in [0, 1]. A cell outside of the grid has no far map: its receivers are traced
  /// against the whole city, whatever the engine. Packages with far maps of the kind `box` know no horizons: `automatic` is
  /// `rays`. Where `low` and `high` are wanted, the truth of the same azimuths or rays lies between them, up to the rounding of
  /// floats (docs/concepts.md, "Bounds of a sky view factor"); only with far maps of the kind `horizon`. Throws PackageUnusable
  /// where the engine `horizon` meets a receiver that may see too much sky below something.
  void evaluate(const CellReceivers& cell, const SkyAnswers& answers) const;
  void evaluate(const CellReceivers& cell, std::span<float> svf) const { evaluate(cell, SkyAnswers(svf)); }

  /// Seconds spent so far, summed over threads; receivers answered by rays rather than by horizons; and rays traced against the
  /// whole city because the far map did not decide them.
  struct Effort {
    double scenes_s = 0.0, evaluate_s = 0.0;
    std::uint64_t by_rays = 0, retraced_rays = 0;
  };
  [[nodiscard]] Effort effort() const;

 private:
  struct WholeCityOnDemand;
  void evaluate_exactly(const CellReceivers& cell, const SkyAnswers& answers) const;
  void evaluate_with_box(const CellReceivers& cell, const SkyAnswers& answers) const;
  void evaluate_with_horizon(const CellReceivers& cell, const SkyAnswers& answers) const;

  struct CellSight;
  using Numbers = std::vector<std::uint32_t>;
  [[nodiscard]] Numbers answer_by_horizons(CellSight& sight, const CellReceivers& cell, const SkyAnswers& answers) const;
  [[nodiscard]] bool is_doubtful(const SvfInterval& share) const;
  /// Called where horizons are not enough: the engine `horizon` ends there.
  void require_rays_allowed(Cell cell) const;
  void answer_by_rays(CellSight& sight, const CellReceivers& cell, const Numbers& numbers, const SkyAnswers& answers) const;
  [[nodiscard]] bool wants_bounds(const SkyAnswers& answers) const {
    return !answers.low.empty() || settings_.max_far_error.has_value();
  }
  void retrace(Cell cell, std::span<const Receiver> receivers, const RayEngine& engine, std::span<FreeRays> free) const;

  const Package& package_;
  SkySettings settings_;
  SkyDirections directions_;
  AzimuthRing ring_;
  std::unique_ptr<WholeCityOnDemand> city_;
  mutable std::atomic<double> scenes_s_ = 0.0, evaluate_s_ = 0.0;
  mutable std::atomic<std::uint64_t> by_rays_ = 0, retraced_rays_ = 0;
};

}  // namespace farlod
