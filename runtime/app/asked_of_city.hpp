// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/svf_options.hpp"
#include "farlod/package.hpp"

namespace farlod {

/// Throws NoAnswer where buildings are asked for of a surface model, which does not know them.
void require_buildings_for(const SvfOptions& options, const Package& package);

}  // namespace farlod
