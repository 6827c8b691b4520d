// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "evaluate/sky_evaluator.hpp"

namespace farlod {

/// `answers` and `exact` are of the same length. The 99th percentile is the smallest error that 99 % do not exceed.
[[nodiscard]] ErrorSummary summarize_errors(std::span<const double> answers, std::span<const double> exact);

/// `count` different numbers below `size` (all of them when there are fewer), ascending. The same for the same arguments,
/// on every machine.
[[nodiscard]] std::vector<std::size_t> choose_some(std::size_t size, std::size_t count);

/// Rays of each receiver that --verify computes again: the root mean square of their sampling error is below .001.
inline constexpr std::size_t verify_rays = 20000;

/// How a run is verified.
struct VerifySettings {
  std::size_t receivers = 0;  ///< number of receivers to verify; all when the run has fewer
  bool bounds = false;        ///< whether the run computed bounds
};

/// Errors, and the receivers that they were found at, cell by cell.
struct Verification {
  ErrorSummary errors;
  std::vector<VerifiedReceiver> receivers;
  std::optional<ErrorSummary> svf_total_errors;  ///< of the same receivers, where the run computes it
};

/// What --verify does: chooses random receivers among those of all cells (`counts` are the receivers of each cell), computes them
/// again by the engine `exact` with `verify_rays` rays or more, and compares. The answers of the run are not kept: each cell with
/// a chosen receiver is evaluated again as a whole, as in the run, so that packets and answers are the same.
[[nodiscard]] Verification verify(const SkyEvaluator& evaluator, const VerifySettings& settings,
                                  std::span<const std::size_t> counts, CellsOfRun& cells);

}  // namespace farlod
