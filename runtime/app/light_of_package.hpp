// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/svf_options.hpp"
#include "farlod/package.hpp"

namespace farlod {

/// Gives the quantities that are asked for the sun and the light over the middle of the package. Returns what users should know
/// of the light: sentences. Throws InputError where the weather cannot be used, and where the package's place is not known, as
/// without GDAL.
[[nodiscard]] std::vector<std::string> place_light(const Package& package, SvfOptions& options);

}  // namespace farlod
