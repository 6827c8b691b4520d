// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "benchmark/city_receivers.hpp"
#include "evaluate/sky_evaluator.hpp"
#include "package/package_reader.hpp"

namespace farlod::benchmark {

/// One of our engines, and the accuracies that it is tried at.
struct OurEngine {
  std::string name;
  Engine engine = Engine::rays;
  std::string sample_name;  ///< what the accuracy counts
  std::vector<std::size_t> ladder;
  /// Answers of neighbors may share work: errors are then those of the whole set, not of a few receivers asked alone.
  bool shares_work = false;

  [[nodiscard]] SkySettings settings(std::size_t samples) const;
};
/// By the name that farlod-svf knows it by; throws std::runtime_error for another.
[[nodiscard]] OurEngine engine_named(const std::string& name);

/// Evaluates the receivers as farlod-svf does, on all cores: reads far maps, builds near scenes.
void evaluate(const PackageReader& package, const SkySettings& settings, const CityReceivers& receivers, std::span<float> svf);

/// The truth: so many rays against all tiles.
[[nodiscard]] std::vector<float> exact_answers(const PackageReader& package, const CityReceivers& receivers, std::size_t rays);

}  // namespace farlod::benchmark
