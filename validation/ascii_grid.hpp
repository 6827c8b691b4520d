// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "farlod/point.hpp"

namespace farlod {

/// An ESRI ASCII grid.
struct AsciiGrid {
  std::size_t columns = 0, rows = 0;
  double step_m = 0.0;
  Point2d south_west_m;                       ///< corner of the outermost pixel
  std::vector<std::optional<double>> values;  ///< row by row from the north-west; empty where there is no data

  [[nodiscard]] std::optional<double> at(std::size_t column, std::size_t row) const { return values[row * columns + column]; }
};

/// Throws std::runtime_error naming the file when it is not there, lacks a line of its head or holds another number of values
/// than its head says.
[[nodiscard]] AsciiGrid read_ascii_grid(const std::filesystem::path& file);

}  // namespace farlod
