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

/// Evaluates the receivers of all cells on all threads, few cells at a time, and forgets them when their values are stored. Then
/// verifies some of them, when the caller asked for it. The caller counts the receivers without data.
[[nodiscard]] EvaluationSummary evaluate_cells(const PackageInUse& package, const ResolvedSettings& settings,
                                               std::size_t cell_count, const ReceiversOfCell& receivers_of,
                                               const StoreValues& store);

}  // namespace farlod
