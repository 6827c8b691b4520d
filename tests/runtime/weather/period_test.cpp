// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "weather/period.hpp"

#include <gmock/gmock.h>

#include "farlod/error.hpp"
#include "tests/scenes/refusal.hpp"

namespace farlod {
namespace {

using namespace std::chrono;
using testing::HasSubstr;

ClockTime at(int y, unsigned m, unsigned d, int hour = 0, int minute = 0) {
  return local_days{year{y} / month{m} / day{d}} + hours(hour) + minutes(minute);
}

/// A period as it is written, and what it is.
struct WrittenPeriod {
  const char* text;
  ClockTime begin, end;
};

TEST(Period, IsTheWholeOfWhatIsNamed) {
  const WrittenPeriod periods[] = {
      {"2026", at(2026, 1, 1), at(2027, 1, 1)},
      {"2026-12", at(2026, 12, 1), at(2027, 1, 1)},
      {"2026-06-30", at(2026, 6, 30), at(2026, 7, 1)},
      {"2024-02-29", at(2024, 2, 29), at(2024, 3, 1)},
      {"2026-06-21T10:00", at(2026, 6, 21, 10), at(2026, 6, 21, 10, 1)},
      {"2025/2026", at(2025, 1, 1), at(2027, 1, 1)},
      {"2026-06/2026-08", at(2026, 6, 1), at(2026, 9, 1)},
      {"2026-06/08", at(2026, 6, 1), at(2026, 9, 1)},
      {"2025-11/2026-02", at(2025, 11, 1), at(2026, 3, 1)},
      {"2026-06-21/25", at(2026, 6, 21), at(2026, 6, 26)},
      {"2026-06-21/07-03", at(2026, 6, 21), at(2026, 7, 4)},
      {"2026-06-21T10:00/16:00", at(2026, 6, 21, 10), at(2026, 6, 21, 16)},
      {"2026-06-21T10:00/24:00", at(2026, 6, 21, 10), at(2026, 6, 22)},
      {"2026-06-21T22:30/22T06:15", at(2026, 6, 21, 22, 30), at(2026, 6, 22, 6, 15)},
      {"2026-06-21 10:00:00/2026-06-21 16:00:00", at(2026, 6, 21, 10), at(2026, 6, 21, 16)},
  };
  for (const WrittenPeriod& written : periods) {
    const Period period = period_in(written.text);
    EXPECT_EQ(period.begin, written.begin) << written.text;
    EXPECT_EQ(period.end, written.end) << written.text;
    EXPECT_FALSE(period.of_any_year) << written.text;
    EXPECT_EQ(period.clock_ahead_of_utc, std::nullopt) << written.text;
    EXPECT_EQ(period.text, written.text);
  }
}

TEST(Period, OfAnyYearHasNone) {
  const WrittenPeriod periods[] = {
      {"02", at(2000, 2, 1), at(2000, 3, 1)},
      {"06-21", at(2000, 6, 21), at(2000, 6, 22)},
      {"06-21T10:00/16:00", at(2000, 6, 21, 10), at(2000, 6, 21, 16)},
      {"06/08", at(2000, 6, 1), at(2000, 9, 1)},
      {"11/02", at(2000, 11, 1), at(2001, 3, 1)},
  };
  for (const WrittenPeriod& written : periods) {
    const Period period = period_in(written.text);
    EXPECT_EQ(period.begin, written.begin) << written.text;
    EXPECT_EQ(period.end, written.end) << written.text;
    EXPECT_TRUE(period.of_any_year) << written.text;
  }
}

TEST(Period, MayNameItsClock) {
  EXPECT_EQ(period_in("2026-06-21T10:00Z/16:00Z").clock_ahead_of_utc, minutes(0));
  EXPECT_EQ(period_in("2026-06-21T10:00+09:00/16:00").clock_ahead_of_utc, minutes(540));
  EXPECT_EQ(period_in("2026-06-21T10:00/16:00-0330").clock_ahead_of_utc, minutes(-210));
  EXPECT_EQ(period_in("2026-06-21T10:00+02/16:00").clock_ahead_of_utc, minutes(120));
}

TEST(Period, ThatIsNoneIsRefused) {
  const auto complaint = [](const char* text) { return scenes::refusal_of<InvalidArgument>([&] { (void)period_in(text); }); };
  EXPECT_THAT(complaint("summer"), HasSubstr("\"summer\" is no period: \"summer\" is no date or time; write it like 2026"));
  EXPECT_THAT(complaint(""), HasSubstr("no date or time"));
  EXPECT_THAT(complaint("2026-6-1"), HasSubstr("no date or time"));
  EXPECT_THAT(complaint("2026-13"), HasSubstr("no such day"));
  EXPECT_THAT(complaint("2026-02-30"), HasSubstr("no such day"));
  EXPECT_THAT(complaint("00"), HasSubstr("no such day"));
  EXPECT_THAT(complaint("2026-06-21T25:00"), HasSubstr("no date or time"));
  EXPECT_THAT(complaint("2026-06-21T10:60/16:00"), HasSubstr("no date or time"));
  EXPECT_THAT(complaint("2026-06-21T10:00+25:00/16:00"), HasSubstr("no date or time"));
  EXPECT_THAT(complaint("10:00/16:00"), HasSubstr("begins with a time of no day"));
  EXPECT_THAT(complaint("2026-06T10:00/16:00"), HasSubstr("needs a day before it"));
  EXPECT_THAT(complaint("01-06-21"), HasSubstr("a year has four digits"));
  EXPECT_THAT(complaint("2026/06"), HasSubstr("two ends are not alike"));
  EXPECT_THAT(complaint("2026-06/2026"), HasSubstr("two ends are not alike"));
  EXPECT_THAT(complaint("2026-06-21/16:00"), HasSubstr("two ends are not alike"));
  EXPECT_THAT(complaint("06/2026-08"), HasSubstr("two ends are not alike"));
  EXPECT_THAT(complaint("2026-06-21T10:00/09:00"), HasSubstr("ends before it begins"));
  EXPECT_THAT(complaint("2026-06-21T10:00Z/16:00+01:00"), HasSubstr("different clocks"));
  EXPECT_THAT(complaint("2026-06-21T10:00/16:00/17:00"), HasSubstr("no date or time"));
}

}  // namespace
}  // namespace farlod
