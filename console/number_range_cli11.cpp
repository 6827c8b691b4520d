// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "console/number_range.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <string>

namespace farlod {

CLI::Validator between(double low, double high) {
  const auto complaint = [low, high](const std::string& text) {
    double value = 0.0;
    const bool fits = CLI::detail::lexical_cast(text, value) && low <= value && value <= high;
    return fits ? std::string() : fmt::format("{} is not a number from {} to {}", text, low, high);
  };
  return {complaint, fmt::format("[{}, {}]", low, high), "between"};
}

}  // namespace farlod
