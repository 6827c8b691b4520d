// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "gdal/vector_file_gdal.hpp"

#include <cpl_string.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "base/lower_case.hpp"
#include "farlod/error.hpp"
#include "gdal/local_data_gdal.hpp"
#include "gdal/registered_formats_gdal.hpp"

namespace farlod {
namespace {

bool lists(const char* endings, const std::string& ending) {
  std::istringstream list(endings == nullptr ? "" : endings);
  for (std::string one; list >> one;)
    if (EQUAL(one.c_str(), ending.c_str())) return true;
  return false;
}

OGRLayer& named_layer(GDALDataset& dataset, const std::string& file, const LayerChoice& choice) {
  OGRLayer* const layer = dataset.GetLayerByName(choice.name->c_str());
  if (layer == nullptr) {
    const std::string names = other_layers(dataset, nullptr, choice);
    throw InputError(file + " has no layer \"" + *choice.name + "\": " +
                     (names.empty() ? std::string("none of its layers holds ") + choice.wanted + "."
                                    : "give one of " + names + " as " + choice.option + "."));
  }
  if (!choice.may_hold(*layer)) throw InputError(file + ": the layer " + *choice.name + " holds no " + choice.wanted + ".");
  return *layer;
}

}  // namespace

GDALDatasetUniquePtr open_vector_file(const std::filesystem::path& file, const std::optional<std::string>& encoding) {
  return open_within(GdalReach::local_files, file, GDAL_OF_VECTOR, encoding);
}

bool is_table(const std::filesystem::path& file) {
  const std::string ending = lower_case(file.extension().string());
  return ending == ".csv" || ending == ".tsv" || ending == ".txt";
}

GDALDatasetUniquePtr open_vector_file_or_table(const std::filesystem::path& file, const std::optional<std::string>& encoding) {
  if (!is_table(file)) return open_vector_file(file, encoding);
  (void)registered_formats();
  constexpr std::array<const char*, 2> table_driver{"CSV", nullptr};
  const std::string name = "CSV:" + file.string();  // the prefix lets GDAL take any ending
  return GDALDatasetUniquePtr(GDALDataset::Open(name.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, table_driver.data()));
}

OGRLayer* chosen_layer(GDALDataset& dataset, const std::string& file, const LayerChoice& choice) {
  if (choice.name) return &named_layer(dataset, file, choice);
  OGRLayer* first = nullptr;
  for (OGRLayer* layer : dataset.GetLayers()) {
    if (!choice.may_hold(*layer)) continue;
    if (!choice.field || layer->GetLayerDefn()->GetFieldIndex(choice.field->c_str()) >= 0) return layer;
    if (first == nullptr) first = layer;
  }
  return first;
}

std::string other_layers(GDALDataset& dataset, const OGRLayer* chosen, const LayerChoice& choice) {
  std::string names;
  for (OGRLayer* layer : dataset.GetLayers())
    if (layer != chosen && choice.may_hold(*layer)) names.append(names.empty() ? "" : ", ").append(layer->GetName());
  return names;
}

std::vector<std::string> field_names(OGRLayer& layer) {
  std::vector<std::string> names;
  OGRFeatureDefn& fields = *layer.GetLayerDefn();
  for (int n = 0; n < fields.GetFieldCount(); ++n) names.emplace_back(fields.GetFieldDefn(n)->GetNameRef());
  return names;
}

void require_utf8(const std::string& text, OGRLayer& layer, const std::string& file, const char* option) {
  if (CPLIsUTF8(text.c_str(), -1) != 0) return;
  const bool is_shapefile = layer.GetMetadata("SHAPEFILE") != nullptr;
  const std::string by_option =
      option == nullptr ? "" : std::string("say what they are in, such as ") + option + " GBK or CP1252, or ";
  throw InputError(file + ": its names and texts are not UTF-8: " +
                   (is_shapefile ? by_option + "give it a .cpg file that says what they are in, such as GBK or CP1252."
                                 : "save it again as UTF-8."));
}

void require_utf8_names(OGRLayer& layer, const std::string& file, const char* option) {
  for (const std::string& name : field_names(layer)) require_utf8(name, layer, file, option);
}

bool for_each_polygon(const OGRGeometry& geometry, const std::function<void(const OGRPolygon&, bool is_face)>& visit) {
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (OGR_GT_IsSubClassOf(type, wkbPolygon) != 0) {
    visit(*geometry.toPolygon(), false);
    return true;
  }
  if (OGR_GT_IsSubClassOf(type, wkbPolyhedralSurface) != 0) {
    const OGRPolyhedralSurface& surface = *geometry.toPolyhedralSurface();
    for (int n = 0; n < surface.getNumGeometries(); ++n) visit(*surface.getGeometryRef(n), true);
    return true;
  }
  if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection) == 0) return false;
  bool all = true;
  for (const OGRGeometry* member : *geometry.toGeometryCollection()) all = for_each_polygon(*member, visit) && all;
  return all;
}

bool has_vector_ending(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  if (ending.size() < 2) return false;
  for (int n = 0; n < registered_formats().GetDriverCount(); ++n) {
    GDALDriver& driver = *registered_formats().GetDriver(n);
    if (driver.GetMetadataItem(GDAL_DCAP_VECTOR) != nullptr &&
        lists(driver.GetMetadataItem(GDAL_DMD_EXTENSIONS), ending.substr(1)))
      return true;
  }
  return false;
}

}  // namespace farlod
