// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "ingest/files/input_file.hpp"

namespace farlod::ingest {

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
