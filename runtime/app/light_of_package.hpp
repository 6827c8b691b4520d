// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/svf_options.hpp"
#include "farlod/package.hpp"
#include "farlod/weather.hpp"

namespace farlod {

/// Gives the quantities that are asked for the sun and the light over the middle of the package. Returns what is known of the
/// light besides its intervals, if there is any; its remarks are for users. Throws InputError where the weather cannot be used,
/// and where the package's place is not known, as without GDAL.
[[nodiscard]] std::optional<PeriodLight> place_light(const Package& package, SvfOptions& options);

/// What users should know of the light: sentences.
[[nodiscard]] std::vector<std::string> notes_of(const PeriodLight& light);

}  // namespace farlod
