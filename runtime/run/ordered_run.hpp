// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "evaluate/sky_evaluator.hpp"
#include "run/package_contents.hpp"
#include "run/resolved_settings.hpp"

namespace farlod {

/// Evaluates the receivers of all cells on all threads, few cells at a time, and forgets them when their values are stored. Then
/// verifies some of them, when the caller asked for it. The caller counts the receivers without data.
/// What is kept in RunSettings::answers is taken from there. With RunSettings::shard, a part of the cells is evaluated and kept,
/// and nothing is stored; the summary has no more than the counts of these.
[[nodiscard]] EvaluationSummary evaluate_cells(const PackageInUse& package, const ResolvedSettings& settings, CellsOfRun& cells);

}  // namespace farlod
