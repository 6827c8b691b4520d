// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

// Private to the wrappers of GDAL: it names its classes.

namespace farlod {

struct FeatureDeleter {
  void operator()(OGRFeature* feature) const { OGRFeature::DestroyFeature(feature); }
};
using Feature = std::unique_ptr<OGRFeature, FeatureDeleter>;

/// None after the last one.
[[nodiscard]] inline Feature next_feature(OGRLayer& layer) { return Feature(layer.GetNextFeature()); }

/// Opens a vector file that the user named, within GdalReach::local_files. Null where GDAL does not know what it is, or cannot
/// read it. Throws InputError where it leads beyond this computer.
[[nodiscard]] GDALDatasetUniquePtr open_vector_file(const std::filesystem::path& file);

/// Whether a name ends as tables of values do: .csv, .tsv, .txt.
[[nodiscard]] bool is_table(const std::filesystem::path& file);

/// The same, but a table is one of comma separated values, whatever its name ends with.
[[nodiscard]] GDALDatasetUniquePtr open_vector_file_or_table(const std::filesystem::path& file);

[[nodiscard]] std::vector<std::string> field_names(OGRLayer& layer);

/// Whether the ending of a name is one of those that GDAL's vector formats have.
[[nodiscard]] bool has_vector_ending(const std::filesystem::path& file);

}  // namespace farlod
