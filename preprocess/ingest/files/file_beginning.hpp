// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace farlod::ingest {

/// The beginning of a text in plain letters: without byte order mark and leading blanks, UTF-16 with every other byte gone (what
/// is looked for is ASCII).
[[nodiscard]] std::string plain_beginning(std::string_view bytes);

/// The start tag of the root of an XML text that begins here: "core:CityModel xmlns=…". Empty when it does not come.
[[nodiscard]] std::string_view root_tag(std::string_view xml);

/// Whether the root is CityGML's, or one that is made for features (WFS) and names the namespace of CityGML.
[[nodiscard]] bool is_citygml_root(std::string_view root_tag);

/// Whether a text is made of statements of an OBJ file. `is_whole`: no line is cut off at the end.
[[nodiscard]] bool is_obj_text(std::string_view text, bool is_whole);

/// Whether bytes begin like an archive or a packed file: zip, gzip, 7z, rar, bzip2, xz, zstd or tar.
[[nodiscard]] bool is_archive(std::string_view bytes);

/// Whether bytes begin like a zip archive, or like a gzip file.
[[nodiscard]] bool is_zip(std::string_view bytes);
[[nodiscard]] bool is_gzip(std::string_view bytes);

}  // namespace farlod::ingest
