// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/estimate_text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace farlod {
namespace {

/// Two digits, the rest zeros.
double roughly(double value) {
  if (value <= 0.0) return 0.0;
  const double unit = std::pow(10.0, std::max(0.0, std::floor(std::log10(value)) - 1.0));
  return std::max(1.0, std::round(value / unit) * unit);
}

std::string with_commas(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t n = text.size(); n > 3; n -= 3) text.insert(n - 3, ",");
  return text;
}

std::string duration(double seconds) {
  if (seconds < 100.0) return fmt::format("{:.0f} s", roughly(seconds));
  if (seconds < 6000.0) return fmt::format("{:.0f} min", roughly(seconds / 60.0));
  return fmt::format("{:.0f} h", roughly(seconds / 3600.0));
}

std::string size(double mib) {
  return mib < 10240.0 ? fmt::format("{:.0f} MiB", roughly(mib)) : fmt::format("{:.0f} GiB", roughly(mib / 1024.0));
}

}  // namespace

std::string estimate_text(const PackEstimate& e) {
  const std::string far_maps = e.far_maps < e.cells ? ", far maps to make for " + with_commas(e.far_maps) : "";
  return fmt::format("{} cells{}: about {} from here on, {} of memory, and a package of {}", with_commas(e.cells), far_maps,
                     duration(e.seconds), size(e.memory_mib), size(e.package_mib));
}

}  // namespace farlod
