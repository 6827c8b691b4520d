// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "results/table/feature_writer.hpp"
#include "results/table/table_writer.hpp"

namespace farlod {

/// Writes layers by GDAL, in the CRS of the frame:
///   (1) Places are points with three coordinates, rounded to the millimetre. z is NaN where the height is not known.
///   (2) Fields are text, 64-bit integers or doubles, and null where a feature has no value.
///   (3) The same features give the same bytes. What a file calls its date is 1 January 1970, or OGR_CURRENT_DATE where the
///       environment has it.
class GdalFeatureWriter : public FeatureWriter {
 public:
  enum class Format {
    geopackage,  ///< any number of layers without spatial index, and the frame's provenance as metadata
    flatgeobuf   ///< one layer with a spatial index, whose order its features have
  };
  GdalFeatureWriter(Format format, const TableFrame& frame, const std::filesystem::path& path);
  ~GdalFeatureWriter() override;
  void begin(const FeatureLayer& layer) override;
  void add(const FeatureRow& row) override;
  void commit() override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace farlod
