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

#include "base/lower_case.hpp"
#include "base/point_columns.hpp"
#include "base/unread_file.hpp"
#include "inputs/text_records.hpp"

namespace farlod {
namespace {

std::string_view first_row(std::string_view text) {
  const std::size_t begin = std::min(text.find_first_not_of("\r\n"), text.size());
  return text.substr(begin, text.find('\n', begin) - begin);
}

/// The separator is that of the first row. A byte order mark does no harm.
std::vector<TextRecord> records_in(std::string_view text) {
  text = without_byte_order_mark(text);
  return split_records(text, separator_of(first_row(text)));
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
    refuse_header("no column is named x and y (or easting and northing, or lon and lat), of " +
                  point_columns::listed(header.fields) + "; name them in the first row");
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

/// The names of columns are those of the header, if there is one.
double coordinate(const TextRecord& record, std::size_t column, const std::string& name, const std::filesystem::path& path) {
  if (column >= record.fields.size())
    refuse(path, record.line, "the row ends before " + name + "; give each row as many fields as the first");
  const std::optional<double> value = number_in(record.fields[column]);
  if (record.fields[column].empty()) refuse(path, record.line, name + " is empty; write a number like 1234.5");
  if (!value) refuse(path, record.line, "\"" + record.fields[column] + "\" is not a number (" + name + "); write it like 1234.5");
  return *value;
}

/// None where the table has no such column, or the row nothing in it.
std::optional<double> number_if_any(const TextRecord& record, std::optional<std::size_t> column, const std::string& name,
                                    const std::filesystem::path& path) {
  if (!column || *column >= record.fields.size() || record.fields[*column].empty()) return std::nullopt;
  return coordinate(record, *column, name, path);
}

RequestedPoint point_of(const TextRecord& record, const PointFields& columns, const TextRecord& header,
                        const std::filesystem::path& path) {
  const auto name_of = [&](std::size_t column, const char* without_header) {
    return column < header.fields.size() ? header.fields[column] : std::string(without_header);
  };
  RequestedPoint point;
  point.x = coordinate(record, *columns.x, name_of(*columns.x, "x"), path);
  point.y = coordinate(record, *columns.y, name_of(*columns.y, "y"), path);
  const auto refuse_row = [&](const std::string& what) { refuse(path, record.line, what); };
  point.z = number_if_any(record, columns.z, "z", path);
  point.above_ground_m = above_ground_of(number_if_any(record, columns.above_ground, "height above ground", path), refuse_row);
  point.normal = normal_of(number_if_any(record, columns.azimuth, "azimuth", path),
                           number_if_any(record, columns.tilt, "tilt", path), refuse_row);
  if (columns.id && *columns.id < record.fields.size()) point.id = record.fields[*columns.id];
  return point;
}

/// A row that cannot be read keeps its place in the table, so that rows of answers are those of the points.
RequestedPoint point_without_place(const TextRecord& record, const PointFields& columns) {
  RequestedPoint point;
  point.x = point.y = std::nan("");
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
  if (!stream || std::filesystem::is_directory(path)) throw PointsError(why_unread(path));
  return stream;
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream stream = open_table(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Rows that cannot be read. A few have no answers; more are a mistake in the whole table.
class UnreadRows {
 public:
  /// The point that `read` returns; one without a place where it throws.
  template <class Read>
  [[nodiscard]] RequestedPoint point_or_none(const TextRecord& row, const PointFields& columns, const Read& read) {
    try {
      return read();
    } catch (const PointsError& error) {
      if (!first_) first_ = error;
      if (++count_ <= lines_named) lines_ += (count_ > 1 ? ", " : "") + std::to_string(row.line);
      return point_without_place(row, columns);
    }
  }
  /// Throws the first error where more than a tenth of the rows are unread.
  void tell(std::size_t rows, RequestedPoints& points) const {
    if (!first_) return;
    const std::string lines = count_ == 1 ? "" : " (lines " + lines_ + (count_ > lines_named ? ", …)" : ")");
    if (10 * count_ > rows)
      throw PointsError(std::string(first_->what()) + "; rows that cannot be read: " + std::to_string(count_) + " of " +
                        std::to_string(rows) + lines +
                        "; mend them, or leave them out: up to a tenth of the rows are left out without");
    points.skipped_features = count_;
    points.notes.push_back(std::string(first_->what()) + ". " + std::to_string(count_) + " of " + std::to_string(rows) +
                           " rows cannot be read and " + (count_ == 1 ? "has" : "have") + " no answer" + lines + ".");
  }

 private:
  static constexpr std::size_t lines_named = 10;
  std::optional<PointsError> first_;
  std::size_t count_ = 0;
  std::string lines_;
};

/// Throws PointsError for a page, a document or an archive: what would be said of its columns leads nowhere.
std::vector<TextRecord> records_of_points(const std::filesystem::path& path) {
  constexpr std::size_t bytes_of_beginning = 512;
  const std::string text = text_of(path);
  const std::string_view beginning = std::string_view(text).substr(0, bytes_of_beginning);
  if (beginning.starts_with('<') || beginning.starts_with("%PDF") || beginning.find('\0') != beginning.npos)
    throw PointsError(path.string() + " is no table: give points as CSV with columns x and y, or as a vector file.");
  return records_in(text);
}

/// Longitudes and latitudes, unless most are none: in some rows they may be exchanged.
bool may_be_lon_lat(const std::vector<RequestedPoint>& points) {
  const auto is_one = [](const RequestedPoint& p) { return std::abs(p.x) <= 360.0 && std::abs(p.y) <= 90.0; };
  const auto placed = std::ranges::count_if(points, &RequestedPoint::has_place);
  return 2 * std::ranges::count_if(points, is_one) > placed;
}

/// What names of columns may also mean: `height_m` is taken as the z that it has always been, `height` for neither.
void tell_doubtful_heights(const TextRecord& header, const PointFields& columns, const std::filesystem::path& path,
                           RequestedPoints& points) {
  for (const std::size_t n : columns.attributes)
    if (lower_case(header.fields[n]) == "height" && !columns.z && !columns.above_ground)
      points.notes.push_back(path.string() + ": the column \"" + header.fields[n] +
                             "\" places no point: name it height_above_ground_m for heights above the ground, or z for "
                             "heights above sea level.");
  if (columns.z && lower_case(header.fields[*columns.z]) == "height_m") points.doubtful_z = header.fields[*columns.z];
}

/// The header is empty where the table has none.
void add_rows(std::span<const TextRecord> rows, const TextRecord& header, const PointFields& columns,
              const std::filesystem::path& path, RequestedPoints& result) {
  UnreadRows unread;
  for (std::size_t n = 0; n < rows.size(); ++n) {
    RequestedPoint point = unread.point_or_none(rows[n], columns, [&] {
      if (!header.fields.empty()) require_columns_for_all(rows[n], header.fields.size(), path);
      return point_of(rows[n], columns, header, path);
    });
    if (point.id.empty()) point.id = std::to_string(n + 1);
    result.points.push_back(std::move(point));
    result.attributes.add_row(chosen_fields(rows[n], columns.attributes));
  }
  unread.tell(rows.size(), result);
}

}  // namespace

RequestedPoints read_points_csv(const std::filesystem::path& path) {
  const std::vector<TextRecord> records = records_of_points(path);
  if (records.empty())
    throw PointsError(path.string() + ": the file holds no points; write one in each row, as x,y or with a header row");
  const bool header = is_header(records.front());
  const PointFields columns = header ? columns_of_header(records.front(), path) : columns_without_header(records.front(), path);
  RequestedPoints result;
  result.has_normals = columns.tilt.has_value();
  if (header) result.attributes = attributes_of_header(records.front(), columns.attributes);
  std::vector<RequestedPoint>& points = result.points;
  points.reserve(records.size());
  const TextRecord header_row = header ? records.front() : TextRecord();
  add_rows(std::span(records).subspan(header ? 1 : 0), header_row, columns, path, result);
  if (header) tell_doubtful_heights(header_row, columns, path, result);
  if (points.empty()) throw PointsError(path.string() + ": the file has a header row but no points; add one in each row");
  if (header && point_columns::are_degrees(records.front().fields[*columns.x]) && may_be_lon_lat(points))
    result.crs_wkt = "OGC:CRS84";
  return result;
}

std::vector<std::string> read_header_csv(const std::filesystem::path& path) {
  std::ifstream stream = open_table(path);
  std::string line;
  std::getline(stream, line);
  const std::vector<TextRecord> records = records_in(line);
  return records.empty() || !is_header(records.front()) ? std::vector<std::string>() : records.front().fields;
}

Attributes read_table_csv(const std::filesystem::path& path) {
  const std::vector<TextRecord> records = records_in(text_of(path));
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
