// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/svf_options.hpp"
#include "farlod/evaluation.hpp"
#include "farlod/package.hpp"

namespace farlod {

/// What users may take for something else: what the answers of a run are not, a sentence each.
[[nodiscard]] std::vector<std::string> notes_of_run(const Package& package, const SvfOptions& options,
                                                    const EvaluationSummary& summary);

}  // namespace farlod
