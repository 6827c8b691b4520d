// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/svf_options.hpp"

namespace farlod {

/// Asked before the work, which may take hours: whether all files of a run can be written, and none of them is one that it reads.
/// Throws OutputError.
void require_outputs(const SvfOptions& options);

}  // namespace farlod
