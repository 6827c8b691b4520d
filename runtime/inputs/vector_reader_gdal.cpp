// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "inputs/vector_reader_gdal.hpp"

#include <ogrsf_frmts.h>

#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/lower_case.hpp"
#include "base/unread_file.hpp"
#include "gdal/gdal_errors.hpp"
#include "gdal/vector_file_gdal.hpp"
#include "gdal/wkt_gdal.hpp"
#include "inputs/reproject_gdal.hpp"

namespace farlod {
namespace {

/// A field of a layer. The number that the file itself gives each feature is one too, where it has a name (`fid`).
struct Field {
  static constexpr int feature_number = -1;
  std::string name;
  int index = 0;
};

std::vector<Field> fields_of(OGRLayer& layer) {
  std::vector<Field> fields;
  if (const std::string name = layer.GetFIDColumn(); !name.empty()) fields.push_back({name, Field::feature_number});
  const OGRFeatureDefn& definition = *layer.GetLayerDefn();
  for (int n = 0; n < definition.GetFieldCount(); ++n) fields.push_back({definition.GetFieldDefn(n)->GetNameRef(), n});
  return fields;
}

/// The shortest decimal that reads back as the same number.
template <class Real>
std::string shortest(Real value) {
  std::array<char, 32> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

std::string text_of(const OGRFeature& feature, const Field& field) {
  if (field.index == Field::feature_number) return std::to_string(feature.GetFID());
  if (!feature.IsFieldSetAndNotNull(field.index)) return {};
  const OGRFieldDefn& definition = *feature.GetFieldDefnRef(field.index);
  if (definition.GetType() != OFTReal) return feature.GetFieldAsString(field.index);
  const double value = feature.GetFieldAsDouble(field.index);
  return definition.GetSubType() == OFSTFloat32 ? shortest(static_cast<float>(value)) : shortest(value);
}

OGRLayer& layer_of(GDALDataset& dataset, const std::string& name, const std::string& file) {
  const LayerChoice choice{
      .name = name, .option = "--points-layer", .wanted = "features", .may_hold = [](OGRLayer&) { return true; }};
  if (dataset.GetLayerCount() == 0) throw PointsError(file + " has no layers: it holds no points");
  if (name.empty() && dataset.GetLayerCount() == 1) return *dataset.GetLayer(0);
  if (name.empty())
    throw PointsError(file + " has several layers: choose one by --points-layer, of " + other_layers(dataset, nullptr, choice));
  return *chosen_layer(dataset, file, choice);
}

std::string no_vector_file(const std::filesystem::path& path, const GdalErrors& messages) {
  std::error_code unread;
  if (std::filesystem::is_directory(path, unread) || std::filesystem::is_empty(path, unread)) return why_unread(path);
  return path.string() + " cannot be read as a vector file" + (messages.any() ? " (" + messages.last() + ")" : "") +
         ": give a GeoPackage, GeoJSON, Shapefile or another format of GDAL's.";
}

/// A layer that is open, with the messages of GDAL since then.
class OpenLayer {
 public:
  OpenLayer(const std::filesystem::path& path, const std::string& name) : file_(path.string()) {
    if (!std::filesystem::exists(path)) throw PointsError(why_unread(path));
    dataset_ = open_vector_file(path);
    if (!dataset_) throw PointsError(no_vector_file(path, messages_));
    layer_ = &layer_of(*dataset_, name, file_);
    require_utf8_names(*layer_, file_, nullptr);
  }
  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] OGRLayer& layer() const { return *layer_; }
  [[nodiscard]] std::string text_of(const OGRFeature& feature, const Field& field) const {
    std::string text = farlod::text_of(feature, field);
    require_utf8(text, *layer_, file_, nullptr);
    return text;
  }
  void require_all_read() const {
    if (messages_.any()) throw PointsError(file_ + " cannot be read to its end (" + messages_.last() + ")");
  }

 private:
  std::string file_;
  GdalErrors messages_;
  GDALDatasetUniquePtr dataset_;
  OGRLayer* layer_ = nullptr;
};

/// Reads one layer, feature by feature.
class LayerReader {
 public:
  explicit LayerReader(const OpenLayer& open) : open_(open), all_(fields_of(open.layer())) {
    std::vector<std::string> names;
    for (const Field& field : all_) names.push_back(field.name);
    fields_ =
        point_fields(names, PlacesIn::geometry, [&](const std::string& what) { throw PointsError(open_.file() + ": " + what); });
    std::vector<std::string> of_attributes;
    for (const std::size_t n : fields_.attributes) of_attributes.push_back(names[n]);
    result_.attributes = Attributes(std::move(of_attributes));
    result_.has_normals = fields_.tilt.has_value();
  }

