// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cpl_conv.h>
#include <cpl_string.h>
#include <gdal_frmts.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "base/expects.hpp"
#include "farlod/error.hpp"
#include "farlod/version.hpp"
#include "gdal/gdal_errors.hpp"
#include "results/atomic_file.hpp"
#include "results/crs_gdal.hpp"
#include "results/raster/raster_writers.hpp"
#include "results/raster/zip_file.hpp"

namespace farlod {
namespace {

/// GDAL's cache is one for the process: it has its own size again when this is destroyed.
class SmallCache {
 public:
  SmallCache() : before_(GDALGetCacheMax64()) { GDALSetCacheMax64(std::min(before_, static_cast<GIntBig>(geotiff_cache_bytes))); }
  ~SmallCache() { GDALSetCacheMax64(before_); }
  SmallCache(const SmallCache&) = delete;
  SmallCache& operator=(const SmallCache&) = delete;

 private:
  GIntBig before_;
};

/// Tiles as they come, not compressed: a block that is as large on disk as in memory is written where it lies.
CPLStringList options_of_spool() {
  CPLStringList options;
  for (const char* option : {"TILED=YES", "INTERLEAVE=BAND", "SPARSE_OK=TRUE", "BIGTIFF=IF_SAFER"}) options.AddString(option);
  return options;
}

CPLStringList options_of_result(const RasterFrame& raster) {
  CPLStringList options;
  // Predictor 3 is the one for floats: it takes a sixth off what DEFLATE alone leaves. Level 5 takes two thirds of the time of
  // GDAL's default, 6, for files that are 1 % larger. Averages of overviews are over the pixels that have data
  for (const char* option : {"COMPRESS=DEFLATE", "PREDICTOR=FLOATING_POINT", "LEVEL=5", "BIGTIFF=IF_SAFER", "STATISTICS=NO",
                             "OVERVIEW_RESAMPLING=AVERAGE"})
    options.AddString(option);
  options.SetNameValue("BLOCKSIZE", std::to_string(geotiff_block_edge).c_str());
  // GDAL writes compressed blocks in the order in which they came
  options.SetNameValue("NUM_THREADS", std::to_string(raster.threads).c_str());
  return options;
}

/// Averages of two by two pixels, and so on until all fits into a block. The driver COG would make them in files of its own,
/// which take longer than a small map: it compresses each block with tables of megabytes.
void make_overviews(GDALDataset& dataset) {
  constexpr auto block_edge = static_cast<int>(geotiff_block_edge);
  std::vector<int> shrinks;
  for (int edge = std::max(dataset.GetRasterXSize(), dataset.GetRasterYSize()); edge > block_edge; edge /= 2)
    shrinks.push_back(shrinks.empty() ? 2 : 2 * shrinks.back());
  if (shrinks.empty()) return;
  const CPLErr refused =
      dataset.BuildOverviews("AVERAGE", static_cast<int>(shrinks.size()), shrinks.data(), 0, nullptr, nullptr, nullptr, nullptr);
  if (refused != CE_None && CPLGetLastErrorType() < CE_Failure) CPLError(CE_Failure, CPLE_FileIO, "overviews were refused");
}

GDALDriver& driver_called(const char* name, const AtomicFile& file) {
  GDALRegister_GTiff();  // all drivers would take longer than a small map
  GDALRegister_COG();
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(name);
  if (driver == nullptr) throw OutputError(file.destination(), "this GDAL cannot write GeoTIFF");
  return *driver;
}

GDALDatasetUniquePtr create_spool(const RasterFrame& raster, const AtomicFile& file, const AtomicFile& spool,
                                  const GdalErrors& errors) {
  constexpr auto largest = static_cast<std::size_t>(std::numeric_limits<int>::max());
  if (raster.columns > largest || raster.rows > largest)
    throw OutputError(file.destination(), "the raster has too many pixels along an edge");
  GDALDatasetUniquePtr dataset(driver_called("GTiff", file)
                                   .Create(spool.temporary().c_str(), static_cast<int>(raster.columns),
                                           static_cast<int>(raster.rows), static_cast<int>(raster.bands.size()), GDT_Float32,
                                           options_of_spool().List()));
  if (dataset == nullptr) throw OutputError(file.destination(), errors.last());
  return dataset;
}

void place(GDALDataset& dataset, const RasterFrame& raster) {
  std::array<double, 6> geotransform{raster.north_west_m.x, raster.step_m, 0.0, raster.north_west_m.y, 0.0, -raster.step_m};
  dataset.SetGeoTransform(geotransform.data());
  if (raster.crs_wkt.empty()) return;
  OGRSpatialReference crs;
  if (read_crs(crs, raster.crs_wkt, raster.epsg)) dataset.SetSpatialRef(&crs);
}

void describe(GDALDataset& dataset, const RasterFrame& raster) {
  dataset.SetMetadataItem("TIFFTAG_SOFTWARE", (std::string("Far-LoD ") + software_version).c_str());
  dataset.SetMetadataItem("TIFFTAG_IMAGEDESCRIPTION", raster.bands.front().definition.c_str());
  for (const auto& [name, value] : entries_of(raster.provenance)) dataset.SetMetadataItem(name.c_str(), value.c_str());
  for (std::size_t n = 0; n < raster.bands.size(); ++n) {
    GDALRasterBand& band = *dataset.GetRasterBand(static_cast<int>(n) + 1);
    band.SetDescription(raster.bands[n].name.c_str());
    band.SetUnitType(raster.bands[n].unit.c_str());
    band.SetMetadataItem("definition", raster.bands[n].definition.c_str());
    band.SetNoDataValue(std::numeric_limits<double>::quiet_NaN());
  }
}

/// Not through GDAL's cache of blocks, which may take a twentieth of the machine's memory and writes when it likes.
void write_block(GDALRasterBand& band, TilePlace place, std::span<const float> values) {
  // WriteBlock does not change what it writes, but its parameter does not say so
  const CPLErr refused =
      band.WriteBlock(static_cast<int>(place.column), static_cast<int>(place.row), const_cast<float*>(values.data()));
  if (refused != CE_None && CPLGetLastErrorType() < CE_Failure) CPLError(CE_Failure, CPLE_FileIO, "the pixels were refused");
}

class GeotiffWriter final : public RasterWriter {
 public:
  GeotiffWriter(const RasterFrame& frame, const std::filesystem::path& path)
      : frame_(frame), file_(path), spool_(path.string() + ".spool") {
    const GdalErrors errors;
    dataset_ = create_spool(frame, file_, *spool_, errors);
    place(*dataset_, frame);
    describe(*dataset_, frame);
    int block_columns = 0, block_rows = 0;
    dataset_->GetRasterBand(1)->GetBlockSize(&block_columns, &block_rows);
    FARLOD_EXPECTS(block_columns == raster_tile_edge && block_rows == raster_tile_edge);
    throw_if_any(errors);
  }
  ~GeotiffWriter() override {
    const GdalErrors nobody_hears;  // of a file that is given up
    dataset_.reset();
  }
  void write(const RasterTile& tile) override {
    const GdalErrors errors;
    const std::vector<std::span<const float>> bands = bands_of(tile);
    FARLOD_EXPECTS(bands.size() == frame_.bands.size());
    for (std::size_t n = 0; n < bands.size(); ++n)
      write_block(*dataset_->GetRasterBand(static_cast<int>(n) + 1), tile.place, bands[n]);
    throw_if_any(errors);
  }
  void commit() override {
    const GdalErrors errors;
    // A full disk may show only now
    dataset_->FlushCache();
    throw_if_any(errors);
    {
      const SmallCache cache;
      make_overviews(*dataset_);
      throw_if_any(errors);
      const GDALDatasetUniquePtr result(
          driver_called("COG", file_)
              .CreateCopy(file_.temporary().c_str(), dataset_.get(), TRUE, options_of_result(frame_).List(), nullptr, nullptr));
      dataset_.reset();
    }
    spool_.reset();
    throw_if_any(errors);
    file_.commit();
  }

