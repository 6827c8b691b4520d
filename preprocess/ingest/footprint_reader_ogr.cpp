// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cpl_error.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <mutex>

#include "city/input_error.hpp"
#include "ingest/city_writer.hpp"
#include "ingest/footprint_reader.hpp"
#include "ingest/height_text.hpp"

namespace farlod {
namespace {

/// Keeps GDAL from printing: its errors become ours.
class GdalMessages {
 public:
  GdalMessages() { CPLPushErrorHandlerEx(&keep, this); }
  ~GdalMessages() { CPLPopErrorHandler(); }
  GdalMessages(const GdalMessages&) = delete;
  GdalMessages& operator=(const GdalMessages&) = delete;

  [[nodiscard]] std::vector<std::string> take() { return std::exchange(errors_, {}); }

 private:
  static void CPL_STDCALL keep(CPLErr level, CPLErrorNum, const char* message) {
    if (level >= CE_Failure) static_cast<GdalMessages*>(CPLGetErrorHandlerUserData())->errors_.emplace_back(message);
  }
  std::vector<std::string> errors_;
};

/// Names under which tables give heights above the ground, most telling first; case does not matter.
constexpr std::array<const char*, 8> height_field_names{"building:height", "height",  "measuredheight", "building_height",
                                                        "bldg_height",     "heightm", "height_m",       "hoehe"};
constexpr std::array<const char*, 10> id_field_names{"gml_id",      "@id", "id",         "osm_id",   "osm_way_id",
                                                     "building_id", "bin", "identifier", "objectid", "fid"};
/// Enough to tell whether a text column holds lengths.
constexpr int most_features_to_sample = 100;

struct FeatureDeleter {
  void operator()(OGRFeature* feature) const { OGRFeature::DestroyFeature(feature); }
};
using Feature = std::unique_ptr<OGRFeature, FeatureDeleter>;
Feature next_feature(OGRLayer& layer) { return Feature(layer.GetNextFeature()); }

bool is_set(const OGRFeature& feature, int field) { return field >= 0 && feature.IsFieldSetAndNotNull(field); }

std::optional<double> length_m_of(OGRFeature& feature, int field) {
  if (!is_set(feature, field)) return std::nullopt;
  const OGRFieldType type = feature.GetFieldDefnRef(field)->GetType();
  if (type == OFTReal || type == OFTInteger || type == OFTInteger64) return feature.GetFieldAsDouble(field);
  return length_m_from(feature.GetFieldAsString(field));
}

bool holds_areas(OGRLayer& layer) {
  const OGRwkbGeometryType type = wkbFlatten(layer.GetGeomType());
  return type == wkbUnknown || type == wkbGeometryCollection || OGR_GT_IsSubClassOf(type, wkbCurvePolygon) ||
         OGR_GT_IsSubClassOf(type, wkbMultiSurface);
}

/// Names of the fields whose values are lengths, for the user to choose from.
std::string numeric_fields(OGRLayer& layer) {
  std::vector<bool> is_numeric(static_cast<std::size_t>(layer.GetLayerDefn()->GetFieldCount()), false);
  layer.ResetReading();
  Feature feature = next_feature(layer);
  for (int n = 0; feature && n < most_features_to_sample; feature = next_feature(layer), ++n)
    for (std::size_t f = 0; f < is_numeric.size(); ++f)
      if (length_m_of(*feature, static_cast<int>(f))) is_numeric[f] = true;
  std::string names;
  for (std::size_t f = 0; f < is_numeric.size(); ++f)
    if (is_numeric[f])
      names.append(names.empty() ? "" : ", ").append(layer.GetLayerDefn()->GetFieldDefn(static_cast<int>(f))->GetNameRef());
  return names.empty() ? "no field with numbers" : "fields with numbers: " + names;
}

std::string wkt_of(OGRLayer& layer) {
  const OGRSpatialReference* reference = layer.GetSpatialRef();
  if (reference == nullptr) return {};
  char* wkt = nullptr;
  const std::array<const char*, 2> options{"FORMAT=WKT2_2019", nullptr};
  const bool is_good = reference->exportToWkt(&wkt, options.data()) == OGRERR_NONE;
  const std::string text = is_good && wkt != nullptr ? wkt : "";
  CPLFree(wkt);
  return text;
}

Ring ring_from(const OGRLinearRing& line) {
  Ring ring;
  for (int k = 0; k < line.getNumPoints(); ++k) ring.push_back({line.getX(k), line.getY(k), 0.0});
  return ring;
}

/// Of a feature that has no rings to be found by.
std::optional<Point3d> middle_of(const OGRGeometry& geometry) {
  OGREnvelope box;
  geometry.getEnvelope(&box);
  const Ring middle{{0.5 * (box.MinX + box.MaxX), 0.5 * (box.MinY + box.MaxY), 0.0}};
  return first_readable({&middle, 1});
}

/// Collects the polygons of a geometry; false when it holds something that is no area in the plane.
bool add_polygons(const OGRGeometry& geometry, std::vector<Rings>& polygons) {
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (type == wkbPolygon) {
    Rings& rings = polygons.emplace_back();
    for (const OGRLinearRing* ring : *geometry.toPolygon()) rings.push_back(ring_from(*ring));
    return true;
  }
  if (type != wkbMultiPolygon && type != wkbGeometryCollection) return false;
  bool all = true;
  for (const OGRGeometry* member : *geometry.toGeometryCollection()) all = add_polygons(*member, polygons) && all;
  return all;
}

class FootprintLayer {
 public:
  FootprintLayer(OGRLayer& layer, const IngestSettings& settings, CityWriter& writer)
      : layer_(layer), settings_(settings), writer_(writer), height_field_(find_height_field()) {
    if (settings.base_field) base_field_ = find_asked(*settings.base_field, "--base-field");
    for (const char* name : id_field_names)
      if (const int field = index_of(name); field >= 0) id_fields_.push_back(field);
  }

