// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "inputs/reproject_gdal.hpp"
#include "results/atomic_file.hpp"
#include "results/table/feature_writer.hpp"
#include "results/table/table_writer.hpp"

namespace farlod {

/// Writes one layer as GeoJSON (RFC 7946):
///   (1) Coordinates are longitude and latitude in WGS 84 with eight digits after the point, which is a millimetre. The third is
///       the height as the package has it; there is none where it is not known. Without a CRS, coordinates stay as they are.
///   (2) Properties are all fields of the layer; null where a feature has no value.
///   (3) The frame's provenance is a member of the collection, which readers that do not know it skip.
class GeojsonWriter : public FeatureWriter {
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

}  // namespace farlod
