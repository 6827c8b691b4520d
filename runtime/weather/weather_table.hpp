// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "weather/weather.hpp"

namespace farlod {

/// What a row of a file says of an interval, with what the file writes where it knows nothing.
struct WeatherRow {
  std::size_t line = 0;
  ClockTime stamp;  ///< as the file writes it, on the clock of the file
  std::optional<double> global_w_m2 = {}, direct_normal_w_m2 = {}, diffuse_w_m2 = {};
  std::optional<double> direct_normal_lux = {}, diffuse_lux = {};
  std::optional<double> temperature_c = {}, dew_point_c = {}, humidity_percent = {}, pressure_hpa = {};
};

/// What a file says, in the order of its rows.
struct WeatherTable {
  std::string source;
  std::optional<PlaceOnEarth> place = {};
  std::chrono::milliseconds clock_ahead_of_utc{};
  std::chrono::milliseconds step{};                ///< the length of each interval
  std::chrono::milliseconds middle_after_stamp{};  ///< of an interval
  std::optional<ClockTime> announced_end = {};     ///< where the file says when its last interval ends
  WeatherYears years = WeatherYears::measured;
  std::vector<WeatherRow> rows = {};
  std::vector<std::string> remarks = {};
};

/// The text of a file, line by line.
class WeatherText {
 public:
  /// Throws InputError where it cannot be read, is empty or is no text.
  explicit WeatherText(const std::filesystem::path& path);

  [[nodiscard]] std::size_t line_count() const { return lines_.size(); }
  /// Lines are counted from 0; people count them from 1.
  [[nodiscard]] std::string_view line(std::size_t n) const { return n < lines_.size() ? lines_[n] : std::string_view(); }
  [[nodiscard]] std::vector<std::string> fields(std::size_t n) const { return fields(n, ','); }
  [[nodiscard]] std::vector<std::string> fields(std::size_t n, char separator) const;
  /// The number in a field. Refuses a row that ends before it, and a field that holds something else.
  [[nodiscard]] double number(std::size_t n, const std::vector<std::string>& fields, std::size_t column, const char* name) const;
  /// The same, of whole numbers.
  [[nodiscard]] int whole_number(std::size_t n, const std::vector<std::string>& fields, std::size_t column,
                                 const char* name) const;
  /// Refuses a row with fewer fields than `first`, a row of its table: it was cut off.
  void require_as_long(std::size_t n, const std::vector<std::string>& fields, std::size_t first) const;
  /// Throws InputError: the file, the line and what is wrong with it.
  [[noreturn]] void refuse(std::size_t n, const std::string& what) const;
  [[noreturn]] void refuse_file(const std::string& what) const;
  [[nodiscard]] std::string name() const { return path_.filename().string(); }

 private:
  std::filesystem::path path_;
  std::string text_;
  std::vector<std::string_view> lines_;
};

/// A time as messages write it: `2026-06-21 10:00`.
[[nodiscard]] std::string time_text(ClockTime time);
/// A place: `51.95° N, 4.45° E`.
[[nodiscard]] std::string place_text(const PlaceOnEarth& place);
/// A clock: `UTC+9`, `UTC−3:30`.
[[nodiscard]] std::string clock_text(std::chrono::milliseconds ahead_of_utc);
/// A length of time: `1.5 h`, `15 min`.
[[nodiscard]] std::string length_text(std::chrono::milliseconds length);
/// The beginning of a day. Refuses what is none, as line `n`.
[[nodiscard]] ClockTime day_of(const WeatherText& text, std::size_t n, int year, int month, int day);
/// The place of three fields. Refuses what is none, as line `n`.
[[nodiscard]] PlaceOnEarth place_of(const WeatherText& text, std::size_t n, double latitude_deg, double longitude_deg,
                                    double height_m);

/// The kinds of files. Each has a function that recognises its text, and one that reads it.
[[nodiscard]] bool is_epw(const WeatherText& text);
[[nodiscard]] WeatherTable read_epw(const WeatherText& text);
[[nodiscard]] bool is_pvgis_tmy(const WeatherText& text);
[[nodiscard]] WeatherTable read_pvgis_tmy(const WeatherText& text);
[[nodiscard]] bool is_tmy3(const WeatherText& text);
[[nodiscard]] WeatherTable read_tmy3(const WeatherText& text);
/// Any other table: refuses one whose first row does not name what is needed.
[[nodiscard]] WeatherTable read_named_columns(const WeatherText& text);

/// Whether the months of rows follow each other in other years than those of a calendar.
[[nodiscard]] WeatherYears years_of(const std::vector<WeatherRow>& rows);

/// Takes out the codes that mean that nothing is known, makes small negative irradiances 0, and refuses what cannot be. Rows that
/// are left with fewer than what tells all three irradiances stay, and are no intervals. What it did is a remark.
void clean_values(WeatherTable& table, const WeatherText& text);

/// Rows in order, without overlap: refuses others. Tells what is missing between them.
void check_times(WeatherTable& table, const WeatherText& text);

/// The intervals of a table, with the irradiances that two others tell, or, where global is the only one, that of Erbs 1982.
/// `place`: where the sun is seen from; refuses rows that need it where it is not known.
[[nodiscard]] std::vector<WeatherInterval> intervals_of(WeatherTable& table, const std::optional<PlaceOnEarth>& place,
                                                        const WeatherText& text);

/// Compares the place of a file with that of the city: a remark.
void check_place(WeatherTable& table, const PlaceOnEarth& city);

/// Compares irradiances with the sun: refuses those that have it at night, and tells what does not fit together.
void check_with_sun(WeatherTable& table, const std::vector<WeatherInterval>& intervals, const PlaceOnEarth& place,
                    const WeatherText& text);

}  // namespace farlod
