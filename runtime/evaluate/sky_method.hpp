// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "canopy/canopy_field.hpp"
#include "evaluate/further_quantities.hpp"
#include "evaluate/sky_answers.hpp"
#include "evaluate/sky_directions.hpp"
#include "evaluate/sky_parts.hpp"
#include "evaluate/view_factors.hpp"
#include "horizon/pixel_horizon.hpp"
#include "package/horizon_edge.hpp"
#include "package/package_reader.hpp"
#include "receivers/receiver.hpp"
#include "scene/ray_scenes.hpp"

namespace farlod {

/// Counts what all threads do.
class EvaluationCounter {
 public:
  using Clock = std::chrono::steady_clock;

  /// Also among the answers, where they are counted.
  void add(const RayCounts& counts, const SkyAnswers& answers);
  /// The time from `start` to `scene_ready`, and from there to now.
  void add_times(Clock::time_point start, Clock::time_point scene_ready);
  [[nodiscard]] EvaluationStatistics statistics() const { return {{by_rays_, retraced_rays_}, scenes_s_, evaluate_s_}; }

 private:
  std::atomic<double> scenes_s_ = 0.0, evaluate_s_ = 0.0;
  std::atomic<std::uint64_t> by_rays_ = 0, retraced_rays_ = 0;
};

/// What is asked of all cells, and what they share.
struct Evaluation {
  using City = std::shared_ptr<const WholeCityOnDemand>;
  Evaluation(const PackageReader& p, const SkySettings& s, std::stop_token t, City c,
             std::shared_ptr<const LightOfPeriod> light = nullptr);

  const PackageReader& package;
  SkySettings settings;
  std::stop_token stop;
  SkyDirections directions;
  FurtherQuantities further;  ///< and the azimuths of all horizons
  City city;
  /// The pixels that the city is, where horizons may be found by marching over them: all that is asked for has no bounds, and
  /// nothing lies beyond the raster. Null elsewhere. Thread-safe.
  [[nodiscard]] const PixelCity* pixels(const SkyAnswers& answers) const;
  /// Whether the city is a rough surface, and all of its pixels have a height. Thread-safe.
  [[nodiscard]] bool is_unbroken_relief() const;
  /// The pixels that all crowns are, where the sky behind them may be found by marching over them from some of these receivers of
  /// a cell: all that is asked for has no bounds, and crowns count by the rule `once`. Null elsewhere. Thread-safe.
  [[nodiscard]] const CanopyCity* canopy_pixels(const CellReceivers& cell, const SkyAnswers& answers) const;
  /// What is seen from a cell by rays. Thread-safe.
  [[nodiscard]] SeenScene seen_from(Cell cell) const;
  /// The edges of the far terrain in its own frame: outside of the grid there are no far maps, which have them elsewhere.
  /// Thread-safe.
  [[nodiscard]] std::span<const HorizonEdge> far_terrain_edges() const;
  std::unique_ptr<EvaluationCounter> counter = std::make_unique<EvaluationCounter>();

  /// Whether bounds of the true values are asked for.
  [[nodiscard]] bool wants_bounds(const SkyAnswers& answers) const {
    return !settings.bounds_of_same_rays &&
           (!answers.low.empty() || settings.allowed_error.has_value() || settings.further.svf_total_bounds);
  }

 private:
  struct PixelsOnDemand {
    std::once_flag once;
    std::optional<PixelCity> city;
  };
  struct CanopyOnDemand {
    std::once_flag once;
    std::optional<CanopyCity> city;
  };
  struct FarTerrainOnDemand {
    std::once_flag once;
    std::vector<HorizonEdge> edges;
  };
  void make_canopy_city() const;
  std::unique_ptr<PixelsOnDemand> pixels_ = std::make_unique<PixelsOnDemand>();
  std::optional<CanopyLattice> canopy_lattice_;  ///< where rays may march
  std::unique_ptr<CanopyOnDemand> canopy_ = std::make_unique<CanopyOnDemand>();
  std::unique_ptr<FarTerrainOnDemand> far_terrain_ = std::make_unique<FarTerrainOnDemand>();
};

/// A way to answer the receivers of a cell. Thread-safe.
class SkyMethod {
 public:
  virtual ~SkyMethod() = default;
  /// Writes what SkyEvaluator::evaluate promises, but for the distances of horizons.
  virtual void evaluate(const CellReceivers& cell, const SkyAnswers& answers) const = 0;
  /// What the only receiver of a cell sees, direction by direction, but for crowns. `near` is the near scene of the cell.
  [[nodiscard]] virtual SkyParts parts(const CellReceivers& cell, const HemisphereDirections& directions,
                                       const Occluder& near) const = 0;
};

// The evaluation must outlive the methods. Which one answers a cell says method_of (evaluate/sky_evaluator.hpp)
/// Horizons, and facets in the gaps below overhangs.
[[nodiscard]] std::unique_ptr<const SkyMethod> horizon_method(const Evaluation& evaluation);
/// Horizons of receivers above the pixels of a rough surface, where these tell all that is asked for; `others` answers the rest.
[[nodiscard]] std::unique_ptr<const SkyMethod> pixel_method(const Evaluation& evaluation,
                                                            std::unique_ptr<const SkyMethod> others);
/// Rays against horizons.
[[nodiscard]] std::unique_ptr<const SkyMethod> ray_method(const Evaluation& evaluation);
/// Rays against the near tiles, and a look-up in the box far map where it is asked for.
[[nodiscard]] std::unique_ptr<const SkyMethod> near_scene_method(const Evaluation& evaluation, bool has_box);
/// Rays against all tiles.
[[nodiscard]] std::unique_ptr<const SkyMethod> whole_city_method(const Evaluation& evaluation);

}  // namespace farlod
