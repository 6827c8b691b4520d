// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

#include "evaluate/svf_values.hpp"
#include "run/package_contents.hpp"
#include "run/resolved_settings.hpp"

namespace farlod {

/// Stores the values of the n-th cell's receivers, which are in the order of the receivers. Called for one cell at a time, in the
/// order of the cells.
using StoreValues = std::function<void(std::size_t n, const CellReceivers& cell, const SvfValues& values)>;

/// The cells of a run, in their order.
struct CellsOfRun {
  std::size_t count = 0;
  ReceiversOfCell receivers;
  /// About how many receivers the n-th cell has, before they are placed. Without it, about the same number in each cell.
  std::function<double(std::size_t n)> receivers_about = nullptr;
  /// The place of the n-th cell.
  std::function<Cell(std::size_t n)> place = nullptr;
};

/// Evaluates the receivers of all cells on all threads, few cells at a time, and forgets them when their values are stored. Then
/// verifies some of them, when the caller asked for it. The caller counts the receivers without data.
/// What is kept in RunSettings::answers is taken from there. With RunSettings::shard, a part of the cells is evaluated and kept,
/// and nothing is stored; the summary has no more than the counts of these.
[[nodiscard]] EvaluationSummary evaluate_cells(const PackageInUse& package, const ResolvedSettings& settings,
                                               const CellsOfRun& cells, const StoreValues& store);

}  // namespace farlod
