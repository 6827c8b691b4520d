// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "city/city_model.hpp"
#include "farlod/problem.hpp"

namespace farlod::plausibility {

/// Compares the buildings of each two files, where the extents of the files meet.
///
/// A building has been described twice when its middle lies in the plan of one of the other file, which is half to 25 times as
/// large, and when the two share half of the lower one's height. Heights count where both are elevations.
///   described_twice: this holds for a quarter of the buildings of a file that lie in the extent of the other one, and for a
///   twentieth of all of its buildings, but three at least. Reported once for each two files, at the later one where either
///   could.
/// Tiles of a city share fewer along their borders. Of a city of more than 200,000 buildings, some districts are looked at.
/// Coordinates are in metres, in any frame of the output CRS. Positions are as the city has them.
void report_described_twice(const LocatedCity& located, Report& report);

}  // namespace farlod::plausibility
