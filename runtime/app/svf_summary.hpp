// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/written_run.hpp"

namespace farlod {

/// The text of `--summary`; its keys are listed in docs/stages/results.md.
[[nodiscard]] std::string svf_summary_json(const WrittenRun& written, const SvfOptions& options, double total_seconds);

}  // namespace farlod
