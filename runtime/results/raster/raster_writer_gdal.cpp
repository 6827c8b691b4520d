// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/raster_writer_gdal.hpp"

#include <gdal_frmts.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "contract/expects.hpp"
#include "farlod/error.hpp"
#include "farlod/version.hpp"
#include "gdal/gdal_errors.hpp"
#include "results/atomic_file.hpp"

namespace farlod {
namespace {

/// Compression takes about a tenth of the time that evaluation takes: more threads would wait.
std::size_t compression_threads(const RasterFrame& raster) {
  constexpr std::size_t per_compressing = 4;
  return raster.threads == 1 ? 1 : std::max<std::size_t>(2, raster.threads / per_compressing);
}

CPLStringList options_of(const RasterFrame& raster) {
  CPLStringList options;
  // Predictor 3 is the one for floats: it takes a sixth off what DEFLATE alone leaves. Level 5 takes two thirds of the time of
  // GDAL's default, 6, for files that are 1 % larger
  for (const char* option : {"TILED=YES", "COMPRESS=DEFLATE", "PREDICTOR=3", "ZLEVEL=5", "BIGTIFF=IF_SAFER"})
    options.AddString(option);
  // Who writes the tiles gives them to the answers of one cell after the other, and must not wait. GDAL writes compressed tiles
  // in the order in which they came
  options.SetNameValue("NUM_THREADS", std::to_string(compression_threads(raster)).c_str());
  return options;
}

GDALDatasetUniquePtr create_tiff(const RasterFrame& raster, const AtomicFile& file, const GdalErrors& errors) {
  GDALRegister_GTiff();  // all drivers would take longer than a small map
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  if (driver == nullptr) throw OutputError(file.destination(), "this GDAL cannot write GeoTIFF");
  const CPLStringList options = options_of(raster);
  constexpr auto largest = static_cast<std::size_t>(std::numeric_limits<int>::max());
  if (raster.columns > largest || raster.rows > largest)
    throw OutputError(file.destination(), "the raster has too many pixels along an edge");
  GDALDatasetUniquePtr dataset(driver->Create(file.temporary().c_str(), static_cast<int>(raster.columns),
                                              static_cast<int>(raster.rows), raster.bands == RasterBands::svf ? 1 : 3,
                                              GDT_Float32, options.List()));
  if (dataset == nullptr) throw OutputError(file.destination(), errors.last());
  return dataset;
}

void place(GDALDataset& dataset, const RasterFrame& raster) {
  std::array<double, 6> geotransform{raster.north_west_m.x, raster.step_m, 0.0, raster.north_west_m.y, 0.0, -raster.step_m};
  dataset.SetGeoTransform(geotransform.data());
  if (raster.crs_wkt.empty()) return;
  OGRSpatialReference crs;
  // Of a code PROJ knows the names already; for WKT it looks each of them up, which takes longer than a small map
  const bool is_known = raster.epsg && crs.importFromEPSG(*raster.epsg) == OGRERR_NONE;
  if (is_known || crs.importFromWkt(raster.crs_wkt.c_str()) == OGRERR_NONE)
    dataset.SetSpatialRef(&crs);
  else
    CPLError(CE_Failure, CPLE_AppDefined, "the coordinate reference system is not valid WKT");
}

void describe(GDALRasterBand& band, const std::string& name) {
  band.SetDescription(name.c_str());
  band.SetNoDataValue(std::numeric_limits<double>::quiet_NaN());
}

/// Not through GDAL's cache of blocks, which may take a twentieth of the machine's memory and writes when it likes.
void write_block(GDALRasterBand& band, TilePlace place, const std::vector<float>& values) {
  // WriteBlock does not change what it writes, but its parameter does not say so
  const CPLErr refused =
      band.WriteBlock(static_cast<int>(place.column), static_cast<int>(place.row), const_cast<float*>(values.data()));
  if (refused != CE_None && CPLGetLastErrorType() < CE_Failure) CPLError(CE_Failure, CPLE_FileIO, "the pixels were refused");
}

}  // namespace

struct GeotiffWriter::Impl {
  AtomicFile file;
  GDALDatasetUniquePtr dataset;

  explicit Impl(const std::filesystem::path& path) : file(path) {}

  void throw_if_any(const GdalErrors& errors) const {
    if (errors.any()) throw OutputError(file.destination(), errors.last());
  }
};

GeotiffWriter::GeotiffWriter(const RasterFrame& frame, const std::filesystem::path& path) : impl_(std::make_unique<Impl>(path)) {
  const GdalErrors errors;
  impl_->dataset = create_tiff(frame, impl_->file, errors);
  GDALDataset& dataset = *impl_->dataset;
  place(dataset, frame);
  dataset.SetMetadataItem("TIFFTAG_SOFTWARE", (std::string("Far-LoD ") + software_version).c_str());
  describe(*dataset.GetRasterBand(1), frame.quantity);
  if (frame.bands == RasterBands::svf_and_bounds) {
    describe(*dataset.GetRasterBand(2), frame.quantity + "_low");
    describe(*dataset.GetRasterBand(3), frame.quantity + "_high");
  }
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
  write_block(*impl_->dataset->GetRasterBand(1), tile.place, tile.svf);
  if (!tile.low.empty()) {
    write_block(*impl_->dataset->GetRasterBand(2), tile.place, tile.low);
    write_block(*impl_->dataset->GetRasterBand(3), tile.place, tile.high);
  }
  impl_->throw_if_any(errors);
}

std::uint64_t GeotiffWriter::bytes_for(const RasterFrame& frame) {
  const std::size_t threads = compression_threads(frame);
  // A tile as it came, and its compressed bytes, which may be as many. GDAL has one more in turn than it has threads
  constexpr std::uint64_t bytes_of_tile = 2 * raster_tile_edge * raster_tile_edge * sizeof(float);
  return threads == 1 ? 0 : (threads + 1) * bytes_of_tile;
}

void GeotiffWriter::commit() {
  const GdalErrors errors;
  // GDAL fills what did not come with the declared no-data value. A full disk may show only now.
  impl_->dataset.reset();
  impl_->throw_if_any(errors);
  impl_->file.commit();
}

}  // namespace farlod
