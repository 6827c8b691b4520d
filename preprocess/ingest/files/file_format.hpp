// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/lower_case.hpp"
#include "city/city_model.hpp"
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

/// The beginning of a text as ASCII, for the search of keywords: without byte order mark and leading blanks. Of UTF-16, only the
/// byte of each character that is not zero in ASCII is kept.
[[nodiscard]] std::string plain_beginning(std::string_view bytes);

/// The name of the root element of an XML text that begins so, without its prefix; empty when there is none.
[[nodiscard]] std::string_view xml_root(std::string_view text);

/// Whether a file that begins so is STL as text. Binary files may begin with the same word, but have other bytes before long.
[[nodiscard]] bool is_text_stl(std::string_view beginning);

/// What a file or a folder is to GDAL.
enum class MapKind {
  unknown,
  features,
  raster,
  placeless_raster,  ///< a raster without a place on the map, such as a photograph
  only_by_name       ///< its format may name other files, and the user did not name this one
};

/// By its content, and for some formats by its name. A file with features and a raster (GeoPackage, netCDF) counts as features,
/// unless `layer` is the name of a raster in it.
[[nodiscard]] MapKind map_kind_of(const InputFile& file, const std::optional<std::string>& layer = {});

/// Whether a file is a static driver of PALM: netCDF with `origin_x`, and `zt`, `buildings_2d` or `buildings_3d`.
[[nodiscard]] bool is_palm_driver(const InputFile& file);

/// Whether bytes begin like a zip archive, or like a gzip file.
[[nodiscard]] bool is_zip(std::string_view bytes);
[[nodiscard]] bool is_gzip(std::string_view bytes);

/// Which reader reads a file.
enum class FileFormat {
  citygml,
  cityjson,  ///< and CityJSONSeq
  obj,
  stl,
  ply,
  glb,
  features,      ///< a vector format in which GDAL may find footprints
  raster,        ///< a surface model
  palm_driver,   ///< a static driver of PALM
  only_by_name,  ///< a format whose files may name others, of a file that the user did not name
  archive,       ///< of a kind that is not opened, or inside another archive
  unknown,       ///< no format of a city
};

/// What begins a file, from which its format is told.
struct FileBeginning {
  const InputFile& file;
  std::string_view bytes;  ///< the first 64 KiB
  std::string_view text;   ///< as ASCII, without byte order mark and leading blanks
  bool is_whole = false;   ///< nothing follows
};

/// An ending of file names, in lower case with its dot.
struct FormatEnding {
  std::string_view text = {};
  bool is_shared = false;   ///< tables of features have it, too
  bool is_ignored = false;  ///< in a folder, the content decides whether such a file is a city
};

/// All that is known of a format that has a reader. Detection, the search of folders, messages and help read it here. How to add
/// a format: CONTRIBUTING.md.
struct InputFormat {
  std::string_view name = {};      ///< "CityGML"
  std::string_view versions = {};  ///< "1.0 to 3.0"
  std::array<FormatEnding, 16> endings = {};
  bool (*is_this)(const FileBeginning&) = nullptr;  ///< null: GDAL tells
  FormatAdvice advice = {};
  FileFormat format = FileFormat::unknown;
  bool is_piped = false;  ///< it is told by its beginning, and read once from there to its end
  bool is_mesh = false;   ///< polygons alone: --origin, --up and --ground-names are about it
};

/// In the order in which contents are compared with them.
[[nodiscard]] std::span<const InputFormat> input_formats();

/// The names of the formats that fulfil a condition, as "CityGML, CityJSON and OBJ". Tables of features are not among them.
template <class Condition>
[[nodiscard]] std::string names_where(const Condition& condition, std::string_view last = " and ", bool with_versions = false) {
  std::string names, next;
  for (const InputFormat& format : input_formats()) {
    if (format.is_this == nullptr || !condition(format)) continue;
    if (!next.empty()) names += (names.empty() ? "" : ", ") + next;
    next = std::string(format.name) + (with_versions && !format.versions.empty() ? " " + std::string(format.versions) : "");
  }
  return names.empty() ? next : names + std::string(last) + next;
}

/// Whether a file of this name is of a format of its own, although it is a zip archive inside: GDAL opens it.
[[nodiscard]] bool is_map_in_zip(std::string_view file_name);

[[nodiscard]] FormatAdvice advice_of(FileFormat format);

/// The name of a format in messages: "CityGML".
[[nodiscard]] std::string_view name_of(FileFormat format);

/// The format of a file by its content alone, also behind a byte order mark, blank lines and comments, and in UTF-16. The format
/// of a file that is too damaged to be recognized is `unknown`. `layer`: as for map_kind_of. Throws InputError when the file
/// cannot be read.
[[nodiscard]] FileFormat format_by_content(const InputFile& file, const std::optional<std::string>& layer = {});

/// The format that the name of a file suggests. The reader of that format reports what is wrong with an unknown content.
[[nodiscard]] FileFormat format_by_name(const InputFile& file);

/// Whether a name is usual for a format. Endings such as `.gml` and `.json` belong to several formats.
[[nodiscard]] bool name_allows(std::string_view file_name, FileFormat format);

/// Whether a file in a folder is a city by its name. The content of `.xml` and `.json` files decides about them instead.
[[nodiscard]] bool has_city_ending(std::string_view file_name);

}  // namespace farlod::ingest
