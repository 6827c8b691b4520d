// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/raster_writer_gdal.hpp"

#include <gdal_frmts.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>

#include "base/expects.hpp"
#include "farlod/error.hpp"
#include "farlod/version.hpp"
#include "gdal/gdal_errors.hpp"
#include "results/atomic_file.hpp"
#include "results/crs_gdal.hpp"

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

}  // namespace

struct GeotiffWriter::Impl {
  RasterFrame frame;
  AtomicFile file;
  std::optional<AtomicFile> spool;  // removed after the dataset is closed
  GDALDatasetUniquePtr dataset;

  Impl(const RasterFrame& raster, const std::filesystem::path& path)
      : frame(raster), file(path), spool(path.string() + ".spool") {}

  void throw_if_any(const GdalErrors& errors) const {
    if (errors.any()) throw OutputError(file.destination(), errors.last());
  }
};

GeotiffWriter::GeotiffWriter(const RasterFrame& frame, const std::filesystem::path& path)
    : impl_(std::make_unique<Impl>(frame, path)) {
  const GdalErrors errors;
  impl_->dataset = create_spool(frame, impl_->file, *impl_->spool, errors);
  GDALDataset& dataset = *impl_->dataset;
  place(dataset, frame);
  describe(dataset, frame);
  int block_columns = 0, block_rows = 0;
  dataset.GetRasterBand(1)->GetBlockSize(&block_columns, &block_rows);
  FARLOD_EXPECTS(block_columns == raster_tile_edge && block_rows == raster_tile_edge);
  impl_->throw_if_any(errors);
}

GeotiffWriter::~GeotiffWriter() {
  const GdalErrors nobody_hears;  // of a file that is given up
  impl_->dataset.reset();
}

void GeotiffWriter::write(const RasterTile& tile) {
  const GdalErrors errors;
  const std::vector<std::span<const float>> bands = bands_of(tile);
  FARLOD_EXPECTS(bands.size() == impl_->frame.bands.size());
  for (std::size_t n = 0; n < bands.size(); ++n)
    write_block(*impl_->dataset->GetRasterBand(static_cast<int>(n) + 1), tile.place, bands[n]);
  impl_->throw_if_any(errors);
}

void GeotiffWriter::commit() {
  const GdalErrors errors;
  // A full disk may show only now
  impl_->dataset->FlushCache();
  impl_->throw_if_any(errors);
  {
    const SmallCache cache;
    const GDALDatasetUniquePtr result(driver_called("COG", impl_->file)
                                          .CreateCopy(impl_->file.temporary().c_str(), impl_->dataset.get(), TRUE,
                                                      options_of_result(impl_->frame).List(), nullptr, nullptr));
    impl_->dataset.reset();
  }
  impl_->spool.reset();
  impl_->throw_if_any(errors);
  impl_->file.commit();
}

}  // namespace farlod
