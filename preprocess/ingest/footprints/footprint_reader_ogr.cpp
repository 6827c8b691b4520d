// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cpl_conv.h>
#include <cpl_string.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <utility>

#include "base/lower_case.hpp"
#include "farlod/box.hpp"
#include "farlod/error.hpp"
#include "gdal/gdal_errors.hpp"
#include "gdal/local_data_gdal.hpp"
#include "gdal/vector_file_gdal.hpp"
#include "gdal/wkt_gdal.hpp"
#include "ingest/files/file_format.hpp"
#include "ingest/footprints/feature_areas_ogr.hpp"
#include "ingest/footprints/feature_table_ogr.hpp"
#include "ingest/footprints/footprint_reader.hpp"
#include "ingest/footprints/openstreetmap_areas_gdal.hpp"
#include "ingest/footprints/said_heights.hpp"
#include "ingest/model_builder/city_model_builder.hpp"

namespace farlod::ingest {
namespace {

constexpr std::array<const char*, 10> id_field_names{"gml_id",      "@id", "id",         "osm_id",   "osm_way_id",
                                                     "building_id", "bin", "identifier", "objectid", "fid"};

bool holds_ascii_alone(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return (c & 0x80) == 0; });
}

bool may_hold_footprints(OGRLayer& layer) {
  const OGRwkbGeometryType type = wkbFlatten(layer.GetGeomType());
  return type == wkbUnknown || type == wkbGeometryCollection || OGR_GT_IsSubClassOf(type, wkbSurface) != 0 ||
         OGR_GT_IsSubClassOf(type, wkbMultiSurface) != 0;
}

bool is_set(const OGRFeature& feature, int field) { return field >= 0 && feature.IsFieldSetAndNotNull(field); }

bool is_length(const FieldValue& value) { return value.number || (value.is_set && length_m_from(value.text)); }

/// The names of the fields whose values are lengths, for a message.
std::string numeric_fields(OGRLayer& layer, const FeatureTable& table) {
  std::vector<bool> is_numeric(table.names().size(), false);
  layer.ResetReading();
  Feature feature = next_feature(layer);
  for (int n = 0; feature && n < most_features_to_sample; feature = next_feature(layer), ++n)
    for (std::size_t f = 0; f < is_numeric.size(); ++f)
      if (is_length(FeatureTable::Row(table, *feature).value(f))) is_numeric[f] = true;
  std::string names;
  for (std::size_t f = 0; f < is_numeric.size(); ++f)
    if (is_numeric[f]) names.append(names.empty() ? "" : ", ").append(table.names()[f]);
  return names.empty() ? "no field with numbers" : "fields with numbers: " + names;
}

void flatten(Rings& rings) {
  for (Ring& ring : rings)
    for (Point3d& p : ring) p.z = 0.0;
}

double highest_of(const Rings& rings) {
  double highest = 0.0;
  if (!rings.empty())
    for (const Point3d& p : rings.front()) highest = std::max(highest, p.z);
  return highest;
}

class FootprintLayer {
 public:
  /// `others`: the names of further layers with areas.
  FootprintLayer(OGRLayer& layer, const FootprintSettings& settings, const std::string& others, CityModelBuilder& builder)
      : layer_(layer),
        builder_(builder),
        table_(layer),
        parts_(layer, table_),
        heights_(table_.names(), with_fields_checked(settings)),
        is_height_named_(settings.height_field.has_value()),
        named_storeys_(settings.storeys_field),
        floor_height_m_(settings.floor_height_m) {
    for (const char* name : id_field_names)
      if (const int field = index_of(name); field >= 0) id_fields_.push_back(field);
    require_features();
    if (heights_.has_bases()) learn_bases();
    holds_bodies_ = find_bodies();
    if (holds_bodies_ || heights_.can_tell()) return;
    require_areas();
    throw InputError(builder_.source() + " does not say how high its footprints are: " + numeric_fields(layer_, table_) +
                     ". Name the field with --height-field or --storeys-field, or with --roof-field where it holds "
                     "elevations (and with --base-field those of the ground, or give a terrain), or give all one "
                     "--default-height" +
                     (others.empty() ? "." : "; or read another layer, by --layer: " + others + "."));
  }

  void read(GdalErrors& messages) {
    layer_.ResetReading();
    for (Feature feature = next_feature(layer_); feature; feature = next_feature(layer_)) {
      read_feature(*feature);
      report(messages, id_of(*feature));
    }
    report(messages, layer_.GetName());
    said_.require_no_elevations(builder_.source(), table_.names());
    for (const std::string& doubt : said_.doubts(table_.names(), floor_height_m_))
      builder_.add_problem_at("the whole file", ProblemCode::implausible_size, doubt);
  }

