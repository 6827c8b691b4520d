// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace farlod {

/// What is no higher than this above the ground stands on it: surveys and terrains do not agree to less. Nothing is seen below
/// it, and nobody stands there.
inline constexpr double ground_contact_m = 0.05;

}  // namespace farlod
