// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>

#include "base/lower_case.hpp"
#include "ingest/files/input_file.hpp"

namespace farlod::ingest {

/// Whether a file name in any case has one of the endings, which are in lower case with their dots.
[[nodiscard]] inline bool ends_with_any(std::string_view name, std::initializer_list<std::string_view> endings) {
  const std::string lower = lower_case(name);
  return std::any_of(endings.begin(), endings.end(), [&](std::string_view ending) { return lower.ends_with(ending); });
}

/// Whether a file is CityJSON or CityJSONSeq, by the members of its first JSON object. Reads no farther than needed. A file that
/// is not JSON up to there is not CityJSON.
[[nodiscard]] bool is_cityjson(const InputFile& file);

/// Whether a file is `metadata.json` of CityJSON without objects: the header of CityJSONFeatures in other files.
[[nodiscard]] bool is_header_of_features(const InputFile& file);

/// What a file or a folder is to GDAL.
enum class MapKind {
  unknown,
  features,
  raster,
  only_by_name  ///< its format may name other files, and the user did not name this one
};

/// By its content, and for some formats by its name. A file with features and a raster counts as features. A raster without a
/// place on the map, such as a photograph, is `unknown`.
[[nodiscard]] MapKind map_kind_of(const InputFile& file);

/// Whether bytes begin like a zip archive, or like a gzip file.
[[nodiscard]] bool is_zip(std::string_view bytes);
[[nodiscard]] bool is_gzip(std::string_view bytes);

/// Which reader reads a file.
enum class FileFormat {
  citygml,
  cityjson,  ///< and CityJSONSeq
  obj,
  features,      ///< a vector format in which GDAL may find footprints
  raster,        ///< a surface model
  only_by_name,  ///< a format whose files may name others, of a file that the user did not name
  archive,       ///< of a kind that is not opened, or inside another archive
  unknown,       ///< no format of a city
};

/// Whether a file of this name is of a format of its own, although it is a zip archive inside: GDAL opens it.
[[nodiscard]] bool is_map_in_zip(std::string_view file_name);

/// The name of a format in messages: "CityGML".
[[nodiscard]] std::string_view name_of(FileFormat format);

/// The format of a file by its content alone, also behind a byte order mark, blank lines and comments, and in UTF-16. The format
/// of a file that is too damaged to be recognized is `unknown`. Throws InputError when the file cannot be read.
[[nodiscard]] FileFormat format_by_content(const InputFile& file);

/// The format that the name of a file suggests. The reader of that format reports what is wrong with an unknown content.
[[nodiscard]] FileFormat format_by_name(const InputFile& file);

/// Whether a name is usual for a format. Endings such as `.gml` and `.json` belong to several formats.
[[nodiscard]] bool name_allows(std::string_view file_name, FileFormat format);

}  // namespace farlod::ingest