  /// For the user: which layer is read, if there are `others`, and how many heights are not measured ones.
  [[nodiscard]] std::vector<std::string> notes(const std::string& others) const {
    std::vector<std::string> notes;
    if (!others.empty())
      notes.push_back(builder_.source() + ": only the layer " + layer_.GetName() + " is read; --layer reads another: " + others);
    std::ostringstream storeys;
    storeys << builder_.source() << ": " << raised_by_storeys_ << " heights are storeys of " << floor_height_m_ << " m";
    if (raised_by_storeys_ > 0) notes.push_back(std::move(storeys).str());
    if (raised_by_default_ > 0)
      notes.push_back(builder_.source() + ": " + std::to_string(raised_by_default_) + " heights are the default height");
    for (const auto& [field, count] : raised_by_field_) {
      const std::string of_field =
          builder_.source() + ": " + std::to_string(count) + (count == 1 ? " height is" : " heights are") + " of the field ";
      if (is_height_named_ && field != heights_.fields().front())
        notes.push_back(of_field + table_.names()[field] + ", where " + table_.names()[heights_.fields().front()] + " has none");
      if (named_storeys_ && !is_height_named_)
        notes.push_back(of_field + table_.names()[field] + ", which counts before the storeys of " + *named_storeys_);
      if (unit_of(table_.names()[field]) == LengthUnit::foot)
        notes.push_back(of_field + table_.names()[field] + ", which is in feet by its name");
    }
    return notes;
  }

  /// Whether the features are bodies in space, which are read as they are, and not footprints.
  [[nodiscard]] bool holds_bodies() const { return holds_bodies_; }
  [[nodiscard]] const SkippedFeatures& skipped() const { return skipped_; }
  [[nodiscard]] const std::vector<std::string>& owners_of_parts() const { return owners_of_parts_; }

 private:
  int index_of(const char* name) const { return layer_.GetLayerDefn()->GetFieldIndex(name); }

  const FootprintSettings& with_fields_checked(const FootprintSettings& settings) {
    // A name that cannot be read is not found either
    require_utf8_names(layer_, builder_.source(), encoding_option);
    check_field(settings.height_field, "--height-field");
    check_field(settings.base_field, "--base-field");
    check_field(settings.storeys_field, "--storeys-field");
    check_field(settings.roof_field, "--roof-field");
    return settings;
  }

  void check_field(const std::optional<std::string>& name, const char* option) {
    const auto is_it = [&](const std::string& field) { return lower_case(field) == lower_case(*name); };
    if (!name) return;
    const auto found = std::find_if(table_.names().begin(), table_.names().end(), is_it);
    if (found != table_.names().end()) {
      require_numbers(static_cast<std::size_t>(found - table_.names().begin()), option);
      return;
    }
    const bool may_be_misread = layer_.GetMetadata("SHAPEFILE") != nullptr && !holds_ascii_alone(*name);
    throw InputError(builder_.source() + " has no field \"" + *name + "\" (" + numeric_fields(layer_, table_) +
                     "). Give one of them as " + option +
                     (may_be_misread ? ", or the encoding of their names by --encoding where they look wrong." : "."));
  }

  /// Other fields would take the place of one that never says a number.
  void require_numbers(std::size_t field, const char* option) {
    layer_.ResetReading();
    Feature feature = next_feature(layer_);
    const bool is_empty = !feature;
    for (; feature; feature = next_feature(layer_))
      if (is_length(FeatureTable::Row(table_, *feature).value(field))) return;
    if (is_empty) return;  // which is told as such
    throw InputError(builder_.source() + ": the field " + table_.names()[field] + " has a number in no feature (" +
                     numeric_fields(layer_, table_) + "). Give one of them as " + option + ".");
  }

  /// A service answers so where nothing lies in the area, or at the end of its pages.
  void require_features() {
    layer_.ResetReading();
    if (!next_feature(layer_))
      throw InputError(builder_.source() + " holds no feature: its layer " + layer_.GetName() +
                       " is empty. Was the area of the download, or a filter, the wrong one?");
  }

  /// KML may hold places and links to models alone.
  void require_areas() {
    layer_.ResetReading();
    Feature feature = next_feature(layer_);
    for (int n = 0; feature && n < most_features_to_sample; feature = next_feature(layer_), ++n)
      if (feature->GetGeometryRef() != nullptr && !areas_of(*feature->GetGeometryRef(), layer_.GetSpatialRef()).polygons.empty())
        return;
    throw InputError(builder_.source() + " holds no areas, which footprints are: its layer " + layer_.GetName() +
                     " has other features. Bodies that it links to, as KML does, are to be exported as OBJ.");
  }

  void require_text(const std::string& text) const { require_utf8(text, layer_, builder_.source(), encoding_option); }