  RequestedPoints read() && {
    open_.layer().ResetReading();
    for (Feature feature = next_feature(open_.layer()); feature; feature = next_feature(open_.layer())) take(*feature);
    return std::move(result_);
  }

 private:
  [[noreturn]] void refuse(const OGRFeature& feature, const std::string& what) const {
    throw PointsError(open_.file() + ": feature " + std::to_string(feature.GetFID()) + " of the layer \"" +
                      open_.layer().GetName() + "\": " + what);
  }

  /// None where the layer has no such field, or the feature nothing in it.
  [[nodiscard]] std::optional<double> number_if_any(const OGRFeature& feature, std::optional<std::size_t> field) const {
    const std::string text = field ? open_.text_of(feature, all_[*field]) : "";
    if (text.empty()) return std::nullopt;
    const std::optional<double> value = number_in(text);
    if (!value) refuse(feature, "\"" + text + "\" is not a number (" + all_[*field].name + "); write it like 123.4");
    return value;
  }

  void take(const OGRFeature& feature) {
    const OGRGeometry* geometry = feature.GetGeometryRef();
    const OGRwkbGeometryType type = geometry == nullptr ? wkbNone : wkbFlatten(geometry->getGeometryType());
    if (geometry == nullptr || geometry->IsEmpty() != 0 || (type != wkbPoint && type != wkbMultiPoint)) {
      ++result_.skipped_features;
      return;
    }
    if (type == wkbPoint) return take(feature, *geometry->toPoint());
    for (const OGRPoint* point : *geometry->toMultiPoint()) take(feature, *point);
  }

  void take(const OGRFeature& feature, const OGRPoint& place) {
    RequestedPoint point;
    point.x = place.getX();
    point.y = place.getY();
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) refuse(feature, "a coordinate is not a number");
    if (place.Is3D() != 0) point.z = place.getZ();
    if (point.z && !std::isfinite(*point.z)) refuse(feature, "its z is not a number; give the point a height, or no z");
    const auto refuse_height = [&](const std::string& what) { refuse(feature, what); };
    if (!point.z) point.above_ground_m = above_ground_of(number_if_any(feature, fields_.above_ground), refuse_height);
    point.normal = normal_of(number_if_any(feature, fields_.azimuth), number_if_any(feature, fields_.tilt),
                             [&](const std::string& what) { refuse(feature, what); });
    if (fields_.id) point.id = open_.text_of(feature, all_[*fields_.id]);
    if (point.id.empty()) point.id = std::to_string(result_.points.size() + 1);
    result_.points.push_back(std::move(point));
    std::vector<std::string> values;
    for (const std::size_t n : fields_.attributes) values.push_back(open_.text_of(feature, all_[n]));
    result_.attributes.add_row(values);
  }

  const OpenLayer& open_;
  std::vector<Field> all_;
  PointFields fields_;  ///< of `all_`
  RequestedPoints result_;
};

/// What GeoPackages call undefined is no CRS.
std::string crs_of(OGRLayer& layer) {
  const OGRSpatialReference* crs = layer.GetSpatialRef();
  if (crs == nullptr || crs->IsLocal() != 0) return {};
  const char* name = crs->GetName();
  return name != nullptr && std::string_view(name).starts_with("Undefined") ? std::string() : wkt_of(crs);
}

std::string sentence_on_skipped(const RequestedPoints& read, const std::filesystem::path& path, const std::string& wanted) {
  const bool one = read.skipped_features == 1;
  return std::to_string(read.skipped_features) + (one ? " feature of " : " features of ") + path.string() +
         (one ? " is no " + wanted + " and was skipped." : " are no " + wanted + "s and were skipped.");
}

void require_any(const RequestedPoints& read, const std::filesystem::path& path, const std::string& wanted,
                 const std::string& instead) {
  if (!read.points.empty()) return;
  const std::string none = path.string() + " holds no " + wanted + ": ";
  if (read.skipped_features == 0) throw PointsError(none + "its layer is empty");
  throw PointsError(none + "none of its " + std::to_string(read.skipped_features) + " features is " + instead);
}

double length_of(std::span<const Point2d> line) {
  double length_m = 0.0;
  for (std::size_t n = 1; n < line.size(); ++n) length_m += norm(line[n] - line[n - 1]);
  return length_m;
}

/// Finds places on a line of two points at least, by their ascending distances from its beginning.
class WalkAlong {
 public:
  explicit WalkAlong(std::span<const Point2d> line) : line_(line) {}

