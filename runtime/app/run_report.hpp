// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/svf_options.hpp"
#include "app/written_run.hpp"

namespace farlod {

/// Prints what a run did: of a dry run, what it would take.
void print_report(const WrittenRun& written, const SvfOptions& options, double total_s);

}  // namespace farlod
