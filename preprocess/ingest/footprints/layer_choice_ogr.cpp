// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/footprints/layer_choice_ogr.hpp"

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include "farlod/error.hpp"

namespace farlod::ingest {
namespace {

bool holds_areas(OGRLayer& layer) {
  const OGRwkbGeometryType type = wkbFlatten(layer.GetGeomType());
  return type == wkbUnknown || type == wkbGeometryCollection || OGR_GT_IsSubClassOf(type, wkbSurface) != 0 ||
         OGR_GT_IsSubClassOf(type, wkbMultiSurface) != 0;
}

OGRLayer* named_layer(GDALDataset& dataset, const std::string& file, const std::string& name) {
  OGRLayer* const layer = dataset.GetLayerByName(name.c_str());
  if (layer == nullptr)
    throw InputError(file + " has no layer \"" + name + "\": give one of " + other_layers(dataset, nullptr) + " as --layer.");
  if (!holds_areas(*layer)) throw InputError(file + ": the layer " + name + " holds no areas, which footprints are.");
  return layer;
}

}  // namespace

std::string other_layers(GDALDataset& dataset, const OGRLayer* chosen) {
  std::string names;
  for (OGRLayer* layer : dataset.GetLayers())
    if (layer != chosen && holds_areas(*layer)) names.append(names.empty() ? "" : ", ").append(layer->GetName());
  return names;
}

OGRLayer* choose_layer(GDALDataset& dataset, const std::string& file, const FootprintSettings& settings) {
  if (settings.layer) return named_layer(dataset, file, *settings.layer);
  OGRLayer* first = nullptr;
  for (OGRLayer* layer : dataset.GetLayers()) {
    if (!holds_areas(*layer)) continue;
    const bool has_field = !settings.height_field || layer->GetLayerDefn()->GetFieldIndex(settings.height_field->c_str()) >= 0;
    if (has_field) return layer;
    if (first == nullptr) first = layer;
  }
  return first;
}

}  // namespace farlod::ingest