  [[nodiscard]] Point2d place_at(double distance_m) {
    double leg_m = norm(line_[end_] - line_[end_ - 1]);
    while (before_m_ + leg_m < distance_m && end_ + 1 < line_.size()) {
      before_m_ += leg_m;
      ++end_;
      leg_m = norm(line_[end_] - line_[end_ - 1]);
    }
    return line_[end_ - 1] + std::min(1.0, (distance_m - before_m_) / leg_m) * (line_[end_] - line_[end_ - 1]);
  }

 private:
  std::span<const Point2d> line_;
  std::size_t end_ = 1;    // of the leg
  double before_m_ = 0.0;  // the leg
};

/// Places points along the lines of one layer.
class LineReader {
 public:
  LineReader(const OpenLayer& open, const LineSampling& sampling, std::string crs, PlacesOfFile places)
      : open_(open), sampling_(sampling), crs_(std::move(crs)), places_(std::move(places)), fields_(fields_of(open.layer())) {
    std::vector<std::string> names;
    for (const Field& field : fields_) names.push_back(free_name(field.name));
    names.emplace_back(along);
    result_.attributes = Attributes(std::move(names));
  }

  RequestedPoints read() && {
    open_.layer().ResetReading();
    for (Feature feature = next_feature(open_.layer()); feature; feature = next_feature(open_.layer())) take(*feature);
    return std::move(result_);
  }

 private:
  static constexpr const char* along = "along_m";

  /// The field of a line that is called like the column that is added to them.
  static std::string free_name(const std::string& name) { return lower_case(name) == along ? name + "_input" : name; }

  void take(const OGRFeature& feature) {
    const OGRGeometry* geometry = feature.GetGeometryRef();
    const std::unique_ptr<OGRGeometry> straight(geometry == nullptr ? nullptr : geometry->getLinearGeometry());
    const OGRwkbGeometryType type = straight ? wkbFlatten(straight->getGeometryType()) : wkbNone;
    if (straight == nullptr || straight->IsEmpty() != 0 || (type != wkbLineString && type != wkbMultiLineString)) {
      ++result_.skipped_features;
      return;
    }
    std::vector<std::string> values;
    for (const Field& field : fields_) values.push_back(open_.text_of(feature, field));
    values.emplace_back();
    if (type == wkbLineString) return take(*straight->toLineString(), values);
    for (const OGRLineString* part : *straight->toMultiLineString()) take(*part, values);
  }

  void take(const OGRLineString& line, std::vector<std::string>& values) {
    std::vector<Point2d> places;
    for (int n = 0; n < line.getNumPoints(); ++n) places.push_back({line.getX(n), line.getY(n)});
    if (!crs_.empty()) places = reprojected_of_file(places, crs_, sampling_.package_crs, places_);
    const double length_m = length_of(places);
    if (!(length_m > 0.0) || !std::isfinite(length_m)) return;
    const auto count = static_cast<std::size_t>(std::ceil(length_m / sampling_.spacing_m));
    WalkAlong walk(places);
    for (std::size_t k = 0; k < count; ++k) {
      const double at_m = (static_cast<double>(k) + 0.5) * length_m / static_cast<double>(count);
      const Point2d p = walk.place_at(at_m);
      RequestedPoint point;
      point.id = std::to_string(result_.points.size() + 1);
      point.x = p.x;
      point.y = p.y;
      result_.points.push_back(std::move(point));
      values.back() = shortest(std::round(at_m * 1000.0) / 1000.0);
      result_.attributes.add_row(values);
    }
  }

