// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "evaluate/evaluation_method.hpp"
#include "evaluate/further_quantities.hpp"
#include "evaluate/sky_directions.hpp"
#include "evaluate/traced_profile.hpp"
#include "farlod/evaluation.hpp"
#include "horizon/sky_partition.hpp"
#include "occlusion/occluder.hpp"
#include "package/package_reader.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

class WholeCityOnDemand;
struct CanopyCertainty;
struct HemisphereDirections;
struct SkyParts;
struct PacketAnswer;
struct PlacedScene;

struct SkySettings {
  Engine engine = Engine::automatic;
  SkyWeight weight = SkyWeight::cosine;
  std::size_t rays = default_rays;
  /// Allowed error of the far map: where the interval of an answer is wider, the directions that the far map leaves open are
  /// traced against the whole city. Needs far maps of the kind `horizon`.
  std::optional<double> max_far_error = std::nullopt;
  DirectionSet directions = DirectionSet::partition;
  std::size_t azimuths = default_azimuths;  ///< of horizons
  Quantities further = {};                  ///< what is computed beside the sky view factor
};

/// Upper bound of the sampling error, without the error of the far map, where cells have far maps of this kind: that of the
/// azimuths or that of the rays, whichever is larger among those that answer there (method_of). Whether there is an allowed far
/// error counts, not how large it is.
[[nodiscard]] double sampling_error_of(const SkySettings& settings, FarMapOfCell far_map = FarMapOfCell::horizon);

/// What took more than a horizon.
struct RayCounts {
  std::uint64_t by_rays = 0;        ///< receivers that needed rays
  std::uint64_t retraced_rays = 0;  ///< rays traced against the whole city because the far map did not decide them
};

/// Arrays that take the answers, indexed by Receiver::index. `low` and `high` are empty where bounds are not wanted, `further`
/// where nothing is that SkySettings::further asks for; otherwise it has a value for each column of each receiver, receiver by
/// receiver.
struct SkyAnswers {
  std::span<float> svf, low, high, further;
  RayCounts* counts = nullptr;  ///< where rays are counted, too, if not null
  explicit SkyAnswers(std::span<float> s, std::span<float> l = {}, std::span<float> h = {}, std::span<float> f = {})
      : svf(s), low(l), high(h), further(f) {}
};

/// What an evaluator has done so far.
struct EvaluationStatistics : RayCounts {
  double scenes_s = 0.0, evaluate_s = 0.0;  ///< summed over threads
};

/// Computes sky view factors from a package. Thread-safe. The same receivers give the same answers whatever else is evaluated, up
/// to the rounding of floats (docs/concepts.md, "Culling edges for a packet").
class SkyEvaluator {
 public:
  /// The package must outlive the evaluator. When `stop` is asked for, evaluate() ends with Cancelled within some milliseconds.
  SkyEvaluator(const PackageReader& package, const SkySettings& settings, std::stop_token stop = {});
  /// Of the same package, and stopped by the same token. The two share the scene of the whole city, where they need it.
  SkyEvaluator(const SkyEvaluator& other, const SkySettings& settings);
  ~SkyEvaluator();

  /// Writes the sky view factor of each receiver, in [0, 1], by the method of the cell (method_of). Where `low` and `high` are
  /// wanted, the value for the same azimuths or rays, with jumps of the horizon at the same places, and the true far city lies
  /// between them, up to the rounding of floats
  /// (docs/concepts.md, "Bounds of a sky view factor"); bounds need far maps of the kind `horizon` or the method `whole_city`.
  /// Throws PackageUnusable where `horizons_alone` meets a receiver that may see too much sky below an overhang, or a cell
  /// whose far map is missing.
  void evaluate(const CellReceivers& cell, const SkyAnswers& answers) const;
  void evaluate(const CellReceivers& cell, std::span<float> svf) const { evaluate(cell, SkyAnswers(svf)); }

