// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "gdal/raster_layers_gdal.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "farlod/error.hpp"

namespace farlod {
namespace {

/// What follows the last colon and slash: NETCDF:"town.nc":zt, GPKG:town.gpkg:dsm, HDF5:"town.h5"://dsm.
std::string last_part(const std::string& gdal_name) { return gdal_name.substr(gdal_name.find_last_of(":/") + 1); }

bool is_placed(GDALDataset* raster) {
  std::array<double, 6> transform{};
  return raster != nullptr && raster->GetRasterCount() > 0 && raster->GetGeoTransform(transform.data()) == CE_None;
}

/// The name of the only raster of a file, where the format has names.
std::optional<std::string> own_name(GDALDataset& raster) {
  const char* name = EQUAL(raster.GetDriverName(), "netCDF") ? raster.GetRasterBand(1)->GetMetadataItem("NETCDF_VARNAME")
                     : EQUAL(raster.GetDriverName(), "GPKG") ? raster.GetMetadataItem("IDENTIFIER")
                                                             : nullptr;
  return name == nullptr ? std::nullopt : std::optional<std::string>(name);
}

std::string list_of(const std::vector<RasterLayer>& layers) {
  std::string names;
  for (const RasterLayer& layer : layers) names += (names.empty() ? "" : ", ") + layer.name;
  return names;
}

/// Those with a place on the map, and the first of them, open.
std::pair<std::vector<RasterLayer>, GDALDatasetUniquePtr> placed_layers(GDALDataset& file) {
  std::pair<std::vector<RasterLayer>, GDALDatasetUniquePtr> placed;
  for (RasterLayer& layer : raster_layers(file)) {
    GDALDatasetUniquePtr raster = open_raster_layer(file, layer);
    if (!is_placed(raster.get())) continue;
    if (placed.first.empty()) placed.second = std::move(raster);
    placed.first.push_back(std::move(layer));
  }
  return placed;
}

GDALDatasetUniquePtr chosen_of_several(GDALDataset& file, const std::string& path, const RasterChoice& choice) {
  for (const RasterLayer& layer : raster_layers(file))
    if (choice.name && layer.name == *choice.name) return open_raster_layer(file, layer);
  auto [layers, first] = placed_layers(file);
  if (layers.empty() || (layers.size() == 1 && !choice.is_for_this)) return std::move(first);
  if (layers.size() == 1 && !choice.name) return std::move(first);
  if (choice.name)
    throw InputError(path + " has no raster \"" + *choice.name + "\": give one of " + list_of(layers) + " as --layer.");
  throw InputError(path + " holds several rasters: " + list_of(layers) +
                   ". Name the one that is meant with --layer, or have gdal_translate write it to a file of its own.");
}

}  // namespace

std::vector<RasterLayer> raster_layers(GDALDataset& file) {
  std::vector<RasterLayer> layers;
  char** const words = file.GetMetadata("SUBDATASETS");
  for (int n = 1;; ++n) {
    const char* name = CSLFetchNameValue(words, ("SUBDATASET_" + std::to_string(n) + "_NAME").c_str());
    if (name == nullptr) return layers;
    layers.push_back({last_part(name), name});
  }
}

bool has_raster_layer(GDALDataset& file, const std::string& name) {
  if (file.GetRasterCount() > 0 && own_name(file) == name) return true;
  const std::vector<RasterLayer> layers = raster_layers(file);
  return std::any_of(layers.begin(), layers.end(), [&](const RasterLayer& layer) { return layer.name == name; });
}

GDALDatasetUniquePtr open_raster_layer(GDALDataset& file, const RasterLayer& layer) {
  const std::array<const char*, 2> format{file.GetDriverName(), nullptr};
  return GDALDatasetUniquePtr(GDALDataset::Open(layer.gdal_name.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, format.data()));
}

GDALDatasetUniquePtr chosen_raster(GDALDatasetUniquePtr file, const std::filesystem::path& path, const RasterChoice& choice) {
  // A TIFF of several pages is open at its first one
  if (file && file->GetRasterCount() < 1) return chosen_of_several(*file, path.string(), choice);
  if (!file || !choice.name || !choice.is_for_this) return file;
  const auto own = own_name(*file);
  if (own && own != choice.name)
    throw InputError(path.string() + " has no raster \"" + *choice.name + "\": it holds " + *own + " alone.");
  return file;
}

}  // namespace farlod
