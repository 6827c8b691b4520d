// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "city/problem.hpp"
#include "city/source.hpp"
#include "ingest/files/input_file.hpp"

namespace farlod::ingest {

/// What lies behind the names that a user gave.
struct FoundInputs {
  std::vector<InputFile> files;           ///< cities and footprints, in the order of the names, and of their own within a folder
  std::vector<InputFile> surface_models;  ///< rasters, which are read as a terrain is
  SkippedFeatures skipped;                ///< files of folders and archives that are of no format of a city, by their endings
};

/// Looks into folders, with all that is below them, and into zip and gzip archives. For every file:
///   (1) it comes once, however often and by whatever names it was given
///   (2) what was named itself always comes; what was met is a city file by its ending or, where that is open, by its content
///   (3) textures, code lists, metadata and other companions of city files are silently none
///   (4) a raster comes when it was named itself, or is all that a folder or an archive holds
/// Folders that are one data set, such as `.gdb`, stay one input. Archives within archives are not opened.
/// Throws InputError for a name that leads nowhere, and when there is nothing to be read at all. An archive or a folder that
/// cannot be opened beside others that can is reported as unusable_file.
[[nodiscard]] FoundInputs find_input_files(std::span<const std::filesystem::path> inputs, Report& report);

}  // namespace farlod::ingest
