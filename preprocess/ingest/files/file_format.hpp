// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "ingest/files/input_file.hpp"

namespace farlod::ingest {

/// Which reader a file is for.
enum class FileFormat {
  citygml,
  cityjson,  ///< and CityJSONSeq
  obj,
  features,  ///< what GDAL may find footprints in
  raster,    ///< a surface model
  archive,   ///< of a kind that is not opened, or within another
  unknown,   ///< no format of a city
};

/// Whether a file of this name is of a format of its own, although it is a zip archive inside: GDAL opens it.
[[nodiscard]] bool is_map_in_zip(std::string_view file_name);

/// For messages: "CityGML".
[[nodiscard]] std::string_view name_of(FileFormat format);

/// What a file is by its content, whatever its name says. A byte order mark, blank lines, comments and UTF-16 do not hide it.
/// What is damaged so much that only its name tells what it was meant to be is `unknown`. Throws InputError when it cannot be
/// read.
[[nodiscard]] FileFormat format_by_content(const InputFile& file);

/// What a file of a content that is not known was meant to be, so that the reader of that format can say what is wrong with it.
[[nodiscard]] FileFormat format_by_name(const InputFile& file);

/// Whether a file of this name may be of this format without surprise. Endings like `.gml` and `.json` belong to several.
[[nodiscard]] bool name_allows(std::string_view file_name, FileFormat format);

}  // namespace farlod::ingest
