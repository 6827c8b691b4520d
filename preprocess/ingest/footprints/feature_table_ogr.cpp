// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/footprints/feature_table_ogr.hpp"

#include <ogrsf_frmts.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/lower_case.hpp"
#include "gdal/vector_file_gdal.hpp"

namespace farlod::ingest {
namespace {

bool is_collection(const std::string& name) {
  return std::find(std::begin(tag_collections), std::end(tag_collections), lower_case(name)) != std::end(tag_collections);
}

double area_of(const OGRGeometry& geometry) {
  if (OGR_GT_IsSurface(geometry.getGeometryType())) return geometry.toSurface()->get_Area();
  return OGR_GT_IsSubClassOf(wkbFlatten(geometry.getGeometryType()), wkbGeometryCollection) != 0
             ? geometry.toGeometryCollection()->get_Area()
             : 0.0;
}

/// The area that geometries cover together: parts of a tower stand on each other. Empty where they are too damaged to tell.
std::optional<double> plan_of(const std::vector<const OGRGeometry*>& geometries) {
  OGRMultiPolygon all;
  for (const OGRGeometry* geometry : geometries)
    for_each_polygon(*geometry, [&all](const OGRPolygon& polygon, bool) { all.addGeometry(&polygon); });
  const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
  const OGRGeometryUniquePtr together(all.UnionCascaded());
  return together ? std::optional(area_of(*together)) : std::nullopt;
}

}  // namespace

FeatureTable::FeatureTable(OGRLayer& layer) {
  const OGRFeatureDefn& columns = *layer.GetLayerDefn();
  for (int field = 0; field < columns.GetFieldCount(); ++field) {
    names_.emplace_back(columns.GetFieldDefn(field)->GetNameRef());
    if (is_collection(names_.back())) collections_.push_back(field);
  }
  columns_ = names_.size();
  const std::vector<std::string> column_names = names_;
  for (const std::string& tag : known_tags())
    if (!collections_.empty() && std::find(column_names.begin(), column_names.end(), tag) == column_names.end())
      names_.push_back(tag);
  std::vector<Feature> sample;
  std::vector<Row> rows;
  std::vector<TagLookup> some;
  layer.ResetReading();
  for (Feature feature = next_feature(layer); feature && sample.size() < most_features_to_sample; feature = next_feature(layer))
    sample.push_back(std::move(feature));
  for (const Feature& feature : sample) rows.emplace_back(*this, *feature);
  for (const Row& row : rows) some.emplace_back([&row](std::string_view name) { return row.tag(name); });
  tags_.emplace(column_names, some);
}

FeatureTable::Row::Row(const FeatureTable& table, const OGRFeature& feature) : table_(table), feature_(feature) {
  for (const int column : table.collections_)
    if (feature.IsFieldSetAndNotNull(column))
      for (auto& tag : tags_in(feature.GetFieldAsString(column))) collected_.push_back(std::move(tag));
}

std::optional<std::string> FeatureTable::Row::collected(std::string_view name) const {
  for (const auto& [key, value] : collected_)
    if (key == name) return value;
  return std::nullopt;
}

FieldValue FeatureTable::Row::value(std::size_t field) const {
  if (field >= table_.columns_) {
    const auto found = collected(table_.names_[field]);
    return found ? FieldValue{std::nullopt, *found, true} : FieldValue{};
  }
  const int column = static_cast<int>(field);
  if (!feature_.IsFieldSetAndNotNull(column)) return {};
  const OGRFieldType type = feature_.GetFieldDefnRef(column)->GetType();
  if (type == OFTReal || type == OFTInteger || type == OFTInteger64) return {feature_.GetFieldAsDouble(column), {}, true};
  return {std::nullopt, feature_.GetFieldAsString(column), true};
}

std::optional<std::size_t> FeatureTable::column_of(std::string_view tag) const {
  const auto known = column_of_tag_.find(tag);
  if (known != column_of_tag_.end()) return known->second;
  const auto end = names_.begin() + static_cast<std::ptrdiff_t>(columns_);
  const auto found = std::find_if(names_.begin(), end, [&](const std::string& name) { return is_column_of(name, tag); });
  const auto column = found == end ? std::nullopt : std::optional(static_cast<std::size_t>(found - names_.begin()));
  return column_of_tag_.emplace(tag, column).first->second;
}

std::optional<std::string> FeatureTable::Row::tag(std::string_view name) const {
  if (auto found = collected(name)) return found;
  const auto column = table_.column_of(name);
  if (!column) return std::nullopt;
  const int n = static_cast<int>(*column);
  return feature_.IsFieldSetAndNotNull(n) ? std::optional<std::string>(feature_.GetFieldAsString(n)) : std::nullopt;
}

FeatureRole FeatureTable::Row::role() const {
  return table_.tags().role_of([this](std::string_view name) { return tag(name); });
}

PartsOfLayer::PartsOfLayer(OGRLayer& layer, const FeatureTable& table) {
  if (!table.tags().may_have_parts()) return;
  layer.ResetReading();
  for (Feature feature = next_feature(layer); feature; feature = next_feature(layer)) {
    OGRGeometry* geometry = feature->GetGeometryRef();
    if (geometry == nullptr || FeatureTable::Row(table, *feature).role() != FeatureRole::part) continue;
    const OGRGeometryUniquePtr inside(OGRGeometry::FromHandle(OGR_G_PointOnSurface(OGRGeometry::ToHandle(geometry))));
    if (inside && !inside->IsEmpty())
      parts_.push_back({{inside->toPoint()->getX(), inside->toPoint()->getY()},
                        area_of(*geometry),
                        std::shared_ptr<const OGRGeometry>(feature->StealGeometry())});
  }
  std::sort(parts_.begin(), parts_.end(), [](const Part& a, const Part& b) { return a.inside.x < b.inside.x; });
}

bool PartsOfLayer::fill(const OGRGeometry& outline) const {
  if (parts_.empty()) return false;
  constexpr double most_of_it = 0.5;
  OGREnvelope box;
  outline.getEnvelope(&box);
  double filled = 0.0;
  std::vector<const OGRGeometry*> inside;
  const auto first =
      std::lower_bound(parts_.begin(), parts_.end(), box.MinX, [](const Part& part, double x) { return part.inside.x < x; });
  for (auto part = first; part != parts_.end() && part->inside.x <= box.MaxX; ++part)
    if (box.MinY <= part->inside.y && part->inside.y <= box.MaxY &&
        OGRPoint(part->inside.x, part->inside.y).Within(&outline) != 0) {
      filled += part->area;
      inside.push_back(part->geometry.get());
    }
  const double enough = most_of_it * area_of(outline);
  return filled >= enough && filled > 0.0 && plan_of(inside).value_or(filled) >= enough;
}

}  // namespace farlod::ingest
