// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "base/cancellation.hpp"
#include "base/lower_case.hpp"
#include "base/unread_file.hpp"
#include "city/city_model.hpp"
#include "farlod/angle.hpp"
#include "farlod/error.hpp"
#include "gdal/gdal_errors.hpp"
#include "gdal/vector_file_gdal.hpp"
#include "gdal/wkt_gdal.hpp"
#include "ingest/trees/tree_fields.hpp"
#include "ingest/trees/tree_reader.hpp"

namespace farlod::ingest {
namespace {

GDALDatasetUniquePtr open(const std::filesystem::path& file, const std::optional<std::string>& encoding, GdalErrors& messages) {
  GDALDatasetUniquePtr dataset = open_vector_file_or_table(file, encoding);
  if (dataset) return dataset;
  if (std::filesystem::is_directory(file)) throw InputError(why_unread(file));
  const std::string reason = messages.last();
  throw InputError(file.string() + " cannot be read as an inventory of trees: give a vector file that GDAL reads, or a table" +
                   (reason.empty() ? "." : " (" + reason + ")."));
}

bool may_hold_trees(OGRLayer& layer) {
  const OGRwkbGeometryType type = wkbFlatten(layer.GetGeomType());
  return OGR_GT_IsCurve(type) == 0 && OGR_GT_IsSubClassOf(type, wkbMultiCurve) == 0;
}

FieldValue value_of(const OGRFeature& feature, std::size_t field) {
  const int n = static_cast<int>(field);
  if (!feature.IsFieldSetAndNotNull(n)) return {};
  const OGRFieldType type = feature.GetFieldDefnRef(n)->GetType();
  if (type == OFTReal || type == OFTInteger || type == OFTInteger64) return {feature.GetFieldAsDouble(n), {}, true};
  return {std::nullopt, feature.GetFieldAsString(n), true};
}

/// The outline of a crown: where its middle is, and how large it is, in units of the file.
struct Outline {
  double twice_area = 0.0;
  Point2d moment;  ///< Σ 3 · 2 · area · centroid, from `first`
  std::optional<Point2d> first;

  void add(const OGRLinearRing& ring, double sign) {
    const int count = ring.getNumPoints();
    if (count > 0 && !first) first = Point2d{ring.getX(0), ring.getY(0)};
    double area = 0.0;
    Point2d sum;
    for (int k = 0; k + 1 < count; ++k) {
      const Point2d a = Point2d{ring.getX(k), ring.getY(k)} - *first, b = Point2d{ring.getX(k + 1), ring.getY(k + 1)} - *first;
      const double twice = a.x * b.y - a.y * b.x;
      area += twice;
      sum = sum + twice * (a + b);
    }
    if (area < 0.0) sign = -sign;
    twice_area += sign * area;
    moment = moment + sign * sum;
  }
  void add(const OGRPolygon& polygon) {
    double sign = 1.0;  // of the outer ring; holes follow it
    for (const OGRLinearRing* ring : polygon) add(*ring, std::exchange(sign, -1.0));
  }
  [[nodiscard]] Point2d centroid() const { return *first + 1.0 / (3.0 * twice_area) * moment; }
};

class TreeLayer {
 public:
  TreeLayer(OGRLayer& layer, const std::filesystem::path& file, const TreeSettings& settings)
      : layer_(layer),
        source_(file.string()),
        names_(field_names(layer)),
        fields_(names_, settings),
        trees_(source_, settings.trunk_ratio) {
    require_utf8_names(layer, source_, encoding_option);
    require_fields(settings);
    const OGRSpatialReference* reference = layer.GetSpatialRef();
    trees_.crs() = {wkt_of(reference), true, true};
    if (reference != nullptr) {
      is_in_degrees_ = reference->IsGeographic() != 0;
      unit_m_ = is_in_degrees_ ? metres_in_a_degree : reference->GetLinearUnits();
    }
    if (wkbFlatten(layer.GetGeomType()) == wkbNone) use_columns();
  }

  SourceTrees read(GdalErrors& messages, Report& report, const std::stop_token& stop) {
    layer_.ResetReading();
    std::size_t count = 0;
    for (Feature feature(layer_.GetNextFeature()); feature; feature.reset(layer_.GetNextFeature())) {
      constexpr std::size_t between_looks = 1024;
      if (count++ % between_looks == 0) throw_if_cancelled(stop);
      read(*feature);
    }
    for (std::string& message : messages.take()) trees_.note(ProblemCode::malformed_feature, layer_.GetName(), message);
    return trees_.finish(count, report);
  }

 private:
  void require_fields(const TreeSettings& settings) const {
    const auto require = [&](const std::optional<std::string>& name, const char* option) {
      const auto is_it = [&](const std::string& field) { return lower_case(field) == lower_case(*name); };
      if (!name || fields_.holds_tags() || std::any_of(names_.begin(), names_.end(), is_it)) return;
      std::string all;
      for (const std::string& field : names_) all += (all.empty() ? "" : ", ") + field;
      throw InputError(source_ + " has no field \"" + *name + "\"; it has " + (all.empty() ? "none" : all) +
                       ". Give one of them as " + option + ".");
    };
    require(settings.height_field, "--tree-height-field");
    require(settings.crown_field, "--crown-field");
    require(settings.trunk_field, "--trunk-field");
  }

