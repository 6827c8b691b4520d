// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cpl_conv.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/expects.hpp"
#include "base/lower_case.hpp"
#include "farlod/error.hpp"
#include "gdal/gdal_errors.hpp"
#include "gdal/vector_file_gdal.hpp"
#include "results/atomic_file.hpp"
#include "results/crs_gdal.hpp"
#include "results/table/feature_writer.hpp"

namespace farlod {
namespace {

enum class Format {
  geopackage,  ///< any number of layers without spatial index, and the frame's provenance as metadata
  flatgeobuf   ///< one layer with a spatial index, whose order its features have
};

const char* name_of(Format format) { return format == Format::geopackage ? "GPKG" : "FlatGeobuf"; }

GDALDatasetUniquePtr create_file(Format format, const AtomicFile& file, const GdalErrors& errors) {
  // All drivers would take longer than a small table
  format == Format::geopackage ? RegisterOGRGeoPackage() : RegisterOGRFlatGeobuf();
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(name_of(format));
  if (driver == nullptr) throw OutputError(file.destination(), std::string("this GDAL cannot write ") + name_of(format));
  GDALDatasetUniquePtr dataset(driver->Create(file.temporary().c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  if (dataset == nullptr) throw OutputError(file.destination(), errors.last());
  return dataset;
}

/// A name that no field of the layer has, in capitals or not.
std::string free_name(std::string name, const FeatureLayer& layer) {
  const auto is_taken = [&] {
    return std::ranges::any_of(layer.fields, [&](const FeatureField& f) { return lower_case(f.name) == name; });
  };
  while (is_taken()) name += '_';
  return name;
}

CPLStringList options_of(Format format, const FeatureLayer& layer) {
  CPLStringList options;
  // GDAL 3.6 takes fifteen times as long to index a million points of a GeoPackage as to write them. Readers of FlatGeobuf fetch
  // parts of a file by its index
  options.SetNameValue("SPATIAL_INDEX", format == Format::geopackage ? "NO" : "YES");
  if (format != Format::geopackage) return options;
  options.SetNameValue("FID", free_name("fid", layer).c_str());
  options.SetNameValue("GEOMETRY_NAME", free_name("geom", layer).c_str());
  options.SetNameValue("DESCRIPTION", layer.description.c_str());
  return options;
}

OGRFieldType gdal_type_of(FieldType type) {
  return type == FieldType::text ? OFTString : type == FieldType::whole ? OFTInteger64 : OFTReal;
}

OGRwkbGeometryType gdal_type_of(LayerGeometry geometry) {
  switch (geometry) {
    case LayerGeometry::none:
      return wkbNone;
    case LayerGeometry::points:
      return wkbPoint25D;
    case LayerGeometry::polygons:
      return wkbMultiPolygon25D;
    case LayerGeometry::multiple_areas:
      return wkbMultiPolygon;
    case LayerGeometry::areas:
      break;
  }
  return wkbPolygon;
}

double millimetres(double value) { return std::round(value * 1e3) / 1e3; }

std::unique_ptr<OGRLinearRing> ring_of(const std::vector<Point3d>& corners) {
  auto ring = std::make_unique<OGRLinearRing>();
  for (const Point3d& p : corners) ring->addPoint(millimetres(p.x), millimetres(p.y), millimetres(p.z));
  ring->closeRings();
  return ring;
}

std::unique_ptr<OGRPolygon> polygon_of(const SurfacePolygon& p) {
  auto polygon = std::make_unique<OGRPolygon>();
  polygon->addRingDirectly(ring_of(p.shell).release());
  for (const std::vector<Point3d>& hole : p.holes) polygon->addRingDirectly(ring_of(hole).release());
  return polygon;
}

std::unique_ptr<OGRPolygon> area_of(const SurfacePolygon& p) {
  std::unique_ptr<OGRPolygon> polygon = polygon_of(p);
  polygon->flattenTo2D();
  return polygon;
}

std::unique_ptr<OGRMultiPolygon> multipolygon_of(const std::vector<SurfacePolygon>& polygons) {
  auto all = std::make_unique<OGRMultiPolygon>();
  for (const SurfacePolygon& p : polygons) all->addGeometryDirectly(polygon_of(p).release());
  return all;
}

std::unique_ptr<OGRMultiPolygon> areas_of(const std::vector<SurfacePolygon>& polygons) {
  std::unique_ptr<OGRMultiPolygon> all = multipolygon_of(polygons);
  all->flattenTo2D();
  return all;
}

void set_value(OGRFeature& feature, int field, const FieldValue& value) {
  if (const auto* text = std::get_if<std::string_view>(&value))
    feature.SetField(field, std::string(*text).c_str());
  else if (const auto* whole = std::get_if<std::int64_t>(&value))
    feature.SetField(field, static_cast<GIntBig>(*whole));
  else if (const auto* real = std::get_if<double>(&value))
    feature.SetField(field, *real);
  else
    feature.SetFieldNull(field);
}

class GdalFeatureWriter final : public FeatureWriter {
 public:
  GdalFeatureWriter(Format format, const TableFrame& frame, const std::filesystem::path& path)
      : format_(format), frame_(frame), file_(path, format == Format::geopackage ? ".gpkg" : ".fgb") {
    const GdalErrors errors;
    dataset_ = create_file(format, file_, errors);
    if (format == Format::geopackage) {
      for (const auto& [name, value] : entries_of(frame.provenance)) dataset_->SetMetadataItem(name.c_str(), value.c_str());
      dataset_->StartTransaction();  // one for all rows
    }
    throw_if_any(errors);
  }
  ~GdalFeatureWriter() override {
    const GdalErrors nobody_hears;  // of a file that is given up
    feature_.reset();
    dataset_.reset();
  }
  void begin(const FeatureLayer& layer) override {
    const GdalErrors errors;
    feature_.reset();
    OGRSpatialReference crs;
    const bool has_crs = layer.geometry != LayerGeometry::none && !frame_.crs_wkt.empty();
    if (has_crs && !read_crs(crs, frame_.crs_wkt, frame_.epsg)) throw_if_any(errors);
    layer_ = dataset_->CreateLayer(layer.name.c_str(), has_crs ? &crs : nullptr, gdal_type_of(layer.geometry),
                                   options_of(format_, layer).List());
    throw_if_any(errors);
    for (const FeatureField& field : layer.fields) {
      OGRFieldDefn definition(field.name.c_str(), gdal_type_of(field.type));
      layer_->CreateField(&definition);
    }
    throw_if_any(errors);
    feature_.reset(OGRFeature::CreateFeature(layer_->GetLayerDefn()));
    geometry_ = layer.geometry;
  }
  void add(const FeatureRow& row) override {
    const GdalErrors errors;
    OGRFeature& feature = *feature_;
    FARLOD_EXPECTS(static_cast<int>(row.values.size()) == feature.GetFieldCount());
    feature.SetFID(OGRNullFID);
    for (std::size_t n = 0; n < row.values.size(); ++n) set_value(feature, static_cast<int>(n), row.values[n]);
    if (geometry_ == LayerGeometry::points) set_point(row);
    if (geometry_ == LayerGeometry::polygons) feature.SetGeometryDirectly(multipolygon_of(row.polygons).release());
    if (geometry_ == LayerGeometry::multiple_areas) feature.SetGeometryDirectly(areas_of(row.polygons).release());
    if (geometry_ == LayerGeometry::areas) feature.SetGeometryDirectly(area_of(row.polygons.front()).release());
    if (layer_->CreateFeature(&feature) != OGRERR_NONE && !errors.any())
      throw OutputError(file_.destination(), "a row was refused");
    throw_if_any(errors);
  }
  void commit() override {
    const GdalErrors errors;
    if (format_ == Format::geopackage) dataset_->CommitTransaction();
    feature_.reset();
    // A full disk may show only now
    dataset_.reset();
    throw_if_any(errors);
    file_.commit();
  }

 private:
  void throw_if_any(const GdalErrors& errors) const {
    if (errors.any()) throw OutputError(file_.destination(), errors.last());
  }

  Format format_;
  TableFrame frame_;
  AtomicFile file_;
  // GeoPackages have dates of their last change
  CPLConfigOptionSetter date_{"OGR_CURRENT_DATE", "1970-01-01T00:00:00.000Z", true};
  // Nobody reads the file before it is complete: no step needs to reach the disk before the next
  CPLConfigOptionSetter synchronous_{"OGR_SQLITE_SYNCHRONOUS", "OFF", true};
  GDALDatasetUniquePtr dataset_;
  void set_point(const FeatureRow& row) {
    if (std::isnan(row.p_projected.x)) {
      feature_->SetGeometryDirectly(nullptr);
      return;
    }
    if (feature_->GetGeometryRef() == nullptr) feature_->SetGeometryDirectly(new OGRPoint(0.0, 0.0, 0.0));
    OGRPoint& point = *feature_->GetGeometryRef()->toPoint();
    point.setX(millimetres(row.p_projected.x));
    point.setY(millimetres(row.p_projected.y));
    point.setZ(row.height_m ? millimetres(*row.height_m) : std::numeric_limits<double>::quiet_NaN());
  }

  OGRLayer* layer_ = nullptr;
  Feature feature_;  // one for all rows: making a new one takes a third of the time of writing it
  LayerGeometry geometry_ = LayerGeometry::points;
};

}  // namespace

std::unique_ptr<FeatureWriter> geopackage_writer(const TableFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<GdalFeatureWriter>(Format::geopackage, frame, path);
}

std::unique_ptr<FeatureWriter> flatgeobuf_writer(const TableFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<GdalFeatureWriter>(Format::flatgeobuf, frame, path);
}

}  // namespace farlod