  void read(GdalMessages& messages) {
    layer_.ResetReading();
    for (Feature feature = next_feature(layer_); feature; feature = next_feature(layer_)) {
      read_feature(*feature);
      report(messages, id_of(*feature));
    }
    report(messages, layer_.GetName());
  }

 private:
  int index_of(const char* name) const { return layer_.GetLayerDefn()->GetFieldIndex(name); }

  int find_asked(const std::string& name, const char* option) {
    const int field = index_of(name.c_str());
    if (field >= 0) return field;
    throw InputError(writer_.source() + " has no field \"" + name + "\" (" + numeric_fields(layer_) + "). Give one of them as " +
                     option + ".");
  }

  int find_height_field() {
    if (settings_.height_field) return find_asked(*settings_.height_field, "--height-field");
    for (const char* name : height_field_names)
      if (const int field = index_of(name); field >= 0) return field;
    if (settings_.default_height_m) return -1;
    throw InputError(writer_.source() + " does not say how high its footprints are: " + numeric_fields(layer_) +
                     ". Name the field with --height-field, or give all one --default-height.");
  }

  std::string id_of(const OGRFeature& feature) const {
    for (const int field : id_fields_)
      if (is_set(feature, field)) return feature.GetFieldAsString(field);
    return std::to_string(feature.GetFID());
  }

  void report(GdalMessages& messages, const std::string& place) {
    for (std::string& message : messages.take())
      writer_.add_problem_at(place, ProblemCode::malformed_feature, std::move(message));
  }

  void read_feature(OGRFeature& feature) {
    const std::string id = id_of(feature);
    const OGRGeometry* geometry = feature.GetGeometryRef();
    if (geometry == nullptr || geometry->IsEmpty()) {
      writer_.add_problem_at(id, ProblemCode::no_geometry, "the feature has no geometry");
      return;
    }
    // Arcs become chords, as fine as GDAL's own default
    const std::unique_ptr<OGRGeometry> straight(geometry->getLinearGeometry());
    std::vector<Rings> polygons;
    const bool all = straight && add_polygons(*straight, polygons);
    if (!all)
      writer_.add_problem_at(id, ProblemCode::not_an_area, std::string("it is, or holds, a ") + geometry->getGeometryName(),
                             middle_of(*geometry));
    if (!polygons.empty()) raise(feature, id, polygons);
  }

