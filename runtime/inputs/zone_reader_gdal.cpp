// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "inputs/zone_reader_gdal.hpp"

#include <ogrsf_frmts.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "base/unread_file.hpp"
#include "gdal/gdal_errors.hpp"
#include "gdal/vector_file_gdal.hpp"
#include "gdal/wkt_gdal.hpp"
#include "inputs/reproject_gdal.hpp"
#include "inputs/vector_reader_gdal.hpp"

namespace farlod {
namespace {

bool may_hold_zones(OGRLayer& layer) {
  const OGRwkbGeometryType type = wkbFlatten(layer.GetGeomType());
  return type == wkbUnknown || type == wkbGeometryCollection || OGR_GT_IsSubClassOf(type, wkbSurface) != 0 ||
         OGR_GT_IsSubClassOf(type, wkbMultiSurface) != 0;
}

OGRLayer& layer_of_zones(GDALDataset& dataset, const std::string& name, const std::string& file) {
  const LayerChoice choice{.name = name.empty() ? std::nullopt : std::optional(name),
                           .option = "--zones-layer",
                           .wanted = "polygons",
                           .may_hold = may_hold_zones};
  OGRLayer* const layer = chosen_layer(dataset, file, choice);
  if (layer == nullptr) throw PointsError(file + " holds no polygons: give census blocks, squares of a model or the like");
  if (name.empty() && !other_layers(dataset, layer, choice).empty())
    throw PointsError(file + " has several layers of polygons: choose one by --zones-layer, of " +
                      other_layers(dataset, nullptr, choice));
  return *layer;
}

/// Positive where the ring is counter-clockwise.
double doubled_area(const std::vector<Point2d>& corners) {
  double sum = 0.0;
  for (std::size_t n = 0; n < corners.size(); ++n) {
    const Point2d a = corners[n] - corners[0], b = corners[(n + 1) % corners.size()] - corners[0];
    sum += a.x * b.y - a.y * b.x;
  }
  return sum;
}

bool covers_area(const std::vector<ZonePolygon>& zone) {
  // Upright polygons have the area of rounding errors
  constexpr double least_area_m2 = 1e-4;
  return std::ranges::any_of(zone, [](const ZonePolygon& p) { return doubled_area(p.shell) > 2.0 * least_area_m2; });
}

/// Takes rings to the CRS of the package, and turns them as they are wanted.
class ZoneRings {
 public:
  ZoneRings(const std::string& crs, const std::string& package_crs) {
    if (!crs.empty()) to_package_.emplace(crs, package_crs);
  }
  /// Counter-clockwise, or clockwise. False where a corner cannot be projected.
  [[nodiscard]] bool take(const OGRLinearRing& ring, bool is_hole, std::vector<Point2d>& corners) const {
    for (int n = 0; n < ring.getNumPoints(); ++n) corners.push_back({ring.getX(n), ring.getY(n)});
    if (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    if (to_package_ && to_package_->apply(corners)) return false;
    if ((doubled_area(corners) < 0.0) != is_hole) std::ranges::reverse(corners);
    return true;
  }

 private:
  std::optional<Reprojection> to_package_;
};

/// Reads the zones of one layer, feature by feature.
class LayerOfZones {
 public:
  LayerOfZones(OGRLayer& layer, std::string file, const std::string& package_crs)
      : layer_(layer), file_(std::move(file)), rings_(wkt_of(layer.GetSpatialRef()), package_crs) {}

  [[nodiscard]] std::vector<std::vector<ZonePolygon>> read() const {
    std::vector<std::vector<ZonePolygon>> zones;
    layer_.ResetReading();
    for (Feature feature = next_feature(layer_); feature; feature = next_feature(layer_)) zones.push_back(zone_of(*feature));
    return zones;
  }

 private:
  [[noreturn]] void refuse(const OGRFeature& feature, const std::string& what) const {
    throw PointsError(file_ + ": feature " + std::to_string(feature.GetFID()) + " of the layer \"" + layer_.GetName() + "\" " +
                      what);
  }
  [[nodiscard]] std::vector<ZonePolygon> zone_of(const OGRFeature& feature) const {
    const OGRGeometry* const geometry = feature.GetGeometryRef();
    const std::unique_ptr<OGRGeometry> straight(geometry == nullptr ? nullptr : geometry->getLinearGeometry());
    std::vector<ZonePolygon> zone;
    const auto add = [&](const OGRPolygon& polygon, bool) {
      if (polygon.getExteriorRing() != nullptr) zone.push_back(polygon_of(feature, polygon));
    };
    if (straight == nullptr || !for_each_polygon(*straight, add) || zone.empty())
      refuse(feature, "is no polygon: leave it out, since each feature has a row");
    if (!covers_area(zone)) refuse(feature, "has no area: leave it out, since each feature has a row");
    return zone;
  }
  [[nodiscard]] ZonePolygon polygon_of(const OGRFeature& feature, const OGRPolygon& polygon) const {
    ZonePolygon result;
    bool all = rings_.take(*polygon.getExteriorRing(), false, result.shell);
    for (int n = 0; n < polygon.getNumInteriorRings(); ++n)
      all = rings_.take(*polygon.getInteriorRing(n), true, result.holes.emplace_back()) && all;
    if (!all)
      refuse(feature,
             "lies where the CRS of the package has no coordinates: choose those near the city, or " + advice_to_say_crs(file_));
    return result;
  }

  OGRLayer& layer_;
  std::string file_;
  ZoneRings rings_;
};

}  // namespace

RequestedZones read_zones_gdal(const std::filesystem::path& path, const std::string& layer_name, const std::string& package_crs) {
  if (!std::filesystem::exists(path)) throw PointsError(why_unread(path));
  const std::string file = path.string();
  RequestedZones read;
  std::string name;
  {
    const GdalErrors messages;
    const GDALDatasetUniquePtr dataset = open_vector_file(path);
    if (!dataset)
      throw PointsError(file + " cannot be read as a vector file" + (messages.any() ? " (" + messages.last() + ")" : "") +
                        ": give a GeoPackage, GeoJSON, Shapefile or another format of GDAL's.");
    OGRLayer& layer = layer_of_zones(*dataset, layer_name, file);
    require_utf8_names(layer, file, nullptr);
    name = layer.GetName();
    read.zones = LayerOfZones(layer, file, package_crs).read();
    if (messages.any()) throw PointsError(file + " cannot be read to its end (" + messages.last() + ")");
  }
  if (read.zones.empty()) throw PointsError(file + " holds no polygons: its layer is empty");
  read.attributes = read_table_gdal(path, name).value_or(Attributes());
  return read;
}

}  // namespace farlod
