// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "evaluate/further_quantities.hpp"
#include "evaluate/sky_directions.hpp"
#include "farlod/evaluation.hpp"
#include "horizon/sky_partition.hpp"
#include "horizon/sky_profile.hpp"

namespace farlod {

struct SkySettings {
  Engine engine = Engine::automatic;
  SkyWeight weight = SkyWeight::cosine;
  std::size_t rays = default_rays;
  /// No answer is farther from the true one: where its bounds are wider, the whole city decides. Needs far maps of the kind
  /// `horizon`.
  std::optional<double> allowed_error = std::nullopt;
  DirectionSet directions = DirectionSet::partition;
  std::size_t azimuths = default_azimuths;  ///< of horizons
  /// With Engine::rays, low and high are those of the same rays, of which the far map leaves some open; else of the true value.
  bool bounds_of_same_rays = false;
  Quantities further = {};   ///< what is computed beside the sky view factor
  bool on_surfaces = false;  ///< the city is behind each receiver, also behind one that looks straight up
};

/// What took more than a horizon.
struct RayCounts {
  std::uint64_t by_rays = 0;        ///< receivers that rays answered, or that the whole city decided
  std::uint64_t retraced_rays = 0;  ///< rays and wedges that the whole city decided because of an allowed error
};

/// What an evaluator has done so far.
struct EvaluationStatistics : RayCounts {
  double scenes_s = 0.0, evaluate_s = 0.0;  ///< summed over threads
};

/// Arrays that take the answers, indexed by Receiver::index. `low` and `high` are empty where bounds are not wanted, `further`
/// where nothing is that SkySettings::further asks for; otherwise it has a value for each column of each receiver, receiver by
/// receiver.
struct SkyAnswers {
  std::span<float> svf, low, high, further;
  RayCounts* counts = nullptr;  ///< where rays are counted, too, if not null
  explicit SkyAnswers(std::span<float> s, std::span<float> l = {}, std::span<float> h = {}, std::span<float> f = {})
      : svf(s), low(l), high(h), further(f) {}

  void store(std::size_t index, const SvfInterval& value) const {
    svf[index] = value.estimate;
    if (low.empty()) return;
    low[index] = value.low;
    high[index] = value.high;
  }
};

}  // namespace farlod
