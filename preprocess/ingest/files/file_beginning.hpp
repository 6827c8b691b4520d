// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace farlod::ingest {

/// The beginning of a text as ASCII, for the search of keywords: without byte order mark and leading blanks. Of UTF-16, only the
/// byte of each character that is not zero in ASCII is kept.
[[nodiscard]] std::string plain_beginning(std::string_view bytes);

/// The start tag of the root of an XML text that begins here: "core:CityModel xmlns=…". Empty when there is none.
[[nodiscard]] std::string_view root_tag(std::string_view xml);

/// Whether the root element is that of CityGML, or a feature collection (WFS) that declares the namespace of CityGML.
[[nodiscard]] bool is_citygml_root(std::string_view root_tag);

/// Whether a text consists of statements of an OBJ file. `is_whole`: the last line is not cut off.
[[nodiscard]] bool is_obj_text(std::string_view text, bool is_whole);

/// Whether bytes begin like an archive or a packed file: zip, gzip, 7z, rar, bzip2, xz, zstd or tar.
[[nodiscard]] bool is_archive(std::string_view bytes);

/// Whether bytes begin like a zip archive, or like a gzip file.
[[nodiscard]] bool is_zip(std::string_view bytes);
[[nodiscard]] bool is_gzip(std::string_view bytes);

}  // namespace farlod::ingest
