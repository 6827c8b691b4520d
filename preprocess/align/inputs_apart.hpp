// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "base/grid.hpp"
#include "city/city_model.hpp"

namespace farlod::align {

/// A text that the inputs of a city lie some kilometres apart, with a grid between them that has next to no building: each would
/// better be packed on its own. Empty where they do not, or where there is one input. Throws InputError where they lie more than
/// 100 km apart, on more than a million cells: such a grid takes the memory of a large machine, and nobody wants it.
[[nodiscard]] std::optional<std::string> inputs_apart(const LocatedCity& located, const Grid& grid);

}  // namespace farlod::align
