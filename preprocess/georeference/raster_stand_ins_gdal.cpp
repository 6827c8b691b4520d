// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/raster_stand_ins_gdal.hpp"

#include <gdal_priv.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <sstream>
#include <utility>

#include "city/city_model.hpp"
#include "gdal/cleared_raster_gdal.hpp"
#include "gdal/height_raster_gdal.hpp"
#include "georeference/resolved_source.hpp"

namespace farlod::georeference {

void report_stand_in(const std::string& file, const Crs& own, const StandInOfFile& found, const std::string& where,
                     Report& report) {
  std::ostringstream text;
  text.precision(9);
  text << where << found.number << " is no height here, and counts as no data; gdal_edit.py -a_nodata " << found.number
       << " declares it";
  Problem problem{ProblemCode::undeclared_no_data, file, "band 1", std::move(text).str(),
                  Point3d{found.place.x, found.place.y, 0.0}};
  ProblemLocator(own, FileAxes{}, found.place).locate(problem);
  report.add(std::move(problem));
}

namespace {

/// Every n-th pixel of a row.
bool read_row(GDALRasterBand& band, int row, void* to, int columns, GDALDataType type) {
  return band.RasterIO(GF_Read, 0, row, band.GetXSize(), 1, to, columns, 1, type, 0, 0, nullptr) == CE_None;
}

}  // namespace

std::vector<StandInOfFile> sampled_stand_ins(const PlacedRaster& raster, plausibility::HeightsOf of) {
  constexpr int most = 512;
  GDALRasterBand& band = *raster.file->GetRasterBand(1);
  const int columns = std::min(band.GetXSize(), most), rows = std::min(band.GetYSize(), most);
  std::vector<std::optional<float>> heights_m;
  std::vector<double> numbers(static_cast<std::size_t>(columns)), all;
  std::vector<unsigned char> mask(numbers.size());
  for (int n = 0; n < rows; ++n) {
    const int row = static_cast<int>((2 * std::int64_t{n} + 1) * band.GetYSize() / (2 * std::int64_t{rows}));
    if (!read_row(band, row, numbers.data(), columns, GDT_Float64) ||
        !read_row(*band.GetMaskBand(), row, mask.data(), columns, GDT_Byte))
      return {};
    for (std::size_t k = 0; k < numbers.size(); ++k)
      heights_m.push_back(mask[k] == 0 ? std::nullopt : raster.height_m(numbers[k]));
    all.insert(all.end(), numbers.begin(), numbers.end());
    forget_old_blocks();
  }
  std::vector<StandInOfFile> found;
  for (const plausibility::StandIn& stand_in : plausibility::take_out_stand_ins(heights_m, of)) {
    const std::size_t row = stand_in.first / static_cast<std::size_t>(columns),
                      column = stand_in.first % static_cast<std::size_t>(columns);
    found.push_back({all[stand_in.first], raster.frame().place((static_cast<double>(column) + 0.5) * band.GetXSize() / columns,
                                                               (static_cast<double>(row) + 0.5) * band.GetYSize() / rows)});
  }
  return found;
}

void clear_stand_ins(PlacedRaster& raster, plausibility::HeightsOf of, const Crs& own, Report& report) {
  std::vector<double> numbers;
  for (const StandInOfFile& found : sampled_stand_ins(raster, of)) {
    report_stand_in(raster.path.string(), own, found, "", report);
    numbers.push_back(found.number);
  }
  if (numbers.empty()) return;
  raster.cleared = cleared_raster(*raster.file, [numbers, scale = raster.scale](double number) {
    return !may_be_elevation(scale.metres(number)) || std::find(numbers.begin(), numbers.end(), number) != numbers.end();
  });
}

}  // namespace farlod::georeference
