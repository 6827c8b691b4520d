// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "app/svf_options.hpp"
#include "app/written_run.hpp"
#include "farlod/package.hpp"

namespace farlod {

/// Writes what --verify found out as --verify-map asks for it, a picture or a table, and adds the file to those of the run.
void write_verification(const Package& package, const SvfOptions& options, std::size_t threads, WrittenRun& written);

}  // namespace farlod
