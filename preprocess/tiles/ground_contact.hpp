// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "farlod/ground_contact.hpp"

namespace farlod {

/// The ground below a border is looked at in places that are no farther apart.
inline constexpr double ground_asked_every_m = 1.0;

}  // namespace farlod
