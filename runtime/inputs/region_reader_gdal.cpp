// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "inputs/region_reader_gdal.hpp"

#include <ogrsf_frmts.h>

#include <memory>
#include <vector>

#include "gdal/gdal_errors.hpp"
#include "gdal/vector_file_gdal.hpp"
#include "gdal/wkt_gdal.hpp"
#include "inputs/reproject_gdal.hpp"
#include "inputs/requested_points.hpp"

namespace farlod {
namespace {

using Rings = std::vector<Region::Ring>;

/// Adds the rings of a geometry without arcs.
void add(const OGRGeometry& geometry, Rings& rings) {
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (OGR_GT_IsSubClassOf(type, wkbPolygon) != 0) {
    for (const OGRLinearRing* ring : *geometry.toPolygon()) {
      Region::Ring& points = rings.emplace_back();
      for (int n = 0; n < ring->getNumPoints(); ++n) points.push_back({ring->getX(n), ring->getY(n)});
    }
  } else if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection) != 0) {
    for (const OGRGeometry* member : *geometry.toGeometryCollection()) add(*member, rings);
  }
}

Rings rings_of(OGRLayer& layer) {
  Rings rings;
  for (Feature feature(layer.GetNextFeature()); feature; feature.reset(layer.GetNextFeature())) {
    const OGRGeometry* geometry = feature->GetGeometryRef();
    const std::unique_ptr<OGRGeometry> straight(geometry == nullptr ? nullptr : geometry->getLinearGeometry());
    if (straight) add(*straight, rings);
  }
  return rings;
}

}  // namespace

Region read_region_gdal(const std::filesystem::path& path, const std::string& package_crs) {
  if (!std::filesystem::exists(path)) throw PointsError(path.string() + ": the file cannot be read; see that it exists");
  GdalErrors messages;
  const GDALDatasetUniquePtr dataset = open_vector_file(path);
  if (!dataset) throw PointsError(path.string() + " cannot be read as a vector file (" + messages.last() + ")");
  Rings all;
  for (OGRLayer* layer : dataset->GetLayers()) {
    Rings rings = rings_of(*layer);
    const std::string crs = wkt_of(layer->GetSpatialRef());
    if (!crs.empty())
      for (Region::Ring& ring : rings) ring = reprojected(ring, crs, package_crs);
    all.insert(all.end(), std::make_move_iterator(rings.begin()), std::make_move_iterator(rings.end()));
  }
  if (messages.any()) throw PointsError(path.string() + " cannot be read to its end (" + messages.last() + ")");
  if (all.empty()) throw PointsError(path.string() + " holds no polygons: a mask is made of polygons");
  return Region(all);
}

}  // namespace farlod
