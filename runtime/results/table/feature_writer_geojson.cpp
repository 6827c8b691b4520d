// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cerrno>
#include <cmath>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/expects.hpp"
#include "farlod/error.hpp"
#include "inputs/reproject_gdal.hpp"
#include "results/atomic_file.hpp"
#include "results/table/feature_writer.hpp"
#include "results/value_text.hpp"

namespace farlod {
namespace {

constexpr std::size_t places_at_once = 1024;

void append_value(std::string& json, const FieldValue& value) {
  if (const auto* text = std::get_if<std::string_view>(&value))
    append_json_text(json, *text);
  else if (const auto* whole = std::get_if<std::int64_t>(&value))
    json += std::to_string(*whole);
  else if (const auto* real = std::get_if<double>(&value))
    json += shortest_decimal(*real);
  else
    json += "null";
}

std::string head_of(const FeatureLayer& layer, const Provenance& provenance) {
  std::string json = "{\"type\": \"FeatureCollection\", \"name\": ";
  append_json_text(json, layer.name);
  json += ", \"provenance\": {";
  std::string_view comma;
  for (const auto& [name, value] : entries_of(provenance)) {
    json += std::exchange(comma, ", ");
    append_json_text(json, name);
    json += ": ";
    append_json_text(json, value);
  }
  return json + "}, \"features\": [";
}

[[noreturn]] void refuse(const AtomicFile& file) {
  // The stream does not say why it failed; the system's last error does
  throw OutputError(file.destination(), errno != 0 ? std::generic_category().message(errno) : "the disk refused the data");
}

class GeojsonWriter final : public FeatureWriter {
 public:
  GeojsonWriter(const TableFrame& frame, const std::filesystem::path& path);
  void begin(const FeatureLayer& layer) override;
  void add(const FeatureRow& row) override;
  void commit() override;

 private:
  /// A feature whose places are not transformed yet, since many are at a time.
  struct Waiting {
    std::string properties;
    std::vector<std::vector<std::size_t>> polygons = {};  ///< of each ring, how many of the places are its corners
  };

  void add_place(Point2d p, std::optional<double> height_m);
  [[nodiscard]] std::size_t add_ring(const std::vector<Point3d>& corners);
  void append_place(std::string& json, std::size_t place) const;
  void append_point(std::string& json, std::size_t place) const;
  void append_ring(std::string& json, std::size_t first, std::size_t corners) const;
  /// `place` is the first one, and is moved behind the last one; so in the next function.
  void append_rings(std::string& json, const std::vector<std::size_t>& corners_of_rings, std::size_t& place) const;
  void append_geometry(std::string& json, const Waiting& feature, std::size_t& place) const;
  void write_waiting();

