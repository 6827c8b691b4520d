// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace farlod::validation {

enum class Scale { linear, logarithmic };

/// A line of a plot. Points that a logarithmic axis cannot show are left out.
struct Series {
  std::string label;
  std::size_t colour = 0;
  bool is_dashed = false;
  std::vector<std::pair<double, double>> points;
};

struct Axis {
  std::string title;
  Scale scale = Scale::logarithmic;
};

struct Plot {
  std::string title;
  Axis x, y;
  std::vector<Series> series;
};

/// Throws std::runtime_error when the file cannot be written.
void write_svg(const Plot& plot, const std::filesystem::path& file);

}  // namespace farlod::validation
