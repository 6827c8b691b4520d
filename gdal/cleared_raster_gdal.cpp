// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "gdal/cleared_raster_gdal.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace farlod {
namespace {

class ClearedBand final : public GDALRasterBand {
 public:
  ClearedBand(GDALDataset& owner, GDALRasterBand& band, std::function<bool(double)> is_none)
      : band_(band), is_none_(std::move(is_none)) {
    poDS = &owner;
    nBand = 1;
    eDataType = GDT_Float64;
    nRasterXSize = band.GetXSize();
    nRasterYSize = band.GetYSize();
    band.GetBlockSize(&nBlockXSize, &nBlockYSize);
  }
  double GetNoDataValue(int* has_one) override {
    if (has_one != nullptr) *has_one = 1;
    return std::numeric_limits<double>::quiet_NaN();
  }

 protected:
  CPLErr IReadBlock(int block_column, int block_row, void* pixels) override {
    const int column = block_column * nBlockXSize, row = block_row * nBlockYSize;
    const int columns = std::min(nBlockXSize, nRasterXSize - column), rows = std::min(nBlockYSize, nRasterYSize - row);
    auto* const numbers = static_cast<double*>(pixels);
    std::vector<unsigned char> mask(static_cast<std::size_t>(nBlockXSize) * static_cast<std::size_t>(nBlockYSize));
    if (band_.RasterIO(GF_Read, column, row, columns, rows, numbers, columns, rows, GDT_Float64, 0,
                       GSpacing{nBlockXSize} * GSpacing{sizeof(double)}, nullptr) != CE_None ||
        band_.GetMaskBand()->RasterIO(GF_Read, column, row, columns, rows, mask.data(), columns, rows, GDT_Byte, 0, nBlockXSize,
                                      nullptr) != CE_None)
      return CE_Failure;
    for (std::size_t n = 0; n < mask.size(); ++n)
      if (mask[n] == 0 || is_none_(numbers[n])) numbers[n] = std::numeric_limits<double>::quiet_NaN();
    return CE_None;
  }

 private:
  GDALRasterBand& band_;
  std::function<bool(double)> is_none_;
};

class ClearedRaster final : public GDALDataset {
 public:
  ClearedRaster(GDALDataset& raster, std::function<bool(double)> is_none) : raster_(raster) {
    nRasterXSize = raster.GetRasterXSize();
    nRasterYSize = raster.GetRasterYSize();
    // The dataset owns its bands. NOLINTNEXTLINE(cppcoreguidelines-owning-memory)
    SetBand(1, new ClearedBand(*this, *raster.GetRasterBand(1), std::move(is_none)));
  }
  CPLErr GetGeoTransform(double* transform) override { return raster_.GetGeoTransform(transform); }
  const OGRSpatialReference* GetSpatialRef() const override { return raster_.GetSpatialRef(); }

 private:
  GDALDataset& raster_;
};

}  // namespace

GDALDatasetUniquePtr cleared_raster(GDALDataset& raster, std::function<bool(double number)> is_none) {
  return GDALDatasetUniquePtr(std::make_unique<ClearedRaster>(raster, std::move(is_none)).release());
}

}  // namespace farlod
