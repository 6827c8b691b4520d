// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/raster_stand_ins_gdal.hpp"

#include <gdal_priv.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "city/city_model.hpp"
#include "farlod/error.hpp"
#include "gdal/cleared_raster_gdal.hpp"
#include "gdal/height_raster_gdal.hpp"
#include "georeference/resolved_source.hpp"

namespace farlod::georeference {

void report_stand_in(const std::string& file, const Crs& own, const StandInOfFile& found, const std::string& how_many,
                     Report& report) {
  std::ostringstream text;
  text.precision(9);
  text << found.number << " is no height here, and counts as no data (" << how_many << "the first at " << place_text(found.place)
       << "); gdal_edit.py -a_nodata " << found.number << " declares it";
  Problem problem{ProblemCode::undeclared_no_data, file, "the whole file", std::move(text).str(),
                  Point3d{found.place.x, found.place.y, 0.0}};
  ProblemLocator(own, FileAxes{}, found.place).locate(problem);
  report.add(std::move(problem));
}

void require_metres(const std::string& file, std::span<const plausibility::StandIn> stand_ins,
                    std::span<const std::optional<float>> left_m) {
  const auto left = std::count_if(left_m.begin(), left_m.end(), [](const auto& m) { return m.has_value(); });
  if (const auto sign = plausibility::sign_of_another_unit(stand_ins, static_cast<std::size_t>(left)))
    throw InputError(file + ": " + *sign + ".");
}

namespace {

/// Pixels along a side of a raster, in runs that lie in one block each where blocks are small beside the raster: all blocks of a
/// large one would take as long as reading it.
std::vector<std::vector<int>> sampled_runs(int length, int block) {
  constexpr int runs = 64, of_run = 8;
  std::vector<std::vector<int>> all;
  if (length <= runs * of_run) {
    all.emplace_back(static_cast<std::size_t>(length));
    std::iota(all.front().begin(), all.front().end(), 0);
    return all;
  }
  const double apart = static_cast<double>(length) / runs;
  const bool is_in_blocks = block >= of_run && block < apart;
  for (int n = 0; n < runs; ++n) {
    const int middle = static_cast<int>((n + 0.5) * apart);
    const double first = is_in_blocks ? middle - middle % block : n * apart;
    const double end = is_in_blocks ? std::min<double>(first + block, length) : first + apart;
    std::vector<int>& run = all.emplace_back();
    for (int k = 0; k < of_run; ++k) run.push_back(static_cast<int>(first + (k + 0.5) * (end - first) / of_run));
  }
  return all;
}

/// Samples of the first band, with their pixels.
struct RasterSamples {
  std::vector<double> numbers;
  std::vector<bool> have_data;
  std::vector<Point2d> pixels;  ///< their middles

  /// Returns false where the raster cannot be read.
  bool add_run(GDALRasterBand& band, const std::vector<int>& columns, int row) {
    const int first = columns.front(), count = columns.back() - first + 1;
    std::vector<double> values(static_cast<std::size_t>(count));
    std::vector<unsigned char> mask(values.size());
    const auto read = [&](GDALRasterBand& from, void* to, GDALDataType type) {
      return from.RasterIO(GF_Read, first, row, count, 1, to, count, 1, type, 0, 0, nullptr) == CE_None;
    };
    if (!read(band, values.data(), GDT_Float64) || !read(*band.GetMaskBand(), mask.data(), GDT_Byte)) return false;
    for (const int column : columns) {
      const auto at = static_cast<std::size_t>(column - first);
      numbers.push_back(values[at]);
      have_data.push_back(mask[at] != 0);
      pixels.push_back({column + 0.5, row + 0.5});
    }
    return true;
  }
};

/// Empty where it cannot be read.
RasterSamples samples_of(GDALRasterBand& band) {
  RasterSamples samples;
  int block_columns = 0, block_rows = 0;
  band.GetBlockSize(&block_columns, &block_rows);
  const auto columns = sampled_runs(band.GetXSize(), block_columns);
  for (const std::vector<int>& rows : sampled_runs(band.GetYSize(), block_rows))
    for (const std::vector<int>& run : columns) {
      for (const int row : rows)
        if (!samples.add_run(band, run, row)) return {};
      forget_old_blocks();
    }
  return samples;
}

}  // namespace

std::vector<StandInOfFile> sampled_stand_ins(const PlacedRaster& raster, plausibility::HeightsOf of) {
  const RasterSamples samples = samples_of(*raster.file->GetRasterBand(1));
  std::vector<std::optional<float>> heights_m;
  for (std::size_t n = 0; n < samples.numbers.size(); ++n)
    heights_m.push_back(samples.have_data[n] ? raster.height_m(samples.numbers[n]) : std::nullopt);
  const auto stand_ins = plausibility::take_out_stand_ins(heights_m, of);
  require_metres(raster.path.string(), stand_ins, heights_m);
  std::vector<StandInOfFile> found;
  for (const plausibility::StandIn& stand_in : stand_ins) {
    const Point2d pixel = samples.pixels[stand_in.first];
    found.push_back({samples.numbers[stand_in.first], raster.frame().place(pixel.x, pixel.y)});
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
