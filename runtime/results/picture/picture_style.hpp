// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

#include "results/picture/picture.hpp"

namespace farlod {

/// What all pictures with words have in common.
inline constexpr Colour ink{32, 32, 32}, muted{96, 96, 96};
inline constexpr double title_height = 22.0, text_height = 15.0;
inline constexpr double half_digit_height = 0.36;  ///< of a font's size
inline constexpr double rad_per_deg = std::numbers::pi / 180.0;

}  // namespace farlod
