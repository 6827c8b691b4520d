// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace farlod::benchmark {

/// Place of a point of the unit square on the Hilbert curve: what is near on the curve is near in the square.
[[nodiscard]] std::uint64_t place_on_curve(double x, double y);

}  // namespace farlod::benchmark
