// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "farlod/pack.hpp"
#include "pipeline/city_reading.hpp"

namespace farlod::pipeline {

/// What a person looks at to see whether it is the right city. Roofs whose base the terrain does not tell have no height.
[[nodiscard]] CityLooks looks_of(const ReadCity& city);

}  // namespace farlod::pipeline