 private:
  void throw_if_any(const GdalErrors& errors) const {
    if (errors.any()) throw OutputError(file_.destination(), errors.last());
  }

  RasterFrame frame_;
  AtomicFile file_;
  std::optional<AtomicFile> spool_;  // removed after the dataset is closed
  GDALDatasetUniquePtr dataset_;
};

RasterFrame frame_of_band(const RasterFrame& frame, std::size_t band) {
  RasterFrame one = frame;
  one.bands = {frame.bands[band]};
  return one;
}

RasterTile tile_of_band(TilePlace place, std::span<const float> values) {
  RasterTile tile(place, RasterBands::svf);
  tile.svf.assign(values.begin(), values.end());
  return tile;
}

/// GeoTIFFs are stored as they are: their blocks are compressed already.
class ZippedGeotiffWriter final : public RasterWriter {
 public:
  ZippedGeotiffWriter(const RasterFrame& frame, const std::filesystem::path& path)
      : file_(path, ".zip"), folder_(path.string() + ".bands") {
    std::error_code error;
    std::filesystem::create_directory(folder_.temporary(), error);
    if (error) throw OutputError(path, error.message());
    for (std::size_t n = 0; n < frame.bands.size(); ++n) {
      paths_.push_back(folder_.temporary() / (frame.bands[n].name + ".tif"));
      bands_.push_back(geotiff_writer(frame_of_band(frame, n), paths_.back()));
    }
  }
  void write(const RasterTile& tile) override {
    const std::vector<std::span<const float>> values = bands_of(tile);
    FARLOD_EXPECTS(values.size() == bands_.size());
    for (std::size_t n = 0; n < values.size(); ++n) bands_[n]->write(tile_of_band(tile.place, values[n]));
  }
  void commit() override {
    ZipFile zip(file_.temporary(), file_.destination());
    for (std::size_t n = 0; n < bands_.size(); ++n) {
      bands_[n]->commit();
      bands_[n].reset();
      zip.add(paths_[n]);
      std::error_code is_removed_later;
      std::filesystem::remove(paths_[n], is_removed_later);
    }
    zip.close();
    file_.commit();
  }

 private:
  AtomicFile file_;
  AtomicFolder folder_;  ///< of the bands
  std::vector<std::filesystem::path> paths_;
  std::vector<std::unique_ptr<RasterWriter>> bands_;
};

}  // namespace

std::unique_ptr<RasterWriter> geotiff_writer(const RasterFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<GeotiffWriter>(frame, path);
}

std::unique_ptr<RasterWriter> zipped_geotiff_writer(const RasterFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<ZippedGeotiffWriter>(frame, path);
}

}  // namespace farlod
