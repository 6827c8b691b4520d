// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/output_format.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace farlod {
namespace {

constexpr std::array endings{
#ifdef FARLOD_WITH_GDAL
    std::pair<std::string_view, OutputFormat>{".tif", OutputFormat::geotiff},
    std::pair<std::string_view, OutputFormat>{".tiff", OutputFormat::geotiff},
#endif
    std::pair<std::string_view, OutputFormat>{".csv", OutputFormat::csv},
    std::pair<std::string_view, OutputFormat>{".png", OutputFormat::png},
    std::pair<std::string_view, OutputFormat>{".asc", OutputFormat::esri_ascii},
};

}  // namespace

std::optional<OutputFormat> output_format_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return 'A' <= c && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  for (const auto& [known, format] : endings)
    if (ending == known) return format;
  return std::nullopt;
}

std::string known_output_endings() {
  std::string list;
  for (const auto& [known, format] : endings) list.append(list.empty() ? "" : ", ").append(known);
  return list;
}

}  // namespace farlod
