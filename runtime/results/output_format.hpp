// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace farlod {

/// What a result can be written as.
enum class OutputFormat { geotiff, csv, png, esri_ascii };

/// The format that the ending of a file's name asks for, in capitals or not. None when there is no such ending, or this
/// build cannot write it (GeoTIFF needs GDAL).
[[nodiscard]] std::optional<OutputFormat> output_format_of(const std::filesystem::path& path);

/// The endings that this build knows, for messages: ".tif, .csv, .png, .asc".
[[nodiscard]] std::string known_output_endings();

}  // namespace farlod
