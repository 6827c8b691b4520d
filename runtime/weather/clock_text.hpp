// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <string_view>
#include <vector>

namespace farlod {

/// A date, a time of day, or both, as ISO 8601 writes them; what they mean is open.
struct ClockText {
  std::vector<int> date;          ///< its numbers: none to three
  bool begins_with_year = false;  ///< the first of them has four digits
  std::optional<std::chrono::milliseconds> time_of_day;
  std::optional<std::chrono::minutes> ahead_of_utc;
};

/// Reads text such as `2026-06-21T10:00`, `06-21`, `10:00:30.5+09:00`, `2026-06-21 10:00Z`: numbers of a date with hyphens, a
/// time of day from 00:00 to 24:00, and its offset from UTC. None where it is something else.
[[nodiscard]] std::optional<ClockText> clock_text_in(std::string_view text);

}  // namespace farlod
