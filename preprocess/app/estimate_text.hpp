// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "farlod/pack.hpp"

namespace farlod {

/// What is told before the long work: a line, rounded to what an estimate can know.
[[nodiscard]] std::string estimate_text(const PackEstimate& estimate);

}  // namespace farlod
