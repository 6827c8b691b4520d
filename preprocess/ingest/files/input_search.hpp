// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "city/city_model.hpp"
#include "farlod/problem.hpp"
#include "ingest/files/input_file.hpp"

namespace farlod::ingest {

/// An entry of the central directory of a zip archive.
struct ZipListing {
  std::string name;        ///< printable
  bool is_locked = false;  ///< encrypted with a password
};

/// Reads the central directory alone. Empty when there is none, or when it has more than 256 MiB.
[[nodiscard]] std::vector<ZipListing> zip_listings(const std::filesystem::path& archive);

/// A name that is safe to show: control characters become "?".
[[nodiscard]] std::string printable(std::string_view name);

/// Whether a name leads out of its archive: it is absolute, or has a drive or `..`.
[[nodiscard]] bool leads_outside(std::string_view name);

/// The files in a zip archive, ordered by name. Nothing is unpacked and nothing is written. Names that lead out of the archive
/// (leads_outside) are left out. Links are not followed. Throws InputError when the archive cannot be read, holds more files than
/// a city has, or declares to unpack to more than most_unpacked_bytes.
[[nodiscard]] std::vector<InputFile> files_in_zip(const std::filesystem::path& archive);

/// The files that a user's inputs lead to.
struct FoundInputs {
  std::vector<InputFile> files;           ///< cities and footprints, in the order of the inputs; within a folder, by name
  std::vector<InputFile> surface_models;  ///< rasters, which are read like a terrain
  SkippedFeatures skipped;                ///< files in folders and archives that have no format of a city, counted by ending
};

/// Searches folders, recursively, and zip and gzip archives.
///   (1) a file is found once, even if several inputs lead to it
///   (2) a file that is itself an input is always found; a file in a folder or archive is found if it is a city by its ending or,
///       where the ending does not decide, by its content
///   (3) textures, code lists, metadata and other companions of city files are neither found nor counted as skipped
///   (4) a raster is found if it is itself an input, or the only usable file of a folder or archive; a file that holds features
///       and rasters (GeoPackage) is one where `layer` is the name of a raster in it
/// A folder that is one data set, such as `.gdb`, is one file. Archives within archives are not opened. Throws InputError when an
/// input does not exist, and when nothing is found. An archive or a folder that cannot be opened is reported as unusable_file if
/// other inputs can be read.
[[nodiscard]] FoundInputs find_input_files(std::span<const std::filesystem::path> inputs, Report& report,
                                           const std::optional<std::string>& layer = {});

}  // namespace farlod::ingest
