// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/trees/tree_reader.hpp"

#include <system_error>

#include "farlod/error.hpp"
#include "ingest/files/file_format.hpp"
#include "ingest/files/input_file.hpp"
#include "ingest/trees/city_trees.hpp"
#include "ingest/trees/feature_trees.hpp"

namespace farlod::ingest {

SourceTrees read_trees(const std::filesystem::path& file, const TreeSettings& settings, Report& report,
                       const std::stop_token& stop) {
  std::error_code unread;
  if (!std::filesystem::exists(file, unread)) throw InputError(file.string() + " does not exist. Check the path.");
  const bool is_file = std::filesystem::is_regular_file(file, unread);
  if (is_file && std::filesystem::file_size(file, unread) == 0)
    throw InputError(file.string() + " is empty: 0 bytes. Was the download cut short?");
  const FileFormat format = is_file ? format_by_content(InputFile(file)) : FileFormat::features;
  if (format == FileFormat::citygml) return read_citygml_trees(InputFile(file), settings, report, stop);
  if (format == FileFormat::cityjson) return read_cityjson_trees(InputFile(file), settings, report, stop);
  return read_feature_trees(file, settings, report, stop);
}

}  // namespace farlod::ingest
