// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "results/table/feature_writer.hpp"
#include "results/table/table_writer.hpp"

namespace farlod {

/// Writes a layer of points to a netCDF-4 file after the CF conventions, version 1.8, as a discrete sampling geometry of the
/// feature type `point`: a variable for each field along the dimension `point`, with the coordinates `x_m`, `y_m` and `z_m`, and
/// `crs` as the grid mapping. Texts are rows of characters in UTF-8. Holds some thousand rows, however many there are.
class CfPointWriter : public FeatureWriter {
 public:
  CfPointWriter(const TableFrame& frame, const std::filesystem::path& path);
  ~CfPointWriter() override;
  void begin(const FeatureLayer& layer) override;
  void add(const FeatureRow& row) override;
  void commit() override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace farlod