  /// What the only receiver of a cell sees, direction by direction, by the method of the cell.
  [[nodiscard]] SkyParts parts_of_sky(const CellReceivers& cell, const HemisphereDirections& directions) const;

  [[nodiscard]] EvaluationStatistics statistics() const;
  [[nodiscard]] const PackageReader& package() const { return package_; }
  [[nodiscard]] const SkySettings& settings() const { return settings_; }
  /// The columns of SkyAnswers::further.
  [[nodiscard]] std::size_t further_columns() const { return further_.size(); }

 private:
  using Clock = std::chrono::steady_clock;
  struct CellGeometry;

  SkyEvaluator(const PackageReader& package, const SkySettings& settings, std::stop_token stop,
               std::shared_ptr<WholeCityOnDemand> city);
  [[nodiscard]] EvaluationMethod method_for(Cell cell) const;
  void evaluate_by_method(const CellReceivers& cell, const SkyAnswers& answers) const;
  // One function for each method, or for two that differ little
  void evaluate_by_horizons(const CellReceivers& cell, const SkyAnswers& answers) const;
  void evaluate_by_rays_against_horizons(const CellReceivers& cell, const SkyAnswers& answers) const;
  void evaluate_by_near_scene(const CellReceivers& cell, const SkyAnswers& answers) const;
  void evaluate_by_whole_city(const CellReceivers& cell, const SkyAnswers& answers) const;
  /// What SkySettings::further asks for, of receivers whose svf is answered.
  void trace_further(const CellReceivers& cell, const BlockedRaysOfPacket& blocked, const SkyAnswers& answers) const;
  /// Of receivers whose horizons are answered.
  void find_horizon_distances(const CellReceivers& cell, const SkyAnswers& answers) const;
  /// The sky above the near geometry alone, of each receiver.
  [[nodiscard]] std::vector<float> trace_near_sky(const CellReceivers& cell) const;

  [[nodiscard]] PlacedScene whole_city(Cell cell) const;
  [[nodiscard]] CellGeometry geometry_of(const CellReceivers& cell) const;
  /// Which answers of horizons are stored: the others are known already.
  enum class StoredAnswers : std::uint8_t { all, further };
  void draw_horizons(CellGeometry& geometry, const CellReceivers& cell, const SkyAnswers& answers, StoredAnswers stored) const;
  /// Stores the answers of a packet, of the receivers with these numbers.
  void store_packet(const PacketAnswer& packet, const CellReceivers& cell, std::span<const std::uint32_t> numbers,
                    const SkyAnswers& answers) const;
  /// Answers all receivers of a cell by rays against horizons.
  void count_rays(CellGeometry& geometry, const CellReceivers& cell, const SkyAnswers& answers) const;
  /// For as long as the answers are there.
  [[nodiscard]] CanopyCertainty certainty_of_canopies(Cell cell, const SkyAnswers& answers) const;
  [[nodiscard]] SkyParts parts_without_crowns(const CellReceivers& cell, const HemisphereDirections& directions) const;
  void require_rays_allowed(Cell cell) const;
  void require_far_map(Cell cell) const;
  [[nodiscard]] bool wants_bounds(const SkyAnswers& answers) const {
    return !answers.low.empty() || settings_.max_far_error.has_value() || settings_.further.svf_total_bounds;
  }
  void count(const SkyAnswers& answers, const RayCounts& more) const;
  void add_times(Clock::time_point start, Clock::time_point scene_ready) const;

  const PackageReader& package_;
  SkySettings settings_;
  std::stop_token stop_;
  SkyDirections directions_;
  FurtherQuantities further_;  ///< and the azimuths of all horizons
  std::shared_ptr<WholeCityOnDemand> city_;
  mutable std::atomic<double> scenes_s_ = 0.0, evaluate_s_ = 0.0;
  mutable std::atomic<std::uint64_t> by_rays_ = 0, retraced_rays_ = 0;
};

}  // namespace farlod
