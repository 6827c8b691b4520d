// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>

namespace farlod::ingest {

/// The unit of a number that is written without one.
enum class LengthUnit { metre, foot, centimetre, millimetre, inch };

[[nodiscard]] double metres_in(LengthUnit unit);

/// The length in a text of an attribute table, in metres: "17.5", "17,5", "17.5 m", "~17 m", "57 ft", 57', 57'6", "80 cm",
/// "6.28 inches". Empty for any other text, such as a range: a reported gap is better than a guess.
[[nodiscard]] std::optional<double> length_m_from(std::string_view text, LengthUnit plain = LengthUnit::metre);

/// The number in a text of an attribute table: "3", "2.5", "2,5", "~3". Empty for any other text.
[[nodiscard]] std::optional<double> number_from(std::string_view text);

}  // namespace farlod::ingest
