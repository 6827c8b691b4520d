// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "validation/raster_comparison.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

namespace farlod {
namespace {

using Head = std::map<std::string, double>;

std::string lower_case(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return word;
}

Head read_head(std::istream& text) {
  Head head;
  while (text >> std::ws && std::isalpha(text.peek())) {
    std::string key;
    double value = 0.0;
    if (text >> key >> value) head[lower_case(key)] = value;
  }
  return head;
}

std::vector<std::optional<double>> read_values(std::istream& text, double nodata) {
  std::vector<std::optional<double>> values;
  for (double value = 0.0; text >> value;) values.push_back(value == nodata ? std::nullopt : std::optional(value));
  return values;
}

}  // namespace

AsciiGrid read_ascii_grid(const std::filesystem::path& file) {
  std::ifstream text(file);
  if (!text) throw std::runtime_error(file.string() + " cannot be read");
  Head head = read_head(text);
  for (const char* key : {"ncols", "nrows", "xllcorner", "yllcorner", "cellsize", "nodata_value"})
    if (!head.contains(key)) throw std::runtime_error(file.string() + ": its head has no " + key);
  AsciiGrid grid{static_cast<std::size_t>(head["ncols"]),
                 static_cast<std::size_t>(head["nrows"]),
                 head["cellsize"],
                 {head["xllcorner"], head["yllcorner"]},
                 read_values(text, head["nodata_value"])};
  if (grid.values.size() != grid.columns * grid.rows)
    throw std::runtime_error(file.string() + ": " + std::to_string(grid.values.size()) + " values, where its head says " +
                             std::to_string(grid.columns * grid.rows));
  return grid;
}

namespace {

/// Another grid whose pixels lie on those of a reference, looked up by the reference's columns and rows.
class GridOnReference {
 public:
  GridOnReference(const AsciiGrid& grid, const AsciiGrid& reference) : grid_(grid) {
    const Point2d low = (1.0 / reference.step_m) * (reference.south_west_m - grid.south_west_m);
    const double north_rows = static_cast<double>(grid.rows) - low.y - static_cast<double>(reference.rows);
    if (grid.step_m != reference.step_m || low.x != std::round(low.x) || low.y != std::round(low.y))
      throw std::runtime_error("the pixels of the rasters do not lie one on the other");
    first_column_ = static_cast<std::ptrdiff_t>(low.x);
    first_row_ = static_cast<std::ptrdiff_t>(north_rows);
  }

  [[nodiscard]] std::optional<double> at(std::size_t reference_column, std::size_t reference_row) const {
    const std::ptrdiff_t column = static_cast<std::ptrdiff_t>(reference_column) + first_column_;
    const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(reference_row) + first_row_;
    if (column < 0 || row < 0 || column >= static_cast<std::ptrdiff_t>(grid_.columns) ||
        row >= static_cast<std::ptrdiff_t>(grid_.rows))
      return std::nullopt;
    return grid_.at(static_cast<std::size_t>(column), static_cast<std::size_t>(row));
  }

 private:
  const AsciiGrid& grid_;
  std::ptrdiff_t first_column_ = 0, first_row_ = 0;
};

struct Pair {
  double value, reference;
};

std::vector<Pair> pairs_of(const AsciiGrid& raster, const AsciiGrid& reference, const ComparedPixels& pixels) {
  const GridOnReference values(raster, reference), heights(pixels.height ? *pixels.height : reference, reference);
  std::vector<Pair> pairs;
  for (std::size_t row = pixels.rim; row + pixels.rim < reference.rows; ++row)
    for (std::size_t column = pixels.rim; column + pixels.rim < reference.columns; ++column) {
      const auto value = values.at(column, row), expected = reference.at(column, row);
      const auto height_m = pixels.height ? heights.at(column, row) : pixels.low_m;
      const bool wanted = height_m && *height_m >= pixels.low_m && *height_m < pixels.high_m;
      if (wanted && value && expected) pairs.push_back({*value, *expected});
    }
  return pairs;
}

double mean(const std::vector<Pair>& pairs, double Pair::*member) {
  double sum = 0.0;
  for (const Pair& pair : pairs) sum += pair.*member;
  return sum / static_cast<double>(pairs.size());
}

double pearson(const std::vector<Pair>& pairs) {
  const double mean_value = mean(pairs, &Pair::value), mean_reference = mean(pairs, &Pair::reference);
  double both = 0.0, values = 0.0, references = 0.0;
  for (const Pair& pair : pairs) {
    const double value = pair.value - mean_value, reference = pair.reference - mean_reference;
    both += value * reference;
    values += value * value;
    references += reference * reference;
  }
  return values > 0.0 && references > 0.0 ? both / std::sqrt(values * references) : 0.0;
}

}  // namespace

RasterDifference compare_rasters(const AsciiGrid& raster, const AsciiGrid& reference, const ComparedPixels& pixels) {
  const std::vector<Pair> pairs = pairs_of(raster, reference, pixels);
  if (pairs.empty()) return {};
  const double bias = mean(pairs, &Pair::value) - mean(pairs, &Pair::reference);
  double squares = 0.0;
  std::vector<double> sizes;
  for (const auto& [value, expected] : pairs) {
    squares += (value - expected) * (value - expected);
    sizes.push_back(std::abs(value - expected));
  }
  std::sort(sizes.begin(), sizes.end());
  const std::size_t p99 = (99 * sizes.size() + 99) / 100 - 1;
  return {pairs.size(), bias, pearson(pairs), std::sqrt(squares / static_cast<double>(pairs.size())), sizes[p99], sizes.back()};
}

}  // namespace farlod
