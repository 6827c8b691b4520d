// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace farlod {

/// A time on a clock that is not told yet: what calendars and clocks show.
using ClockTime = std::chrono::local_time<std::chrono::milliseconds>;

/// A span of time, as people write it.
struct Period {
  std::string text;      ///< as it was written
  ClockTime begin, end;  ///< half open. Without a year, those of 2000 and 2001
  bool of_any_year = false;
  /// The clock that is meant, where it is written; else that of the weather (Weather::clock_ahead_of_utc).
  std::optional<std::chrono::minutes> clock_ahead_of_utc = {};
};

/// Reads a period in the notation of ISO 8601:
///   (1) a year, month, day or minute: `2026`, `2026-06`, `2026-06-21`, `2026-06-21T10:00`, of which it is the whole;
///   (2) two of them with a slash between, both whole but for minutes, where the second is the end: `2026-06/2026-08`,
///       `2026-06-21T10:00/2026-06-21T16:00`;
///   (3) the second may leave out what the first says: `2026-06/08`, `2026-06-21/25`, `2026-06-21T10:00/16:00`;
///   (4) the year may be left out of both: `06`, `06-21`, `06-21T10:00/16:00`, `11/02`: the period of any year;
///   (5) minutes may be followed by `Z` or an offset from UTC, such as `+09:00`.
/// Throws InvalidArgument.
[[nodiscard]] Period period_in(std::string_view text);

}  // namespace farlod
