// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "gdal/height_raster_gdal.hpp"

#include <cpl_error.h>
#include <gdal_utils.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>
#include <utility>

#include "farlod/error.hpp"

namespace farlod {
void refuse_raster(const std::filesystem::path& file, const std::string& what) {
  const std::string reason = CPLGetLastErrorMsg();
  throw InputError(file.string() + ": " + what + (reason.empty() ? "" : " (" + reason + ")"));
}

GDALDatasetUniquePtr open_height_raster(GdalReach reach, const std::filesystem::path& file, const std::string& what_it_is_not,
                                        const RasterChoice& choice) {
  CPLErrorReset();
  GDALDatasetUniquePtr dataset = chosen_raster(open_within(reach, file, GDAL_OF_RASTER), file, choice);
  if (!dataset || dataset->GetRasterCount() < 1) refuse_raster(file, what_it_is_not);
  GDALRasterBand& band = *dataset->GetRasterBand(1);
  if (dataset->GetRasterCount() >= 3 && band.GetRasterDataType() == GDT_Byte && band.GetColorInterpretation() == GCI_RedBand)
    refuse_raster(file, "is a picture of red, green and blue, and has no heights");
  return dataset;
}

GeoTransform geo_transform_of(GDALDataset& dataset, const std::filesystem::path& file) {
  GeoTransform t{};
  if (dataset.GetGeoTransform(t.data()) != CE_None)
    refuse_raster(file, "has no place on the map: give it one with gdal_translate -a_ullr, or a world file");
  return t;
}

std::optional<double> named_unit_m(GDALRasterBand& band) {
  constexpr double us_survey_foot_m = 1200.0 / 3937.0, foot_m = 0.3048;
  struct Unit {
    double metres;
    std::array<const char*, 6> names;
  };
  constexpr std::array units{
      Unit{us_survey_foot_m, {"ftUS", "us-ft", "US survey foot", "US survey feet", "Foot_US", "us_survey_feet"}},
      Unit{foot_m, {"ft", "foot", "feet", "international foot"}},
      Unit{1.0, {"m", "metre", "metres", "meter", "meters"}},
      Unit{0.1, {"dm", "decimetre", "decimetres", "decimeter", "decimeters"}},
      Unit{0.01, {"cm", "centimetre", "centimetres", "centimeter", "centimeters"}},
      Unit{0.001, {"mm", "millimetre", "millimetres", "millimeter", "millimeters"}},
      Unit{1000.0, {"km", "kilometre", "kilometres", "kilometer", "kilometers"}}};
  const std::string text = band.GetUnitType();
  for (const Unit& unit : units)
    for (const char* name : unit.names)
      if (name != nullptr && EQUAL(text.c_str(), name)) return unit.metres;
  return std::nullopt;
}

GDALDatasetUniquePtr warped_raster(GDALDataset& dataset, const WarpWay& way) {
  // A scale of 1 keeps GDAL from widening the kernel where pixels get larger, which would change slopes
  std::vector<std::string> words{"-of",          "VRT", "-s_srs", way.from_wkt, "-t_srs",  way.to_wkt, "-r",
                                 way.resampling, "-et", "0",      "-ot",        "Float64", "-wt",      "Float64",
                                 "-dstnodata",   "nan", "-wo",    "XSCALE=1",   "-wo",     "YSCALE=1"};
  if (way.step) words.insert(words.end(), {"-tr", std::to_string(*way.step), std::to_string(*way.step)});
  if (way.extent) {
    const auto& [low, high] = *way.extent;
    words.insert(words.end(),
                 {"-te", std::to_string(low.x), std::to_string(low.y), std::to_string(high.x), std::to_string(high.y)});
  }
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const std::unique_ptr<GDALWarpAppOptions, void (*)(GDALWarpAppOptions*)> options(
      GDALWarpAppOptionsNew(arguments.data(), nullptr), GDALWarpAppOptionsFree);
  GDALDatasetH source = GDALDataset::ToHandle(&dataset);
  return GDALDatasetUniquePtr(GDALDataset::FromHandle(GDALWarp("", nullptr, 1, &source, options.get(), nullptr)));
}

bool read_pixels(GDALRasterBand& band, int column, int row, std::vector<double>& values) {
  const int count = static_cast<int>(values.size());
  std::vector<unsigned char> mask(values.size());
  if (band.RasterIO(GF_Read, column, row, count, 1, values.data(), count, 1, GDT_Float64, 0, 0, nullptr) != CE_None ||
      band.GetMaskBand()->RasterIO(GF_Read, column, row, count, 1, mask.data(), count, 1, GDT_Byte, 0, 0, nullptr) != CE_None)
    return false;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (mask[k] == 0 || !std::isfinite(values[k])) values[k] = std::numeric_limits<double>::quiet_NaN();
  return true;
}

void forget_old_blocks() {
  constexpr GIntBig kept_bytes = GIntBig{16} << 20U;
  while (GDALGetCacheUsed64() > kept_bytes && GDALFlushCacheBlock() != FALSE) {
  }
}

}  // namespace farlod