  void use_columns() {
    columns_ = find_place_columns(names_);
    if (!columns_)
      throw InputError(source_ +
                       " has no geometries, and no columns named lon and lat (or x and y, easting and northing): name them in "
                       "the first row.");
    trees_.crs() = {columns_->are_degrees ? "EPSG:4326" : "", true, true};
  }

  void read(const OGRFeature& feature) {
    name_ = "feature " + std::to_string(feature.GetFID());
    const StatedSizes sizes = fields_.of([&](std::size_t field) { return value_of(feature, field); });
    if (!sizes.is_tree) {
      trees_.skip("features other than trees");
    } else if (columns_) {
      read_columns(feature, sizes);
    } else if (const OGRGeometry* geometry = feature.GetGeometryRef(); geometry == nullptr || geometry->IsEmpty() != 0) {
      trees_.note(ProblemCode::no_geometry, name_, "it has no geometry");
    } else {
      const std::unique_ptr<OGRGeometry> straight(geometry->getLinearGeometry());
      straight ? read(*straight, sizes) : trees_.note(ProblemCode::malformed_feature, name_, "its arcs cannot be drawn");
    }
  }

  void read_columns(const OGRFeature& feature, const StatedSizes& sizes) {
    const auto number = [&](std::size_t field) {
      const FieldValue value = value_of(feature, field);
      return value.number ? value.number : number_from(value.text);
    };
    const auto x = number(columns_->x), y = number(columns_->y);
    if (x && y) return add({*x, *y}, sizes);
    const std::string texts = value_of(feature, columns_->x).text + ", " + value_of(feature, columns_->y).text;
    require_utf8(texts, layer_, source_, encoding_option);
    trees_.note(ProblemCode::unreadable_coordinate, name_, "\"" + texts + "\" are no coordinates");
  }

  void read(const OGRGeometry& geometry, const StatedSizes& sizes) {
    const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
    if (type == wkbPoint) {
      add({geometry.toPoint()->getX(), geometry.toPoint()->getY()}, sizes);
    } else if (type == wkbMultiPoint) {
      for (const OGRPoint* point : *geometry.toMultiPoint()) add({point->getX(), point->getY()}, sizes);
    } else if (type == wkbPolygon || type == wkbMultiPolygon) {
      Outline outline;
      if (type == wkbPolygon)
        outline.add(*geometry.toPolygon());
      else
        for (const OGRPolygon* polygon : *geometry.toMultiPolygon()) outline.add(*polygon);
      add_outline(outline, sizes);
    } else {
      trees_.note(ProblemCode::unsupported_geometry, name_, std::string("it is a ") + geometry.getGeometryName());
    }
  }

  void add_outline(const Outline& outline, StatedSizes sizes) {
    if (!(outline.twice_area > 0.0)) return trees_.note(ProblemCode::not_an_area, name_, "its outline has no area");
    const Point2d centroid = outline.centroid();
    const double area = 0.5 * outline.twice_area;
    const double narrowing = is_in_degrees_ ? std::cos(Angle::degrees(centroid.y).radians()) : 1.0;
    if (!sizes.crown_diameter_m)
      sizes.crown_diameter_m = 2.0 * unit_m_ * std::sqrt(std::max(area * narrowing, 0.0) / std::numbers::pi);
    add(centroid, sizes);
  }

  void add(Point2d place, const StatedSizes& sizes) { trees_.add(name_, place, sizes); }

  OGRLayer& layer_;
  std::string source_;
  std::vector<std::string> names_;
  TreeFields fields_;
  TreeCollector trees_;
  std::optional<PlaceColumns> columns_;
  bool is_in_degrees_ = false;
  double unit_m_ = 1.0;
  std::string name_;  ///< of the feature at hand
};

void report_other_layers(GDALDataset& dataset, OGRLayer* chosen, const std::string& source, Report& report) {
  for (OGRLayer* layer : dataset.GetLayers())
    if (layer != chosen)
      report.add({ProblemCode::unsupported_geometry, source, std::string("layer ") + layer->GetName(),
                  std::string("only one layer of a file is read, and that is ") + chosen->GetName()});
}

}  // namespace

SourceTrees read_feature_trees(const std::filesystem::path& file, const TreeSettings& settings, Report& report,
                               const std::stop_token& stop) {
  GdalErrors messages;
  const GDALDatasetUniquePtr dataset = open(file, settings.encoding, messages);
  const LayerChoice choice{.name = settings.layer,
                           .field = settings.height_field,
                           .option = "--trees-layer",
                           .wanted = "points or areas, which trees are",
                           .may_hold = may_hold_trees};
  OGRLayer* layer = chosen_layer(*dataset, file.string(), choice);
  if (layer == nullptr) throw InputError(file.string() + " holds no layer of points or areas: trees are one of them.");
  report_other_layers(*dataset, layer, file.string(), report);
  return TreeLayer(*layer, file, settings).read(messages, report, stop);
}

}  // namespace farlod::ingest
