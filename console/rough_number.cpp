// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "console/rough_number.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace farlod {

double rough_number(double value) {
  if (value <= 0.0) return 0.0;
  const double unit = std::pow(10.0, std::max(0.0, std::floor(std::log10(value)) - 1.0));
  return std::max(1.0, std::round(value / unit) * unit);
}

std::string with_commas(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t n = text.size(); n > 3; n -= 3) text.insert(n - 3, ",");
  return text;
}

std::string rough_duration(double seconds) {
  if (seconds < 100.0) return fmt::format("{:.0f} s", rough_number(seconds));
  if (seconds < 6000.0) return fmt::format("{:.0f} min", rough_number(seconds / 60.0));
  return fmt::format("{:.0f} h", rough_number(seconds / 3600.0));
}

std::string rough_size(double mib) {
  return mib < 10240.0 ? fmt::format("{:.0f} MiB", rough_number(mib)) : fmt::format("{:.0f} GiB", rough_number(mib / 1024.0));
}

}  // namespace farlod
