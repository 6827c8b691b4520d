// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "city/source.hpp"
#include "farlod/problem.hpp"
#include "ingest/files/input_file.hpp"

namespace farlod::ingest {

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
///   (4) a raster is found if it is itself an input, or the only usable file of a folder or archive
/// A folder that is one data set, such as `.gdb`, is one file. Archives within archives are not opened. Throws InputError when an
/// input does not exist, and when nothing is found. An archive or a folder that cannot be opened is reported as unusable_file if
/// other inputs can be read.
[[nodiscard]] FoundInputs find_input_files(std::span<const std::filesystem::path> inputs, Report& report);

}  // namespace farlod::ingest