  void learn_bases() {
    std::vector<std::optional<float>> bases_m;
    layer_.ResetReading();
    for (Feature feature = next_feature(layer_); feature; feature = next_feature(layer_)) {
      const FeatureTable::Row row(table_, *feature);
      const auto base_m = heights_.base_m([&](std::size_t field) { return row.value(field); });
      bases_m.push_back(base_m ? std::optional(static_cast<float>(*base_m)) : std::nullopt);
    }
    heights_.learn_bases(bases_m);
  }

  bool find_bodies() {
    layer_.ResetReading();
    Feature feature = next_feature(layer_);
    for (int n = 0; feature && n < most_features_to_sample; feature = next_feature(layer_), ++n)
      if (feature->GetGeometryRef() != nullptr && areas_of(*feature->GetGeometryRef(), layer_.GetSpatialRef()).is_body)
        return true;
    return false;
  }

  std::string id_of(const OGRFeature& feature) const {
    for (const int field : id_fields_)
      if (is_set(feature, field)) return feature.GetFieldAsString(field);
    return std::to_string(feature.GetFID());
  }

  void report(GdalErrors& messages, const std::string& place) {
    for (std::string& message : messages.take())
      builder_.add_problem_at(place, ProblemCode::malformed_feature, std::move(message));
  }

  void read_feature(const OGRFeature& feature) {
    const std::string id = id_of(feature);
    require_text(id);
    const OGRGeometry* geometry = feature.GetGeometryRef();
    if (geometry == nullptr || geometry->IsEmpty()) {
      builder_.add_problem_at(id, ProblemCode::no_geometry, "the feature has no geometry");
      return;
    }
    if (!is_building(feature, *geometry)) return;
    Areas areas = areas_of(*geometry, layer_.GetSpatialRef());
    if (areas.holds_others)
      builder_.add_problem_at(id, ProblemCode::not_an_area, std::string("it is, or holds, a ") + geometry->getGeometryName(),
                              middle_of(*geometry));
    if (areas.polygons.empty()) return;
    if (holds_bodies_)
      add_body(id, areas.polygons);
    else if (areas.is_body)
      builder_.add_problem_at(id, ProblemCode::unsupported_geometry, "a body in space among footprints is not read",
                              first_readable(areas.polygons.front()));
    else
      raise(feature, id, areas.polygons);
  }

  /// Counts what is none.
  bool is_building(const OGRFeature& feature, const OGRGeometry& geometry) {
    const FeatureRole role = FeatureTable::Row(table_, feature).role();
    const bool is_filled = role == FeatureRole::building && parts_.fill(geometry);
    if (role == FeatureRole::no_building) ++skipped_["features whose tags make them no buildings"];
    if (role == FeatureRole::underground) ++skipped_["buildings below the ground"];
    if (is_filled) ++skipped_["outlines of buildings whose parts are there"];
    return !is_filled && (role == FeatureRole::building || role == FeatureRole::part);
  }

  void add_body(const std::string& id, std::vector<Rings>& polygons) {
    builder_.begin_building(id);
    for (Rings& rings : polygons) builder_.add_polygon(rings, RingEnd::repeats_first, {});
    builder_.end_building("none of its polygons is usable");
  }

  void raise(const OGRFeature& feature, const std::string& id, std::vector<Rings>& polygons) {
    const double outline_m = highest_of(polygons.front());
    for (Rings& rings : polygons) flatten(rings);
    const FeatureTable::Row row(table_, feature);
    const auto answer = heights_.of([&](std::size_t field) { return row.value(field); });
    if (const auto* reason = std::get_if<Unraised>(&answer)) {
      require_text(reason->detail);
      builder_.add_problem_at(id, reason->code, reason->detail, first_readable(polygons.front()));
      if (const auto& said = reason->too_high)
        said_.keep_too_high({said->field, said->source}, {said->value_m, size_m2(polygons.front())});
      return;
    }
    const auto& extent = std::get<PrismExtent>(answer);
    raised_by_storeys_ += extent.source == HeightSource::storeys ? 1 : 0;
    raised_by_default_ += extent.source == HeightSource::default_height ? 1 : 0;
    if (const auto owner = row.owner()) owners_of_parts_.push_back(*owner);
    if (extent.field) {
      if (extent.source == HeightSource::measured) ++raised_by_field_[*extent.field];
      keep_said({*extent.field, extent.source}, extent, polygons.front(), outline_m);
    }
    builder_.begin_building(id, extent.height_reference, extent.foot);
    for (std::size_t part = 0; part < polygons.size(); ++part)
      builder_.add_prism(polygons[part], RingEnd::repeats_first, extent.base_m, extent.top_m, static_cast<std::uint16_t>(part));
    builder_.end_building("none of its rings is usable");
  }