  const OpenLayer& open_;
  const LineSampling& sampling_;
  std::string crs_;
  PlacesOfFile places_;
  std::vector<Field> fields_;
  RequestedPoints result_;
};

using Rings = std::vector<Region::Ring>;

Rings rings_of(OGRLayer& layer) {
  Rings rings;
  const auto take = [&rings](const OGRPolygon& polygon, bool) {
    for (const OGRLinearRing* ring : polygon) {
      Region::Ring& points = rings.emplace_back();
      for (int n = 0; n < ring->getNumPoints(); ++n) points.push_back({ring->getX(n), ring->getY(n)});
    }
  };
  for (Feature feature(layer.GetNextFeature()); feature; feature.reset(layer.GetNextFeature())) {
    const OGRGeometry* geometry = feature->GetGeometryRef();
    const std::unique_ptr<OGRGeometry> straight(geometry == nullptr ? nullptr : geometry->getLinearGeometry());
    if (straight) for_each_polygon(*straight, take);
  }
  return rings;
}

}  // namespace

bool is_vector_file(const std::filesystem::path& path) {
  const std::string ending = lower_case(path.extension().string());
  return ending != ".csv" && ending != ".tsv" && ending != ".txt" && has_vector_ending(path);
}

RequestedPoints read_points_gdal(const std::filesystem::path& path, const std::string& layer_name, bool may_be_empty) {
  const OpenLayer open(path, layer_name);
  RequestedPoints read = LayerReader(open).read();
  open.require_all_read();
  if (!may_be_empty) require_any(read, path, "points", "one; give points, not lines or polygons");
  if (read.skipped_features > 0) read.notes.push_back(sentence_on_skipped(read, path, "point"));
  read.crs_wkt = crs_of(open.layer());
  return read;
}

std::optional<Attributes> read_table_gdal(const std::filesystem::path& path, const std::string& layer_name) {
  const GdalErrors messages;
  const GDALDatasetUniquePtr dataset = open_vector_file(path);
  OGRLayer* layer = dataset ? dataset->GetLayerByName(layer_name.c_str()) : nullptr;
  if (layer == nullptr) return std::nullopt;
  const std::vector<Field> fields = fields_of(*layer);
  std::vector<std::string> values;
  for (const Field& field : fields) values.push_back(field.name);
  Attributes table(values);
  layer->ResetReading();
  for (Feature feature(layer->GetNextFeature()); feature; feature.reset(layer->GetNextFeature())) {
    values.clear();
    for (const Field& field : fields) values.push_back(text_of(*feature, field));
    table.add_row(values);
  }
  if (messages.any()) throw PointsError(path.string() + " cannot be read to its end (" + messages.last() + ")");
  return table;
}

RequestedPoints read_lines_gdal(const std::filesystem::path& path, const std::string& layer_name, const LineSampling& sampling) {
  const OpenLayer open(path, layer_name);
  const std::string own = crs_of(open.layer());
  const bool says_crs = !sampling.crs.empty();
  RequestedPoints read = LineReader(open, sampling, says_crs ? sampling.crs : own, {path, advice_on_points_crs(says_crs)}).read();
  open.require_all_read();
  require_any(read, path, "lines", "one; give lines, such as the axes of streets");
  if (read.skipped_features > 0) read.notes.push_back(sentence_on_skipped(read, path, "line"));
  if (own.empty() && sampling.crs.empty())
    read.notes.push_back(path.string() +
                         " says no CRS: its lines were taken to be in that of the package (--points-crs names "
                         "another).");
  return read;
}

Region read_region_gdal(const std::filesystem::path& path, const std::string& package_crs) {
  if (!std::filesystem::exists(path)) throw PointsError(why_unread(path));
  GdalErrors messages;
  const GDALDatasetUniquePtr dataset = open_vector_file(path);
  if (!dataset) throw PointsError(no_vector_file(path, messages));
  Rings all;
  for (OGRLayer* layer : dataset->GetLayers()) {
    Rings rings = rings_of(*layer);
    const std::string crs = wkt_of(layer->GetSpatialRef());
    if (!crs.empty())
      for (Region::Ring& ring : rings) ring = reprojected_of_file(ring, crs, package_crs, {path, advice_to_say_crs(path)});
    all.insert(all.end(), std::make_move_iterator(rings.begin()), std::make_move_iterator(rings.end()));
  }
  if (messages.any()) throw PointsError(path.string() + " cannot be read to its end (" + messages.last() + ")");
  if (all.empty()) throw PointsError(path.string() + " holds no polygons: a mask is made of polygons");
  return Region(all);
}

}  // namespace farlod
