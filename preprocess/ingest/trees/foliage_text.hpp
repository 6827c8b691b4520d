// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "package/crown.hpp"

namespace farlod::ingest {

/// What winter does to a tree of this species, by its scientific or English name or its genus alone: one of a short list of
/// evergreen genera, or unknown.
[[nodiscard]] Foliage foliage_of_species(std::string_view species);

/// By the values of OpenStreetMap's `leaf_cycle` and `leaf_type`: "evergreen", "deciduous", "needleleaved" (of which the few that
/// shed their needles have another leaf cycle).
[[nodiscard]] Foliage foliage_of_leaves(std::string_view leaves);

}  // namespace farlod::ingest
