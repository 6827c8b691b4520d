// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/result_layer.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include "farlod/error.hpp"
#include "farlod/points.hpp"
#include "inputs/point_reader.hpp"
#include "results/point_file.hpp"
#ifdef FARLOD_WITH_GDAL
#include "base/unread_file.hpp"
#include "results/gdal_files.hpp"
#endif

namespace farlod {
namespace {

static_assert(std::endian::native == std::endian::little, "layers are sent as little-endian floats");

void append(std::string& bytes, const float* values, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(float));
}

/// What the user named: a file, and what of it.
struct ResultRequest {
  std::filesystem::path file;
  std::string quantity;  ///< perhaps empty
};

/// The number of the column with this name, if there is one.
std::optional<std::size_t> column_of(const std::vector<std::string>& names, std::string_view name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

/// The column of the values: that which the request names, or the mean of it, else `usual`. Throws InputError, with the columns
/// that are there.
std::size_t column_of_values(const Attributes& table, const ResultRequest& request, std::string_view usual) {
  const std::string name = request.quantity.empty() ? std::string(usual) : request.quantity;
  if (const auto column = column_of(table.names(), name)) return *column;
  if (const auto column = column_of(table.names(), name + "_mean")) return *column;
  std::string names;
  for (const std::string& other : table.names()) names += (names.empty() ? "" : ", ") + other;
  throw InputError(request.file.string() + " has no field " + name + (names.empty() ? "." : ": it has " + names + ".") +
                   " Name one behind a colon: " + request.file.filename().string() + ":FIELD");
}

/// NaN of what is no number.
float number_or_nan(std::string_view text) {
  float value = NAN;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : NAN;
}

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

/// The values of a table that has a row for each surface of a building, which the columns `building` and `surface` name. None
/// where the file is no such table. Throws InputError.
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

ResultRequest parsed(const std::string& request) {
  const std::size_t colon = request.rfind(':');
  if (colon == std::string::npos || std::filesystem::exists(request)) return {request, ""};
  return {request.substr(0, colon), request.substr(colon + 1)};
}

/// Keeps each n-th, so that there are no more than `most`.
void thin(RequestedPoints& read, std::size_t most) {
  const std::size_t step = (read.points.size() + most - 1) / most;
  if (step <= 1) return;
  std::vector<std::size_t> kept;
  for (std::size_t n = 0; n < read.points.size(); n += step) kept.push_back(n);
  read.attributes = read.attributes.rows(kept);
  for (std::size_t k = 0; k < kept.size(); ++k) read.points[k] = std::move(read.points[kept[k]]);
  read.points.resize(kept.size());
}

/// Points without a height get that of a receiver of a map.
std::vector<double> heights_of(const std::vector<RequestedPoint>& points, const Package& package) {
  std::vector<double> x, y, z;
  for (const RequestedPoint& p : points) {
    x.push_back(p.x);
    y.push_back(p.y);
    z.push_back(p.z.value_or(NAN));
  }
  if (std::ranges::none_of(z, [](double height) { return std::isnan(height); })) return z;
  EvaluationSettings coarse;
  coarse.azimuths = 32;  // Only heights are asked for
  const PointAnswers answers = evaluate_points(package, {.x_m = x, .y_m = y, .z_m = z}, {}, coarse);
  return answers.height_m;
}

std::vector<std::array<float, 3>> places_of(const std::vector<RequestedPoint>& points, const Package& package,
                                            const ViewFrame& frame) {
  const std::vector<double> heights = heights_of(points, package);
  std::vector<std::array<float, 3>> places;
  places.reserve(points.size());
  for (std::size_t n = 0; n < points.size(); ++n) {
    const Point3d p = frame.local_from_projected({points[n].x, points[n].y, heights[n]});
    places.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  }
  return places;
}

/// "107 zero_area, left out: house_3. All points lie on a line."
std::string problem_text(const Attributes& attributes, std::size_t row) {
  const auto text = [&](std::string_view name) {
    const auto column = column_of(attributes.names(), name);
    return column ? std::string(attributes.value(row, *column)) : std::string();
  };
  std::string words = text("code") + " " + text("problem");
  if (const std::string effect = text("effect"); !effect.empty()) words += ", " + effect;
  if (const std::string place = text("place"); !place.empty()) words += ": " + place;
  if (const std::string detail = text("detail"); !detail.empty()) words += ". " + detail;
  return words;
}

/// The third of the three numbers of `position`, which GDAL writes as one text.
std::optional<double> height_of_problem(std::string_view position) {
  const std::size_t comma = position.rfind(',');
  if (comma == std::string_view::npos) return std::nullopt;
  position = position.substr(std::min(position.find_first_not_of(", ", comma), position.size()));
  double height = 0.0;
  const auto [end, error] = std::from_chars(position.data(), position.data() + position.size(), height);
  return error == std::errc() && end != position.data() ? std::optional(height) : std::nullopt;
}

void label_problems(RequestedPoints& read, ResultLayer& layer) {
  layer.form = ResultForm::problems;
  const auto position = column_of(read.attributes.names(), "position");
  for (std::size_t n = 0; n < read.points.size(); ++n) {
    layer.labels.push_back(problem_text(read.attributes, n));
    if (position && !read.points[n].z) read.points[n].z = height_of_problem(read.attributes.value(n, *position));
  }
}

ResultLayer layer_of_points(const ResultRequest& request, const Package& package, const ViewFrame& frame) {
  RequestedPoints read = read_points_in(package.description().crs_wkt, request.file);
  ResultLayer layer{.name = request.file.filename().string(), .count = read.points.size()};
  thin(read, most_points_of_layer);
  const bool has_fields_of_report = column_of(read.attributes.names(), "problem") && column_of(read.attributes.names(), "effect");
  // A report of a city without problems has no features, and so no fields
  const bool is_report = has_fields_of_report || (read.points.empty() && read.skipped_features == 0);
  if (read.points.empty() && !is_report)
    throw InputError(request.file.string() + " holds no points: none of its " + std::to_string(read.skipped_features) +
                     " features is one. Results are drawn as rasters or points.");
  if (is_report) {
    label_problems(read, layer);
  } else {
    const std::size_t column = column_of_values(read.attributes, request, "svf");
    layer.quantity = read.attributes.names()[column];
    for (std::size_t n = 0; n < read.points.size(); ++n) {
      layer.values.push_back(number_or_nan(read.attributes.value(n, column)));
      layer.labels.push_back(std::move(read.points[n].id));
    }
  }
  layer.places_local = places_of(read.points, package, frame);
  return layer;
}

#ifdef FARLOD_WITH_GDAL
ResultLayer layer_of_raster(const ResultRequest& request, const Package& package, const ViewFrame& frame) {
  RasterBand band =
      gdal_files().read_raster(request.file, {.band = request.quantity, .package_crs = package.description().crs_wkt});
  ResultLayer layer{.form = ResultForm::raster,
                    .name = request.file.filename().string(),
                    .quantity = std::move(band.name),
                    .count = band.pixels_of_file,
                    .width = band.width,
                    .height = band.height,
                    .local_from_pixel = band.projected_from_pixel};
  layer.local_from_pixel[0] -= frame.origin_projected.x;
  layer.local_from_pixel[3] -= frame.origin_projected.y;
  layer.values = std::move(band.values);
  return layer;
}
#endif

/// The least end of five round steps that is not below a value. From 0 to 1 go the colours of shares of the sky: it is not 1.
float top_of_scale(float highest) {
  constexpr double steps = 5.0, least = 1e-3;
  const double needed = std::max(static_cast<double>(highest), least);
  for (double power = std::pow(10.0, std::floor(std::log10(needed / steps)));; power *= 10.0)
    for (const double digit : {1.0, 2.0, 2.5, 5.0}) {
      const auto top = static_cast<float>(steps * digit * power);
      if (top >= static_cast<float>(needed) && top != 1.0F) return top;
    }
}

}  // namespace

std::string_view name_of(ResultForm form) {
  switch (form) {
    case ResultForm::raster:
      return "raster";
    case ResultForm::surfaces:
      return "surfaces";
    case ResultForm::points:
      return "points";
    case ResultForm::problems:
      break;
  }
  return "problems";
}

std::string_view ResultLayer::unit() const {
  // The first that fits
  constexpr std::array<std::array<std::string_view, 2>, 5> units{
      {{"irradiation_kwh", "kWh"}, {"irradiation", "kWh/m²"}, {"irradiance", "W/m²"}, {"sunlit_h", "h"}, {"horizon_", "°"}}};
  const auto* const found = std::ranges::find_if(units, [this](const auto& u) { return quantity.starts_with(u[0]); });
  return found == units.end() ? std::string_view() : (*found)[1];
}

std::array<float, 2> ResultLayer::range() const {
  float low = 0.0F, high = 1.0F;
  bool is_first = true;
  for (const float value : values) {
    if (std::isnan(value)) continue;
    low = is_first ? value : std::min(low, value);
    high = is_first ? value : std::max(high, value);
    is_first = false;
  }
  if (quantity.starts_with("irradia")) return {0.0F, top_of_scale(high)};
  return 0.0F <= low && high <= 1.0F ? std::array{0.0F, 1.0F} : std::array{low, high};
}

std::string ResultLayer::bytes() const {
  std::string bytes;
  if (form == ResultForm::raster) {
    append(bytes, values.data(), values.size());
    return bytes;
  }
  for (std::size_t n = 0; n < surfaces.size(); ++n) {
    const std::array<float, 3> row{static_cast<float>(surfaces[n][0]), static_cast<float>(surfaces[n][1]), values[n]};
    append(bytes, row.data(), row.size());
  }
  for (std::size_t n = 0; n < places_local.size(); ++n) {
    append(bytes, places_local[n].data(), places_local[n].size());
    const float value = values.empty() ? NAN : values[n];
    append(bytes, &value, 1);
  }
  return bytes;
}

ResultLayer read_result_layer(const std::string& request, const Package& package, const ViewFrame& frame) {
  const ResultRequest wanted = parsed(request);
  if (!std::filesystem::exists(wanted.file)) throw InputError(why_unread(wanted.file));
  if (wanted.file.extension() == ".json")
    throw InputError(wanted.file.string() +
                     " is no result that can be drawn. Problems are drawn from farlod-pack --report FILE.geojson.");
#ifdef FARLOD_WITH_GDAL
  // GDAL would take a table for a raster of scattered pixels
  if (!is_point_table(wanted.file) && !gdal_files().is_vector_file(wanted.file) && gdal_files().is_raster_file(wanted.file))
    return layer_of_raster(wanted, package, frame);
#endif
  if (std::optional<ResultLayer> surfaces = layer_of_surfaces(wanted)) return *std::move(surfaces);
  return layer_of_points(wanted, package, frame);
}

}  // namespace farlod