  Provenance provenance_;
  AtomicFile file_;
  std::ofstream stream_;
  std::optional<Reprojection> to_wgs84_;
  std::vector<std::string> keys_;  ///< of the fields, as they are written
  LayerGeometry geometry_ = LayerGeometry::points;
  std::vector<Point2d> places_;
  std::vector<std::optional<double>> heights_;
  std::vector<Waiting> waiting_;
  std::size_t written_ = 0;
};

GeojsonWriter::GeojsonWriter(const TableFrame& frame, const std::filesystem::path& path)
    : provenance_(frame.provenance), file_(path) {
  errno = 0;
  stream_.open(file_.temporary(), std::ios::binary);
  if (!stream_) refuse(file_);
  if (!frame.crs_wkt.empty()) to_wgs84_.emplace(frame.crs_wkt, "EPSG:4326");
}

void GeojsonWriter::begin(const FeatureLayer& layer) {
  FARLOD_EXPECTS(keys_.empty());
  geometry_ = layer.geometry;
  for (const FeatureField& field : layer.fields) {
    std::string key = keys_.empty() ? "" : ", ";
    append_json_text(key, field.name);
    keys_.push_back(key + ": ");
  }
  stream_ << head_of(layer, provenance_);
}

void GeojsonWriter::add_place(Point2d p, std::optional<double> height_m) {
  places_.push_back(p);
  heights_.push_back(height_m);
}

std::size_t GeojsonWriter::add_ring(const std::vector<Point3d>& corners) {
  for (const Point3d& p : corners) add_place({p.x, p.y}, is_level(geometry_) ? std::nullopt : std::optional(p.z));
  return corners.size();
}

void GeojsonWriter::add(const FeatureRow& row) {
  FARLOD_EXPECTS(row.values.size() == keys_.size());
  Waiting feature;
  for (std::size_t n = 0; n < keys_.size(); ++n) {
    feature.properties += keys_[n];
    append_value(feature.properties, row.values[n]);
  }
  if (geometry_ == LayerGeometry::points) add_place(row.p_projected, row.height_m);
  for (const SurfacePolygon& p : row.polygons) {
    std::vector<std::size_t>& rings = feature.polygons.emplace_back();
    rings.push_back(add_ring(p.shell));
    for (const std::vector<Point3d>& hole : p.holes) rings.push_back(add_ring(hole));
  }
  waiting_.push_back(std::move(feature));
  if (places_.size() >= places_at_once) write_waiting();
}

void GeojsonWriter::append_place(std::string& json, std::size_t place) const {
  json += "[";
  append_degrees(json, places_[place].x);
  json += ", ";
  append_degrees(json, places_[place].y);
  if (heights_[place]) {
    json += ", ";
    append_millimetres(json, *heights_[place]);
  }
  json += "]";
}

void GeojsonWriter::append_ring(std::string& json, std::size_t first, std::size_t corners) const {
  json += "[";
  for (std::size_t n = 0; n < corners; ++n) {
    append_place(json, first + n);
    json += ", ";
  }
  append_place(json, first);
  json += "]";
}

void GeojsonWriter::append_rings(std::string& json, const std::vector<std::size_t>& corners_of_rings, std::size_t& place) const {
  json += "[";
  for (std::size_t r = 0; r < corners_of_rings.size(); ++r) {
    if (r > 0) json += ", ";
    append_ring(json, place, corners_of_rings[r]);
    place += corners_of_rings[r];
  }
  json += "]";
}

void GeojsonWriter::append_point(std::string& json, std::size_t place) const {
  if (std::isnan(places_[place].x)) {
    json += "null";
    return;
  }
  json += R"({"type": "Point", "coordinates": )";
  append_place(json, place);
  json += "}";
}

void GeojsonWriter::append_geometry(std::string& json, const Waiting& feature, std::size_t& place) const {
  if (geometry_ == LayerGeometry::points) {
    append_point(json, place++);
    return;
  }
  if (feature.polygons.empty()) {
    json += "null";
    return;
  }
  const bool is_area = geometry_ == LayerGeometry::areas;
  json += is_area ? R"({"type": "Polygon", "coordinates": )" : R"({"type": "MultiPolygon", "coordinates": [)";
  for (std::size_t n = 0; n < feature.polygons.size(); ++n) {
    if (n > 0) json += ", ";
    append_rings(json, feature.polygons[n], place);
  }
  json += is_area ? "}" : "]}";
}

void GeojsonWriter::write_waiting() {
  // Somebody's points may lie anywhere, and have no answers there
  if (to_wgs84_ && geometry_ == LayerGeometry::points)
    to_wgs84_->apply_each(places_);
  else if (to_wgs84_ && to_wgs84_->apply(places_))
    throw OutputError(file_.destination(), "a point lies where the CRS of the package has no longitude and latitude");
  std::string json;
  std::size_t place = 0;
  for (const Waiting& feature : waiting_) {
    json += written_++ == 0 ? "\n{\"type\": \"Feature\", \"properties\": {" : ",\n{\"type\": \"Feature\", \"properties\": {";
    json += feature.properties;
    json += "}, \"geometry\": ";
    append_geometry(json, feature, place);
    json += "}";
  }
  errno = 0;
  stream_ << json;
  if (!stream_) refuse(file_);
  places_.clear();
  heights_.clear();
  waiting_.clear();
}

void GeojsonWriter::commit() {
  write_waiting();
  errno = 0;
  stream_ << "\n]}\n";
  stream_.close();
  if (!stream_) refuse(file_);
  file_.commit();
}

}  // namespace

std::unique_ptr<FeatureWriter> geojson_writer(const TableFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<GeojsonWriter>(frame, path);
}

}  // namespace farlod
