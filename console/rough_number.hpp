// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace farlod {

/// Estimates for people: two digits, the rest zeros, and a unit that suits.
[[nodiscard]] double rough_number(double value);
[[nodiscard]] std::string rough_duration(double seconds);
[[nodiscard]] std::string rough_size(double mib);

/// "1,234,567"
[[nodiscard]] std::string with_commas(std::uint64_t number);

}  // namespace farlod
