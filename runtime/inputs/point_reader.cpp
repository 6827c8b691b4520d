// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "inputs/point_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <numeric>
#include <span>
#include <string_view>
#include <utility>

#include "base/point_columns.hpp"

namespace farlod {
namespace {

/// A row of a table in text, and the line on which it begins.
struct TextRecord {
  std::size_t line = 0;
  std::vector<std::string> fields;  ///< without quotes and the blanks around them
};

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

char separator_of(std::string_view row) {
  bool tab = false, semicolon = false, quoted = false;
  for (const char c : row) {
    if (c == '"') quoted = !quoted;
    tab = tab || (!quoted && c == '\t');
    semicolon = semicolon || (!quoted && c == ';');
  }
  return tab ? '\t' : semicolon ? ';' : ',';
}

std::string_view first_row(std::string_view text) {
  const std::size_t begin = std::min(text.find_first_not_of("\r\n"), text.size());
  return text.substr(begin, text.find('\n', begin) - begin);
}

std::string trimmed(std::string_view field) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!field.empty() && blank(field.front())) field.remove_prefix(1);
  while (!field.empty() && blank(field.back())) field.remove_suffix(1);
  return std::string(field);
}

/// Walks through the text once, a character at a time.
class RecordSplitter {
 public:
  explicit RecordSplitter(char separator) : separator_(separator) {}

  void take(char c) {
    line_ += c == '\n' ? 1 : 0;
    if (c == '"')
      take_quote();
    else if (quoted_ || (c != separator_ && c != '\n'))
      field_ += c;
    else
      end_field(c);
    after_closing_quote_ = c == '"' && !quoted_;
  }
  std::vector<TextRecord> finish() {
    end_field('\n');
    return std::move(records_);
  }

 private:
  void take_quote() {
    // A quote right after a closing one stands for the character itself
    if (after_closing_quote_) field_ += '"';
    quoted_ = !quoted_;
  }
  void end_field(char end) {
    record_.fields.push_back(trimmed(field_));
    field_.clear();
    if (end == separator_) return;
    const bool empty = std::all_of(record_.fields.begin(), record_.fields.end(), [](const std::string& f) { return f.empty(); });
    if (!empty) records_.push_back(std::move(record_));
    record_ = {line_, {}};
  }

  char separator_;
  bool quoted_ = false, after_closing_quote_ = false;
  std::size_t line_ = 1;
  std::string field_;
  TextRecord record_{1, {}};
  std::vector<TextRecord> records_;
};

/// Splits a table into rows and fields. The separator is the first of tab, semicolon and comma that the first row has outside of
/// quotes. Knows quoted fields (RFC 4180), CRLF and a byte order mark; leaves out empty lines.
std::vector<TextRecord> split_records(std::string_view text) {
  text = without_byte_order_mark(text);
  RecordSplitter splitter(separator_of(first_row(text)));
  for (const char c : text) splitter.take(c);
  return splitter.finish();
}

[[noreturn]] void refuse(const std::filesystem::path& path, std::size_t line, const std::string& what) {
  throw PointsError(path.string() + ":" + std::to_string(line) + ": " + what);
}

bool is_header(const TextRecord& record) {
  return std::none_of(record.fields.begin(), record.fields.end(), [](const std::string& f) { return number_in(f).has_value(); });
}

PointFields columns_of_header(const TextRecord& header, const std::filesystem::path& path) {
  const auto refuse_header = [&](const std::string& what) { refuse(path, header.line, what); };
  PointFields columns = point_fields(header.fields, PlacesIn::fields, refuse_header);
  if (!columns.x || !columns.y)
    refuse_header("no column is named x and y (or easting and northing, or lon and lat); name them in the first row");
  return columns;
}

PointFields columns_without_header(const TextRecord& first, const std::filesystem::path& path) {
  if (first.fields.size() != 2 && first.fields.size() != 3)
    refuse(path, first.line,
           "a table without a header row has the columns x, y and perhaps z; name the columns in the first row");
  PointFields columns;
  columns.x = 0;
  columns.y = 1;
  if (first.fields.size() == 3) columns.z = 2;
  return columns;
}

double coordinate(const TextRecord& record, std::size_t column, const char* name, const std::filesystem::path& path) {
  if (column >= record.fields.size())
    refuse(path, record.line, std::string("the row ends before ") + name + "; give each row as many fields as the first");
  const std::optional<double> value = number_in(record.fields[column]);
  if (!value) refuse(path, record.line, "\"" + record.fields[column] + "\" is not a number (" + name + "); write it like 1234.5");
  return *value;
}

