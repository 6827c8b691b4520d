// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/table/feature_writer_gdal.hpp"

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

namespace farlod {
namespace {

using Format = GdalFeatureWriter::Format;

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

double millimetres(double value) { return std::round(value * 1e3) / 1e3; }

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

}  // namespace

struct GdalFeatureWriter::Impl {
  Format format;
  TableFrame frame;
  AtomicFile file;
  // GeoPackages have dates of their last change
  CPLConfigOptionSetter date{"OGR_CURRENT_DATE", "1970-01-01T00:00:00.000Z", true};
  // Nobody reads the file before it is complete: no step needs to reach the disk before the next
  CPLConfigOptionSetter synchronous{"OGR_SQLITE_SYNCHRONOUS", "OFF", true};
  GDALDatasetUniquePtr dataset;
  OGRLayer* layer = nullptr;
  Feature feature;  // one for all rows: making a new one takes a third of the time of writing it
  OGRPoint* point = nullptr;

  Impl(Format f, const TableFrame& t, const std::filesystem::path& path)
      : format(f), frame(t), file(path, f == Format::geopackage ? ".gpkg" : ".fgb") {}

  void throw_if_any(const GdalErrors& errors) const {
    if (errors.any()) throw OutputError(file.destination(), errors.last());
  }
};

GdalFeatureWriter::GdalFeatureWriter(Format format, const TableFrame& frame, const std::filesystem::path& path)
    : impl_(std::make_unique<Impl>(format, frame, path)) {
  const GdalErrors errors;
  impl_->dataset = create_file(format, impl_->file, errors);
  if (format == Format::geopackage) {
    for (const auto& [name, value] : entries_of(frame.provenance)) impl_->dataset->SetMetadataItem(name.c_str(), value.c_str());
    impl_->dataset->StartTransaction();  // one for all rows
  }
  impl_->throw_if_any(errors);
}

GdalFeatureWriter::~GdalFeatureWriter() {
  const GdalErrors nobody_hears;  // of a file that is given up
  impl_->feature.reset();
  impl_->dataset.reset();
}

void GdalFeatureWriter::begin(const FeatureLayer& layer) {
  const GdalErrors errors;
  impl_->feature.reset();
  OGRSpatialReference crs;
  const bool has_crs = layer.has_places && !impl_->frame.crs_wkt.empty();
  if (has_crs && !read_crs(crs, impl_->frame.crs_wkt, impl_->frame.epsg)) impl_->throw_if_any(errors);
  impl_->layer = impl_->dataset->CreateLayer(layer.name.c_str(), has_crs ? &crs : nullptr,
                                             layer.has_places ? wkbPoint25D : wkbNone, options_of(impl_->format, layer).List());
  impl_->throw_if_any(errors);
  for (const FeatureField& field : layer.fields) {
    OGRFieldDefn definition(field.name.c_str(), gdal_type_of(field.type));
    impl_->layer->CreateField(&definition);
  }
  impl_->throw_if_any(errors);
  impl_->feature.reset(OGRFeature::CreateFeature(impl_->layer->GetLayerDefn()));
  impl_->point = nullptr;
  if (!layer.has_places) return;
  impl_->feature->SetGeometryDirectly(new OGRPoint(0.0, 0.0, 0.0));
  impl_->point = impl_->feature->GetGeometryRef()->toPoint();
}

void GdalFeatureWriter::add(const FeatureRow& row) {
  const GdalErrors errors;
  OGRFeature& feature = *impl_->feature;
  FARLOD_EXPECTS(static_cast<int>(row.values.size()) == feature.GetFieldCount());
  feature.SetFID(OGRNullFID);
  for (std::size_t n = 0; n < row.values.size(); ++n) set_value(feature, static_cast<int>(n), row.values[n]);
  if (impl_->point != nullptr) {
    impl_->point->setX(millimetres(row.p_projected.x));
    impl_->point->setY(millimetres(row.p_projected.y));
    impl_->point->setZ(row.height_m ? millimetres(*row.height_m) : std::numeric_limits<double>::quiet_NaN());
  }
  if (impl_->layer->CreateFeature(&feature) != OGRERR_NONE && !errors.any())
    throw OutputError(impl_->file.destination(), "a row was refused");
  impl_->throw_if_any(errors);
}

void GdalFeatureWriter::commit() {
  const GdalErrors errors;
  if (impl_->format == Format::geopackage) impl_->dataset->CommitTransaction();
  impl_->feature.reset();
  // A full disk may show only now
  impl_->dataset.reset();
  impl_->throw_if_any(errors);
  impl_->file.commit();
}

}  // namespace farlod
