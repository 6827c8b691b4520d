// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cerrno>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

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
  void write_waiting();

  Provenance provenance_;
  AtomicFile file_;
  std::ofstream stream_;
  std::optional<Reprojection> to_wgs84_;
  std::vector<std::string> keys_;  ///< of the fields, as they are written
  // Features that wait: many places are transformed at a time
  std::vector<Point2d> places_;
  std::vector<std::optional<double>> heights_;
  std::vector<std::string> properties_;
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
  for (const FeatureField& field : layer.fields) {
    std::string key = keys_.empty() ? "" : ", ";
    append_json_text(key, field.name);
    keys_.push_back(key + ": ");
  }
  stream_ << head_of(layer, provenance_);
}

void GeojsonWriter::add(const FeatureRow& row) {
  FARLOD_EXPECTS(row.values.size() == keys_.size());
  std::string json;
  for (std::size_t n = 0; n < keys_.size(); ++n) {
    json += keys_[n];
    append_value(json, row.values[n]);
  }
  places_.push_back(row.p_projected);
  heights_.push_back(row.height_m);
  properties_.push_back(std::move(json));
  if (places_.size() == places_at_once) write_waiting();
}

void GeojsonWriter::write_waiting() {
  if (to_wgs84_ && to_wgs84_->apply(places_))
    throw OutputError(file_.destination(), "a point lies where the CRS of the package has no longitude and latitude");
  std::string json;
  for (std::size_t n = 0; n < places_.size(); ++n) {
    json += written_++ == 0 ? "\n{\"type\": \"Feature\", \"properties\": {" : ",\n{\"type\": \"Feature\", \"properties\": {";
    json += properties_[n];
    json += "}, \"geometry\": {\"type\": \"Point\", \"coordinates\": [";
    append_degrees(json, places_[n].x);
    json += ", ";
    append_degrees(json, places_[n].y);
    if (heights_[n]) {
      json += ", ";
      append_millimetres(json, *heights_[n]);
    }
    json += "]}}";
  }
  errno = 0;
  stream_ << json;
  if (!stream_) refuse(file_);
  places_.clear();
  heights_.clear();
  properties_.clear();
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
