// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/result_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <utility>

#include "farlod/error.hpp"
#include "inputs/point_reader.hpp"
#include "results/point_file.hpp"
#ifdef FARLOD_WITH_GDAL
#include "results/gdal_files.hpp"
#endif

namespace farlod {
namespace {

/// Receivers on surfaces have places besides, and are drawn as points.
bool are_of_surfaces(const std::vector<std::string>& names) {
  return column_of(names, "building") && column_of(names, "surface") && !column_of(names, "x_m");
}

/// The table of surfaces in a file, if there is one.
std::optional<Attributes> read_table(const std::filesystem::path& file) {
  if (is_point_table(file)) {
    const std::vector<std::string> names = read_header_csv(file);
    if (column_of(names, "building") && !column_of(names, "surface") && !column_of(names, "x_m"))
      throw InputError(file.string() +
                       " has a row for each building. Buildings are coloured surface by surface: give the table " +
                       "FILE.surfaces.csv of farlod-svf --surfaces.");
    return are_of_surfaces(names) ? std::optional(read_table_csv(file)) : std::nullopt;
  }
#ifdef FARLOD_WITH_GDAL
  std::optional<Attributes> table = gdal_files().read_table(file, "surfaces");
  return table && are_of_surfaces(table->names()) ? std::move(table) : std::nullopt;
#else
  return std::nullopt;
#endif
}

std::uint32_t surface_number_in(std::string_view text, const ResultRequest& request) {
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc() && end == text.data() + text.size()) return number;
  throw InputError(request.file.string() + ": \"" + std::string(text) +
                   "\" is no number of a surface. Give the table as farlod-svf --surfaces writes it.");
}

}  // namespace

std::optional<std::size_t> column_of(const std::vector<std::string>& names, std::string_view name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

std::size_t column_of_values(const Attributes& table, const ResultRequest& request, std::string_view usual) {
  const std::string name = request.quantity.empty() ? std::string(usual) : request.quantity;
  if (const auto column = column_of(table.names(), name)) return *column;
  std::string names;
  for (const std::string& other : table.names()) names += (names.empty() ? "" : ", ") + other;
  throw InputError(request.file.string() + " has no field " + name + (names.empty() ? "." : ": it has " + names + ".") +
                   " Name one behind a colon: " + request.file.filename().string() + ":FIELD");
}

float number_or_nan(std::string_view text) {
  float value = NAN;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : NAN;
}

std::optional<ResultLayer> layer_of_surfaces(const ResultRequest& request) {
  const std::optional<Attributes> table = read_table(request.file);
  if (!table) return std::nullopt;
  const std::size_t building = *column_of(table->names(), "building"), surface = *column_of(table->names(), "surface");
  const std::size_t column = column_of_values(*table, request, "svf_mean");
  ResultLayer layer{.form = ResultForm::surfaces,
                    .name = request.file.filename().string(),
                    .quantity = table->names()[column],
                    .count = table->row_count()};
  std::map<std::string, std::uint32_t, std::less<>> numbers;
  for (std::size_t row = 0; row < table->row_count(); ++row) {
    const std::string id(table->value(row, building));
    const auto [found, is_new] = numbers.try_emplace(id, static_cast<std::uint32_t>(layer.labels.size()));
    if (is_new) layer.labels.push_back(id);
    layer.surfaces.push_back({found->second, surface_number_in(table->value(row, surface), request)});
    layer.values.push_back(number_or_nan(table->value(row, column)));
  }
  return layer;
}

}  // namespace farlod
