// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/nearest_word.hpp"
#include "results/output_format.hpp"

namespace farlod {

/// "choose .csv", or "choose one of .tif, .tiff"; says so when this build has no such format.
template <class Condition>
[[nodiscard]] std::string advice(const Condition& condition) {
  const std::string endings = endings_where(condition);
  if (endings.empty()) return "this farlod-svf was built without such a format";
  return (endings.find(',') == std::string::npos ? "choose " : "choose one of ") + endings;
}

/// "; did you mean .tif?", where the ending of a name is nearly one of a format that fulfils a condition.
template <class Condition>
[[nodiscard]] std::string nearest_ending(const std::filesystem::path& name, const Condition& condition) {
  std::vector<std::string> endings;
  for (const OutputFormat& format : output_formats()) {
    if (!condition(format)) continue;
    for (const std::string_view ending : format.endings)
      if (!ending.empty()) endings.emplace_back(ending);
  }
  return did_you_mean(name.extension().string(), endings);
}

}  // namespace farlod
