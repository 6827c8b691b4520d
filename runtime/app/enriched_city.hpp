// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/svf_options.hpp"
#include "app/written_run.hpp"
#include "farlod/package.hpp"
#include "farlod/run.hpp"

namespace farlod {

/// The run of --city: writes the file that the package was made of again, with the values as attributes of its buildings and
/// semantic surfaces. Throws InputError before the work where the file is another one, and what the library throws.
[[nodiscard]] WrittenRun write_enriched_city(const Package& package, const SvfOptions& options, const RunSettings& run);

}  // namespace farlod