/// None where the table has no such column, or the row nothing in it.
std::optional<double> number_if_any(const TextRecord& record, std::optional<std::size_t> column, const char* name,
                                    const std::filesystem::path& path) {
  if (!column || *column >= record.fields.size() || record.fields[*column].empty()) return std::nullopt;
  return coordinate(record, *column, name, path);
}

RequestedPoint point_of(const TextRecord& record, const PointFields& columns, const std::filesystem::path& path) {
  RequestedPoint point;
  point.x = coordinate(record, *columns.x, "x", path);
  point.y = coordinate(record, *columns.y, "y", path);
  point.z = number_if_any(record, columns.z, "z", path);
  point.normal =
      normal_of(number_if_any(record, columns.azimuth, "azimuth", path), number_if_any(record, columns.tilt, "tilt", path),
                [&](const std::string& what) { refuse(path, record.line, what); });
  if (columns.id && *columns.id < record.fields.size()) point.id = record.fields[*columns.id];
  return point;
}

/// Empty fields at the end of a row do no harm.
void require_columns_for_all(const TextRecord& record, std::size_t columns, const std::filesystem::path& path) {
  for (std::size_t n = columns; n < record.fields.size(); ++n)
    if (!record.fields[n].empty())
      refuse(path, record.line,
             "\"" + record.fields[n] + "\" has no column: the row has more fields than the header; quote a field that has the " +
                 "separator in it");
}

std::vector<std::string> chosen_fields(const TextRecord& record, std::span<const std::size_t> columns) {
  std::vector<std::string> fields;
  for (const std::size_t n : columns) fields.push_back(n < record.fields.size() ? record.fields[n] : "");
  return fields;
}

/// A column without a name, as tables of numbered rows have one, is named by its number.
Attributes attributes_of_header(const TextRecord& header, std::span<const std::size_t> columns) {
  std::vector<std::string> names = chosen_fields(header, columns);
  for (std::size_t k = 0; k < names.size(); ++k)
    if (names[k].empty()) names[k] = "column_" + std::to_string(columns[k] + 1);
  return Attributes(std::move(names));
}

std::ifstream open_table(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  // A folder opens like a file, and fails only when it is read
  if (!stream || std::filesystem::is_directory(path))
    throw PointsError(path.string() + ": the file cannot be read; see that it exists and that you may read it");
  return stream;
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream stream = open_table(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

bool may_be_lon_lat(const RequestedPoint& p) { return std::abs(p.x) <= 360.0 && std::abs(p.y) <= 90.0; }

}  // namespace

RequestedPoints read_points_csv(const std::filesystem::path& path) {
  const std::vector<TextRecord> records = split_records(text_of(path));
  if (records.empty())
    throw PointsError(path.string() + ": the file holds no points; write one in each row, as x,y or with a header row");
  const bool header = is_header(records.front());
  const PointFields columns = header ? columns_of_header(records.front(), path) : columns_without_header(records.front(), path);
  RequestedPoints result;
  result.has_normals = columns.tilt.has_value();
  if (header) result.attributes = attributes_of_header(records.front(), columns.attributes);
  std::vector<RequestedPoint>& points = result.points;
  points.reserve(records.size());
  for (const TextRecord& record : std::span(records).subspan(header ? 1 : 0)) {
    if (header) require_columns_for_all(record, records.front().fields.size(), path);
    points.push_back(point_of(record, columns, path));
    result.attributes.add_row(chosen_fields(record, columns.attributes));
    if (points.back().id.empty()) points.back().id = std::to_string(points.size());
  }
  if (points.empty()) throw PointsError(path.string() + ": the file has a header row but no points; add one in each row");
  if (header && point_columns::are_degrees(records.front().fields[*columns.x]) && std::ranges::all_of(points, may_be_lon_lat))
    result.crs_wkt = "OGC:CRS84";
  return result;
}

std::vector<std::string> read_header_csv(const std::filesystem::path& path) {
  std::ifstream stream = open_table(path);
  std::string line;
  std::getline(stream, line);
  const std::vector<TextRecord> records = split_records(line);
  return records.empty() || !is_header(records.front()) ? std::vector<std::string>() : records.front().fields;
}

Attributes read_table_csv(const std::filesystem::path& path) {
  const std::vector<TextRecord> records = split_records(text_of(path));
  if (records.empty() || !is_header(records.front()))
    throw PointsError(path.string() + ": the table has no header row; name its columns in the first row");
  std::vector<std::size_t> all(records.front().fields.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  Attributes table = attributes_of_header(records.front(), all);
  for (const TextRecord& record : std::span(records).subspan(1)) {
    require_columns_for_all(record, all.size(), path);
    table.add_row(chosen_fields(record, all));
  }
  return table;
}

}  // namespace farlod
