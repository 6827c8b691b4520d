// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>

namespace farlod::ingest {

/// What a number without a unit counts.
enum class LengthUnit { metre, foot };

[[nodiscard]] double metres_in(LengthUnit unit);

/// The length that a text from an attribute table means, in metres: "17.5", "17,5", "17.5 m", "~17 m", "57 ft", 57', 57'6".
/// Empty for anything else, a range among them: a guess would be worse than a reported gap.
[[nodiscard]] std::optional<double> length_m_from(std::string_view text, LengthUnit plain = LengthUnit::metre);

/// The number that a text from an attribute table means: "3", "2.5", "2,5", "~3". Empty for anything else.
[[nodiscard]] std::optional<double> number_from(std::string_view text);

}  // namespace farlod::ingest
