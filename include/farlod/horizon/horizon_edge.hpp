// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "farlod/point.hpp"

namespace farlod {

/// An edge of the city below which everything is solid, down to the ground: whoever looks below it sees no sky. Where the whole
/// city stands so, the horizon of a receiver is the upper envelope of these edges. The order of the two ends means nothing.
struct HorizonEdge {
  Point3f a, b;
  bool operator==(const HorizonEdge&) const = default;
};
static_assert(sizeof(HorizonEdge) == 24);

}  // namespace farlod
