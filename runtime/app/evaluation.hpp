// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "app/svf_options.hpp"
#include "evaluate/sky_evaluator.hpp"
#include "evaluate/verification.hpp"
#include "package/package.hpp"

namespace farlod {

/// Rays of each receiver that `--verify` computes anew: enough that the discretisation of the reference does not count
/// (root mean square error below .001).
inline constexpr std::size_t verify_rays = 20000;

/// Seconds of wall clock by part of the work.
struct RunSeconds {
  double open = 0.0, scenes = 0.0, evaluate = 0.0, write = 0.0;
};

/// Answers of some receivers, by their numbers: NaN where there is none. `low` and `high` are empty unless the user wants bounds.
struct AnswerTable {
  static constexpr float nothing = std::numeric_limits<float>::quiet_NaN();
  std::vector<float> svf, low, high;
  AnswerTable(std::size_t size, bool bounds) : svf(size, nothing), low(bounds ? size : 0, nothing), high(low) {}
  /// An answer for a table; none for NaN, and none where bounds are not wanted.
  [[nodiscard]] static std::optional<double> value(const std::vector<float>& answers, std::size_t n) {
    return answers.empty() || std::isnan(answers[n]) ? std::nullopt : std::optional<double>(answers[n]);
  }
};

/// Gives the receivers of the n-th cell of a run; the same whenever it is asked, on any thread.
using ReceiversOfCell = std::function<CellReceivers(std::size_t n)>;
/// Takes what the n-th cell's receivers see: answers stand in the order of the receivers. Cells come in their order, one at a
/// time.
using TakeAnswers = std::function<void(std::size_t n, const CellReceivers& cell, const AnswerTable& answers)>;

/// How wide the certain intervals are.
struct BoundsWidth {
  double mean = 0.0, max = 0.0;
};

/// What a run came to, for people and for `--summary`.
struct SvfRun {
  std::size_t receivers = 0;         ///< with an answer
  std::size_t inside_buildings = 0;  ///< without one
  std::size_t beyond_grid = 0;       ///< pixels of a raster that no cell holds: without an answer too
  std::size_t outside_of_grid = 0;   ///< of the receivers, those that were traced against the whole city
  RunSeconds seconds;
  std::optional<double> svf_min, svf_mean, svf_max;
  std::optional<BoundsWidth> bounds;
  std::uint64_t by_rays = 0;        ///< receivers that the engine `auto` answered by rays, since horizons were not enough
  std::uint64_t retraced_rays = 0;  ///< traced against the whole city because the far map was not enough (--max-error)
  std::optional<ErrorSummary> errors;
  std::vector<std::filesystem::path> files;
};

/// Evaluates the receivers of all cells on all cores, few cells at a time, and forgets them when their answers are taken. Then,
/// when the user asked for it, verifies some of them. Adds to the run's times and figures; who has no answer, and why, is the
/// caller's to count.
void evaluate_cells(const Package& package, const SvfOptions& options, std::size_t cell_count,
                    const ReceiversOfCell& receivers_of, const TakeAnswers& take, SvfRun& run);

/// Evaluates what a run wants to know, and lets it write its files. `Run` has cell_count(), receivers_of(n), take(n, receivers,
/// answers) and finish(SvfRun&).
template <class Run>
[[nodiscard]] SvfRun evaluate_and_finish(const Package& package, const SvfOptions& options, Run& run) {
  SvfRun result;
  evaluate_cells(
      package, options, run.cell_count(), [&run](std::size_t n) { return run.receivers_of(n); },
      [&run](std::size_t n, const CellReceivers& cell, const AnswerTable& answers) { run.take(n, cell, answers); }, result);
  const auto start = std::chrono::steady_clock::now();
  run.finish(result);
  result.seconds.write += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

/// The three kinds of run. Each shares out the memory, evaluates, writes its files and returns what it came to.
[[nodiscard]] SvfRun run_raster(Package& package, const SvfOptions& options);
[[nodiscard]] SvfRun run_points(Package& package, const SvfOptions& options);
[[nodiscard]] SvfRun run_surfaces(Package& package, const SvfOptions& options);

/// "svf" or "svf_solid": never one ambiguous name.
[[nodiscard]] std::string quantity_name(SkyWeight weight);

/// The columns of the answers in tables of receivers.
[[nodiscard]] AnswerColumns answer_columns(const SvfOptions& options);

}  // namespace farlod
