// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "points/point_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <span>
#include <string_view>

#include "contract/point_columns.hpp"
#include "points/point_reader_records.hpp"

namespace farlod {
namespace {

using namespace point_columns;

/// Which column holds what.
struct Columns {
  std::optional<std::size_t> id, x, y, z;
};

[[noreturn]] void refuse(const std::filesystem::path& path, std::size_t line, const std::string& what) {
  throw PointsError(path.string() + ":" + std::to_string(line) + ": " + what);
}

std::optional<double> number_in(std::string_view field) {
  if (field.starts_with('+')) field.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return 'A' <= c && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return text;
}

bool is_header(const TextRecord& record) {
  return std::none_of(record.fields.begin(), record.fields.end(), [](const std::string& f) { return number_in(f).has_value(); });
}

/// The column that carries one of the names. Two such columns would leave open which one is meant.
std::optional<std::size_t> find_column(const TextRecord& header, std::span<const std::string_view> names,
                                       const std::filesystem::path& path) {
  std::optional<std::size_t> found;
  for (std::size_t n = 0; n < header.fields.size(); ++n) {
    if (std::find(names.begin(), names.end(), lower_case(header.fields[n])) == names.end()) continue;
    if (found)
      refuse(path, header.line,
             "the columns \"" + header.fields[*found] + "\" and \"" + header.fields[n] +
                 "\" mean the same; rename the one that does not count");
    found = n;
  }
  return found;
}

Columns columns_of_header(const TextRecord& header, const std::filesystem::path& path) {
  Columns columns{std::nullopt, find_column(header, x_names, path), find_column(header, y_names, path),
                  find_column(header, z_names, path)};
  if (!columns.x || !columns.y)
    refuse(path, header.line, "no column is named x and y (or easting and northing, or lon and lat); name them in the first row");
  for (std::size_t n = 0; n < id_names.size() && !columns.id; ++n)
    columns.id = find_column(header, std::span(id_names).subspan(n, 1), path);
  return columns;
}

Columns columns_without_header(const TextRecord& first, const std::filesystem::path& path) {
  if (first.fields.size() != 2 && first.fields.size() != 3)
    refuse(path, first.line,
           "a table without a header row has the columns x, y and perhaps z; name the columns in the first row");
  return {std::nullopt, 0, 1, first.fields.size() == 3 ? std::optional<std::size_t>(2) : std::nullopt};
}

double coordinate(const TextRecord& record, std::size_t column, const char* name, const std::filesystem::path& path) {
  if (column >= record.fields.size())
    refuse(path, record.line, std::string("the row ends before ") + name + "; give each row as many fields as the first");
  const std::optional<double> value = number_in(record.fields[column]);
  if (!value) refuse(path, record.line, "\"" + record.fields[column] + "\" is not a number (" + name + "); write it like 1234.5");
  return *value;
}

RequestedPoint point_of(const TextRecord& record, const Columns& columns, const std::filesystem::path& path) {
  RequestedPoint point;
  point.x = coordinate(record, *columns.x, "x", path);
  point.y = coordinate(record, *columns.y, "y", path);
  const bool has_z = columns.z && *columns.z < record.fields.size() && !record.fields[*columns.z].empty();
  if (has_z) point.z = coordinate(record, *columns.z, "z", path);
  if (columns.id && *columns.id < record.fields.size()) point.id = record.fields[*columns.id];
  return point;
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  // A folder opens like a file, and fails only when it is read
  if (!stream || std::filesystem::is_directory(path))
    throw PointsError(path.string() + ": the file cannot be read; see that it exists and that you may read it");
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

std::vector<RequestedPoint> read_points_csv(const std::filesystem::path& path) {
  const std::vector<TextRecord> records = split_records(text_of(path));
  if (records.empty())
    throw PointsError(path.string() + ": the file holds no points; write one in each row, as x,y or with a header row");
  const bool header = is_header(records.front());
  const Columns columns = header ? columns_of_header(records.front(), path) : columns_without_header(records.front(), path);
  std::vector<RequestedPoint> points;
  points.reserve(records.size());
  for (const TextRecord& record : std::span(records).subspan(header ? 1 : 0)) {
    points.push_back(point_of(record, columns, path));
    if (points.back().id.empty()) points.back().id = std::to_string(points.size());
  }
  if (points.empty()) throw PointsError(path.string() + ": the file has a header row but no points; add one in each row");
  return points;
}

}  // namespace farlod
