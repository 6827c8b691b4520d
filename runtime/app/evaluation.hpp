// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/svf_options.hpp"
#include "evaluate/svf_values.hpp"
#include "evaluate/verification.hpp"
#include "package/package.hpp"

namespace farlod {

/// Seconds of wall clock by part of the work.
struct RunSeconds {
  double open = 0.0, scenes = 0.0, evaluate = 0.0, write = 0.0;
};

/// Stores the values of the n-th cell's receivers, which are in the order of the receivers. Called for one cell at a time, in the
/// order of the cells.
using StoreValues = std::function<void(std::size_t n, const CellReceivers& cell, const SvfValues& values)>;

/// Width of the intervals [low, high].
struct BoundsWidth {
  double mean = 0.0, max = 0.0;
};

/// The figures of a run, for people and for `--summary`.
struct SvfRun {
  std::size_t receivers = 0;         ///< with a value
  std::size_t inside_buildings = 0;  ///< receivers without a value
  std::size_t beyond_grid = 0;       ///< pixels of a raster that lie in no cell: without a value too
  std::size_t outside_of_grid = 0;   ///< receivers outside of the grid, which were traced against the whole city
  RunSeconds seconds;
  std::optional<double> svf_min, svf_mean, svf_max;
  std::optional<BoundsWidth> bounds;
  std::uint64_t by_rays = 0;        ///< receivers that needed rays
  std::uint64_t retraced_rays = 0;  ///< traced against the whole city because the far map was not enough (--max-error)
  std::optional<ErrorSummary> errors;
  std::vector<std::filesystem::path> files;
};

/// Evaluates the receivers of all cells on all cores, few cells at a time, and forgets them when their values are stored. Then
/// verifies some of them, when the user asked for it. Adds to the run's times and figures; the caller counts the receivers
/// without data.
void evaluate_cells(const Package& package, const SvfOptions& options, std::size_t cell_count,
                    const ReceiversOfCell& receivers_of, const StoreValues& store, SvfRun& run);

/// Evaluates a run, and lets it write its files. `Run` has cell_count(), receivers_of(n), store(n, receivers, values) and
/// finish(SvfRun&).
template <class Run>
[[nodiscard]] SvfRun evaluate_and_finish(const Package& package, const SvfOptions& options, Run& run) {
  SvfRun result;
  evaluate_cells(
      package, options, run.cell_count(), [&run](std::size_t n) { return run.receivers_of(n); },
      [&run](std::size_t n, const CellReceivers& cell, const SvfValues& values) { run.store(n, cell, values); }, result);
  const auto start = std::chrono::steady_clock::now();
  run.finish(result);
  result.seconds.write += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

/// The three kinds of run. Each checks the memory limit, evaluates, writes its files and returns its figures.
[[nodiscard]] SvfRun run_raster(Package& package, const SvfOptions& options);
[[nodiscard]] SvfRun run_points(Package& package, const SvfOptions& options);
[[nodiscard]] SvfRun run_surfaces(Package& package, const SvfOptions& options);

/// "svf" or "svf_solid": never one ambiguous name.
[[nodiscard]] std::string quantity_name(SkyWeight weight);

/// The columns of the answers in tables of receivers.
[[nodiscard]] AnswerColumns answer_columns(const SvfOptions& options);

}  // namespace farlod
