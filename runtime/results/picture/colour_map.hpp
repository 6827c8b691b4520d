// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "results/picture/picture.hpp"

namespace farlod {

/// The colour of a view factor between 0 (dark violet) and 1 (yellow); a value outside is clamped. The
/// map is viridis, which is perceptually uniform and of monotonic lightness, so that it can be read without colour vision.
[[nodiscard]] Colour colour_of_svf(double svf);

/// The colour of an error, as a share of the largest of the scale: from −1 (violet) over 0 (nearly white) to 1 (brown); a value
/// outside is clamped. Of both signs, the darker is the larger, and colours of opposite signs are told apart without one kind of
/// cones; in a print in grey they are not.
[[nodiscard]] Colour colour_of_error(double share);

/// The colour of pixels without data: a grey that is not in the colour map.
inline constexpr Colour nodata_colour{190, 190, 190};

}  // namespace farlod