  /// The area of the box around a footprint.
  double size_m2(const Rings& rings) const {
    if (rings.empty() || rings.front().empty()) return 0.0;
    Box2d box;
    for (const Point3d& p : rings.front()) box.add(horizontal(p));
    const Point2d scale = plan_scale(layer_.GetSpatialRef(), box.low), size = box.high - box.low;
    return scale.x * size.x * scale.y * size.y;
  }

  void keep_said(const SaidHeights::Field& field, const PrismExtent& extent, const Rings& rings, double outline_m) {
    if (rings.empty() || rings.front().empty()) return;
    const bool has_base = extent.height_reference == HeightReference::elevation;
    said_.keep(field, {has_base ? extent.top_m - extent.base_m : extent.top_m, size_m2(rings), outline_m,
                       has_base ? std::optional(extent.base_m) : std::nullopt});
  }

  OGRLayer& layer_;
  CityModelBuilder& builder_;
  FeatureTable table_;
  PartsOfLayer parts_;
  FootprintHeights heights_;
  SkippedFeatures skipped_;
  std::vector<int> id_fields_;
  bool holds_bodies_ = false;
  std::size_t raised_by_storeys_ = 0, raised_by_default_ = 0;
  bool is_height_named_ = false;
  std::optional<std::string> named_storeys_;
  double floor_height_m_;
  std::map<std::size_t, std::size_t> raised_by_field_;
  SaidHeights said_;
  std::vector<std::string> owners_of_parts_;
};

bool is_openstreetmap(GDALDataset& dataset) { return EQUAL(dataset.GetDriverName(), "OSM"); }

/// The other layers of OpenStreetMap are points and lines, and groups of things that are there already.
void report_other_layers(GDALDataset& dataset, OGRLayer* chosen, CityModelBuilder& builder) {
  if (is_openstreetmap(dataset)) return;
  for (OGRLayer* layer : dataset.GetLayers())
    if (layer != chosen)
      builder.add_problem_at(std::string("layer ") + layer->GetName(), ProblemCode::unsupported_geometry,
                             std::string("only one layer of a file is read, and that is ") + chosen->GetName());
}

GDALDatasetUniquePtr open(const InputFile& file, const std::optional<std::string>& encoding, GdalErrors& messages) {
  const GdalReach reach = file.is_named ? GdalReach::local_files : GdalReach::own_data;
  GDALDatasetUniquePtr dataset = open_within(reach, file.path, GDAL_OF_VECTOR, encoding);
  const std::vector<std::string> errors = messages.take();
  if (!dataset && !file.is_named && is_known_within(GdalReach::local_files, file.path, GDAL_OF_VECTOR))
    throw InputError(file.name + " is of a format that may name other files: give it by its own name, unpacked.");
  if (!dataset)
    throw InputError(file.name + " cannot be read as a city: it is no " +
                     names_where([](const InputFormat&) { return true; }, " or ") + ", and GDAL finds no footprints in it" +
                     (errors.empty() ? "." : " (" + errors.front() + ")."));
  return dataset;
}

}  // namespace

SourceCity read_footprints(const InputFile& file, const FootprintSettings& settings, Report& report) {
  GdalErrors messages;
  const CPLConfigOptionSetter areas("OSM_CONFIG_FILE", file_of_openstreetmap_areas().c_str(), true);
  const GDALDatasetUniquePtr dataset = open(file, settings.encoding, messages);
  // Else GDAL keeps all points and lines in memory until somebody reads them
  if (is_openstreetmap(*dataset))
    dataset->ReleaseResultSet(dataset->ExecuteSQL("SET interest_layers = multipolygons", nullptr, ""));
  const LayerChoice choice{.name = settings.layer,
                           .field = settings.height_field,
                           .wanted = "areas, which footprints are",
                           .may_hold = may_hold_footprints};
  OGRLayer* layer = chosen_layer(*dataset, file.name, choice);
  if (layer == nullptr) throw InputError(file.name + " holds no layer of polygons: footprints are areas.");
  CityModelBuilder builder(file.name, report);
  report_other_layers(*dataset, layer, builder);
  const std::string others = is_openstreetmap(*dataset) ? "" : other_layers(*dataset, layer, choice);
  FootprintLayer footprints(*layer, settings, others, builder);
  footprints.read(messages);
  // Attributes are in metres; elevations of vertices are in the unit of the reference system
  return {.source = file.name,
          .crs = {wkt_of(layer->GetSpatialRef()), true, !footprints.holds_bodies()},
          .city = builder.take_city(),
          .skipped = footprints.skipped(),
          .notes = footprints.notes(settings.layer ? "" : others),
          .owners_of_parts = footprints.owners_of_parts()};
}

}  // namespace farlod::ingest
