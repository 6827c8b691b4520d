// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
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
/// read it. `encoding`: of the names and texts of a Shapefile. Throws InputError where it leads beyond this computer.
[[nodiscard]] GDALDatasetUniquePtr open_vector_file(const std::filesystem::path& file,
                                                    const std::optional<std::string>& encoding = {});

/// Whether a name ends as tables of values do: .csv, .tsv, .txt.
[[nodiscard]] bool is_table(const std::filesystem::path& file);

/// The same, but a table is one of comma separated values, whatever its name ends with.
[[nodiscard]] GDALDatasetUniquePtr open_vector_file_or_table(const std::filesystem::path& file,
                                                             const std::optional<std::string>& encoding = {});

/// Which layer of a file is meant.
struct LayerChoice {
  std::optional<std::string> name = {};   ///< of the one that the user asks for
  std::optional<std::string> field = {};  ///< a layer that has it comes before others
  const char* option = "--layer";         ///< by which a user names a layer
  const char* wanted = "areas";           ///< what it must hold, for messages
  bool (*may_hold)(OGRLayer&);            ///< whether a layer may hold that
};

/// The layer of the name; else the first one with the field; else the first one; of those that may hold what is wanted. Null
/// where there is none. Throws InputError where one is named that is not there, or holds something else.
[[nodiscard]] OGRLayer* chosen_layer(GDALDataset& dataset, const std::string& file, const LayerChoice& choice);

/// The names of the layers that may hold what is wanted, but for the one that was chosen.
[[nodiscard]] std::string other_layers(GDALDataset& dataset, const OGRLayer* chosen, const LayerChoice& choice);

[[nodiscard]] std::vector<std::string> field_names(OGRLayer& layer);

/// The option of preprocess that names an encoding.
inline constexpr const char* encoding_option = "--encoding";

/// Throws InputError where a text is not UTF-8, as those of Shapefiles are that do not say what they are in. Names and texts go
/// into messages, packages and tables, which are UTF-8. `option`: names the encoding; null where there is none.
void require_utf8(const std::string& text, OGRLayer& layer, const std::string& file, const char* option);
/// The same for the names of all fields.
void require_utf8_names(OGRLayer& layer, const std::string& file, const char* option);

/// Visits the polygons of a geometry without arcs; `is_face`: of those of a polyhedral surface or a TIN. False where it holds
/// something else, too.
bool for_each_polygon(const OGRGeometry& geometry, const std::function<void(const OGRPolygon&, bool is_face)>& visit);

/// Whether the ending of a name is one of those that GDAL's vector formats have.
[[nodiscard]] bool has_vector_ending(const std::filesystem::path& file);

}  // namespace farlod
