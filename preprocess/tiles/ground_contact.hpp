// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace farlod {

/// What is no higher than this above the ground stands on it: surveys and terrains do not agree to less.
inline constexpr double ground_contact_m = 0.05;
/// The ground below a border is looked at in places that are no farther apart.
inline constexpr double ground_asked_every_m = 1.0;

}  // namespace farlod
