// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>

namespace farlod {

/// The length that a text from an attribute table means, in metres: "17.5", "17,5", "17.5 m", "57 ft", 57', 57'6".
/// Empty for anything else: a guess would be worse than a reported gap.
[[nodiscard]] std::optional<double> length_m_from(std::string_view text);

}  // namespace farlod
