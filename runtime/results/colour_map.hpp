// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "results/picture.hpp"

namespace farlod {

/// The colour of a view factor between 0 (dark violet) and 1 (yellow); what lies outside takes the colour of the nearer end.
/// The map is viridis: equal steps look equal, also without colour vision, since the lightness only ever rises.
[[nodiscard]] Colour colour_of_share(double share);

/// Where there is no answer: a grey that the colour map does not have.
inline constexpr Colour nodata_colour{190, 190, 190};

}  // namespace farlod
