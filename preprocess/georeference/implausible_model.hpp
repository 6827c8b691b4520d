// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "city/located_city.hpp"
#include "farlod/problem.hpp"

namespace farlod::georeference {

/// Reports files whose buildings cannot be what they are meant to be, each once for the whole file, with what would explain it:
///   (1) implausible_size: buildings higher or larger than any on Earth, or a typical building smaller than 1 m
///   (2) lies_on_its_side: the ground rises as steeply as no town does, because another axis is the upward one
/// Coordinates are in metres, in any frame of the output CRS. Positions are as the city has them.
void report_implausible(const LocatedCity& located, Report& report);

}  // namespace farlod::georeference
