// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "results/picture/drawing.hpp"

namespace farlod {

/// A length of 1, 2 or 5 times a power of ten, the longest that is not above `limit_m` (which is positive).
[[nodiscard]] double round_length_m(double limit_m);

/// A scale bar below a place, of 200 pixels at the most.
void add_scale_bar(Drawing& drawing, PagePoint place, double metres_per_pixel);

/// An arrow that points upwards, with an N below it.
void add_north_arrow(Drawing& drawing, PagePoint tip);

}  // namespace farlod
