// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace farlod {

/// No building is higher: the highest has 828 m.
inline constexpr double highest_building_m = 1000.0;
/// The highest building on the highest mountain (8,849 m); and below the deepest shore (-430 m).
inline constexpr double highest_elevation_m = 9850.0, lowest_elevation_m = -500.0;

}  // namespace farlod
