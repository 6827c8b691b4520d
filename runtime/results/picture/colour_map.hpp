// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "results/picture/picture.hpp"

namespace farlod {

/// The colour of a view factor between 0 (dark violet) and 1 (yellow); a value outside is clamped. The
/// map is viridis, which is perceptually uniform and of monotonic lightness, so that it can be read without colour vision.
[[nodiscard]] Colour colour_of_svf(double svf);

/// The colour of pixels without data: a grey that is not in the colour map.
inline constexpr Colour nodata_colour{190, 190, 190};

}  // namespace farlod
