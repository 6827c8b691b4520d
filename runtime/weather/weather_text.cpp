// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "base/unread_file.hpp"
#include "farlod/error.hpp"
#include "inputs/requested_points.hpp"
#include "inputs/text_records.hpp"
#include "weather/weather_table.hpp"

namespace farlod {
namespace {

constexpr const char* known_formats =
    "give an EPW, the TMY of PVGIS as CSV, a TMY3 of NREL, or a CSV whose first row names time, global, direct and diffuse";

/// How files of other kinds begin, and what people call them.
struct OtherKind {
  std::string_view begin, what;
};

constexpr OtherKind other_kinds[] = {
    {"PK\x03\x04", "a ZIP archive: unpack it first"},
    {"\x1F\x8B", "packed by gzip: unpack it first"},
    {"{", "JSON"},
    {"[", "JSON"},
    {"<", "a web page or XML"},
};

/// Why text cannot be that of weather; empty where it may be.
std::string other_kind_of(std::string_view text) {
  for (const OtherKind& kind : other_kinds)
    if (text.starts_with(kind.begin)) return "is " + std::string(kind.what);
  if (text.find('\0') != std::string_view::npos) return "is no text";
  return {};
}

std::vector<std::string_view> lines_in(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

}  // namespace

WeatherText::WeatherText(const std::filesystem::path& path) : path_(path) {
  std::ifstream stream(path, std::ios::binary);
  // A folder opens like a file, and fails only when it is read
  if (!stream || std::filesystem::is_directory(path)) throw InputError(why_unread(path));
  text_.assign(std::istreambuf_iterator<char>(stream), {});
  const std::string_view text = without_byte_order_mark(text_);
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) refuse_file(std::string("the file is empty; ") + known_formats);
  const std::string other = other_kind_of(text.substr(begin));
  if (!other.empty()) refuse_file("the file is no weather, it " + other + "; " + known_formats);
  lines_ = lines_in(text);
}

std::vector<std::string> WeatherText::fields(std::size_t n, char separator) const {
  std::vector<TextRecord> records = split_records(line(n), separator);
  return records.empty() ? std::vector<std::string>() : std::move(records.front().fields);
}

double WeatherText::number(std::size_t n, const std::vector<std::string>& fields, std::size_t column, const char* name) const {
  if (column >= fields.size())
    refuse(n, fmt::format("the row ends before {}: the file was cut off, or is no weather; get it again", name));
  const std::optional<double> value = number_in(fields[column]);
  if (!value) refuse(n, fmt::format("\"{}\" is not a number ({}); write it like 123.4", fields[column], name));
  return *value;
}

int WeatherText::whole_number(std::size_t n, const std::vector<std::string>& fields, std::size_t column, const char* name) const {
  constexpr double largest = 9999.0;
  const double value = number(n, fields, column, name);
  if (value != std::floor(value) || std::abs(value) > largest)
    refuse(n, fmt::format("\"{}\" is no {}; write a whole number", fields[column], name));
  return static_cast<int>(value);
}

void WeatherText::require_as_long(std::size_t n, const std::vector<std::string>& fields, std::size_t first) const {
  if (fields.size() < first)
    refuse(n, fmt::format("the row ends after {} of {} fields: the file was cut off; get it again, or remove the row",
                          fields.size(), first));
}

void WeatherText::refuse(std::size_t n, const std::string& what) const {
  throw InputError(fmt::format("{}:{}: {}", path_.string(), n + 1, what));
}

void WeatherText::refuse_file(const std::string& what) const { throw InputError(path_.string() + ": " + what); }

std::string time_text(ClockTime time) {
  const auto day = std::chrono::floor<std::chrono::days>(time);
  const std::chrono::year_month_day date(day);
  const auto minutes = std::chrono::floor<std::chrono::minutes>(time - day).count();
  return fmt::format("{:04}-{:02}-{:02} {:02}:{:02}", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                     static_cast<unsigned>(date.day()), minutes / 60, minutes % 60);
}

std::string place_text(const PlaceOnEarth& place) {
  const double latitude = place.latitude.degrees(), longitude = place.longitude.degrees();
  return fmt::format("{:.2f}° {}, {:.2f}° {}", std::abs(latitude), latitude < 0.0 ? "S" : "N", std::abs(longitude),
                     longitude < 0.0 ? "W" : "E");
}

std::string clock_text(std::chrono::milliseconds ahead_of_utc) {
  const auto minutes = std::chrono::round<std::chrono::minutes>(ahead_of_utc).count();
  if (minutes == 0) return "UTC";
  const std::string sign = minutes < 0 ? "−" : "+";
  const auto size = std::abs(minutes);
  return "UTC" + sign + (size % 60 == 0 ? fmt::format("{}", size / 60) : fmt::format("{}:{:02}", size / 60, size % 60));
}

std::string length_text(std::chrono::milliseconds length) {
  using std::chrono::duration, std::chrono::hours, std::chrono::minutes;
  if (length < hours(1)) return fmt::format("{:.4g} min", duration<double, minutes::period>(length).count());
  return fmt::format("{:.7g} h", duration<double, hours::period>(length).count());
}

ClockTime day_of(const WeatherText& text, std::size_t n, int year, int month, int day) {
  const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  constexpr int first_year = 1961;  // from when on the sun's positions are known, on any clock
  if (!date.ok() || year < first_year)
    text.refuse(n,
                fmt::format("there is no {:04}-{:02}-{:02}, or it is before {}; correct the date", year, month, day, first_year));
  return std::chrono::local_days(date);
}

PlaceOnEarth place_of(const WeatherText& text, std::size_t n, double latitude_deg, double longitude_deg, double height_m) {
  if (std::abs(latitude_deg) > 90.0 || std::abs(longitude_deg) > 180.0)
    text.refuse(n, fmt::format("latitude {}, longitude {} is no place on the Earth; correct it", latitude_deg, longitude_deg));
  constexpr double highest_m = 9000.0;  // beyond, it is a code for nothing known
  return {Angle::degrees(longitude_deg), Angle::degrees(latitude_deg), std::abs(height_m) < highest_m ? height_m : 0.0};
}

WeatherYears years_of(const std::vector<WeatherRow>& rows) {
  using std::chrono::months, std::chrono::year_month_day, std::chrono::days;
  for (std::size_t n = 1; n < rows.size(); ++n) {
    const year_month_day before(std::chrono::floor<days>(rows[n - 1].stamp)), after(std::chrono::floor<days>(rows[n].stamp));
    const auto next = before.year() / before.month() + months(1);
    if (before.month() != after.month() && next.month() == after.month() && next.year() != after.year())
      return WeatherYears::typical;
  }
  return WeatherYears::measured;
}

}  // namespace farlod
