// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace farlod {

/// The length of a degree of latitude, to three digits.
inline constexpr double metres_in_a_degree = 111e3;

}  // namespace farlod