  void raise(OGRFeature& feature, const std::string& id, std::vector<Rings>& polygons) {
    std::optional<double> height_m = length_m_of(feature, height_field_);
    if (!height_m) height_m = settings_.default_height_m;
    const std::optional<double> base_m = settings_.base_field ? length_m_of(feature, base_field_) : 0.0;
    if (!height_m || !base_m) {
      writer_.add_problem_at(id, ProblemCode::no_height, said(feature, height_m ? base_field_ : height_field_),
                             first_readable(polygons.front()));
    } else if (!(*height_m > 0.0)) {
      writer_.add_problem_at(id, ProblemCode::height_not_positive, said(feature, height_field_),
                             first_readable(polygons.front()));
    } else {
      writer_.begin_building(id, !settings_.base_field);
      for (std::size_t part = 0; part < polygons.size(); ++part)
        writer_.add_prism(polygons[part], RingEnd::repeats_first, *base_m, *base_m + *height_m, static_cast<std::uint16_t>(part));
      writer_.end_building("none of its rings is usable");
    }
  }

  /// What a feature says in a field, for the report.
  std::string said(const OGRFeature& feature, int field) const {
    if (field < 0) return "default height " + std::to_string(settings_.default_height_m.value_or(0.0));
    const std::string name = layer_.GetLayerDefn()->GetFieldDefn(field)->GetNameRef();
    return is_set(feature, field) ? name + " is \"" + feature.GetFieldAsString(field) + "\"" : name + " is empty";
  }

  OGRLayer& layer_;
  const IngestSettings& settings_;
  CityWriter& writer_;
  int height_field_ = -1, base_field_ = -1;
  std::vector<int> id_fields_;
};

/// The first layer of areas, by preference one that has the height field asked for.
OGRLayer* choose_layer(GDALDataset& dataset, const IngestSettings& settings) {
  OGRLayer* first = nullptr;
  for (OGRLayer* layer : dataset.GetLayers()) {
    if (!holds_areas(*layer)) continue;
    const bool has_field = !settings.height_field || layer->GetLayerDefn()->GetFieldIndex(settings.height_field->c_str()) >= 0;
    if (has_field) return layer;
    if (first == nullptr) first = layer;
  }
  return first;
}

void report_other_layers(GDALDataset& dataset, OGRLayer* chosen, CityWriter& writer) {
  for (OGRLayer* layer : dataset.GetLayers())
    if (layer != chosen)
      writer.add_problem_at(std::string("layer ") + layer->GetName(), ProblemCode::unsupported_geometry,
                            std::string("only one layer of a file is read, and that is ") + chosen->GetName());
}

GDALDatasetUniquePtr open(const std::filesystem::path& file, GdalMessages& messages) {
  static std::once_flag once;
  std::call_once(once, GDALAllRegister);
  GDALDatasetUniquePtr dataset(GDALDataset::Open(file.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY));
  const std::vector<std::string> errors = messages.take();
  if (!dataset)
    throw InputError(file.string() +
                     " cannot be read as a city: it is no CityGML, CityJSON or OBJ, and GDAL finds no footprints in it" +
                     (errors.empty() ? "." : " (" + errors.front() + ")."));
  return dataset;
}

}  // namespace

SourceCity read_footprints(const std::filesystem::path& file, const IngestSettings& settings, Report& report) {
  GdalMessages messages;
  const GDALDatasetUniquePtr dataset = open(file, messages);
  OGRLayer* layer = choose_layer(*dataset, settings);
  if (layer == nullptr) throw InputError(file.string() + " holds no layer of polygons: footprints are areas.");
  CityWriter writer(file.string(), report);
  report_other_layers(*dataset, layer, writer);
  FootprintLayer(*layer, settings, writer).read(messages);
  return {file.string(), {wkt_of(*layer), true, true}, writer.take_city()};
}

}  // namespace farlod
