// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/raster_writer_solweig.hpp"

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

#include "base/expects.hpp"
#include "farlod/error.hpp"
#include "results/gdal_files.hpp"
#include "results/raster/raster_writers.hpp"
#include "results/raster/surface_rasters.hpp"

namespace farlod {
namespace {

constexpr const char* svfs_name = "svfs.zip";  ///< tells what the folder is
constexpr const char* shadows_name = "shadowmats.npz";

/// The place of the shadow patches among the bands; the number of bands where they are not.
std::size_t first_shadow_band(const std::vector<Band>& bands) {
  static const std::string name = columns_of({.shadow_patches = true}).front();
  return static_cast<std::size_t>(std::ranges::find(bands, name, &Band::name) - bands.begin());
}

RasterFrame without_shadows(RasterFrame frame) {
  const auto first = frame.bands.begin() + static_cast<std::ptrdiff_t>(first_shadow_band(frame.bands));
  if (first != frame.bands.end()) frame.bands.erase(first, first + shadow_column_count);
  return frame;
}

/// `further` is the first of the shadow patches among RasterTile::further.
RasterTile without_shadows(const RasterTile& tile, std::size_t further) {
  RasterTile other(tile.place, tile.low.empty() ? RasterBands::svf : RasterBands::svf_and_bounds);
  other.svf = tile.svf;
  other.low = tile.low;
  other.high = tile.high;
  const auto first = tile.further.begin() + static_cast<std::ptrdiff_t>(further);
  other.further.assign(tile.further.begin(), first);
  other.further.insert(other.further.end(), first + shadow_column_count, tile.further.end());
  return other;
}

/// A name that is taken by something else is found before the work, which takes hours.
const std::filesystem::path& usable(const std::filesystem::path& path) {
  std::error_code nothing_there;
  if (std::filesystem::exists(path, nothing_there) && !std::filesystem::exists(path / svfs_name, nothing_there))
    throw OutputError(path, "it is there already, and no folder for SOLWEIG; choose another name");
  return path;
}

}  // namespace

SolweigWriter::SolweigWriter(const RasterFrame& frame, const std::filesystem::path& path)
    : frame_(frame), folder_(usable(path)), shadow_band_(first_shadow_band(frame.bands)) {
  std::error_code error;
  std::filesystem::create_directory(folder_.temporary(), error);
  if (error) throw OutputError(path, error.message());
  if (shadow_band_ < frame.bands.size()) shadows_.emplace(frame, path);
  svfs_ = gdal_files().zipped_geotiffs(without_shadows(frame), folder_.temporary() / svfs_name);
}

void SolweigWriter::write(const RasterTile& tile) {
  if (!shadows_) return svfs_->write(tile);
  const std::vector<std::span<const float>> bands = bands_of(tile);
  shadows_->add(tile.place, std::span(bands).subspan(shadow_band_, shadow_column_count));
  svfs_->write(without_shadows(tile, shadow_band_ - (bands.size() - tile.further.size())));
}

void SolweigWriter::write_shadow_matrices() {
  NpzFile file(folder_.temporary() / shadows_name, folder_.destination(), frame_.threads);
  for (const ShadowMatrix matrix : {ShadowMatrix::building, ShadowMatrix::vegetation, ShadowMatrix::vegetation_before_building})
    file.add(shadows_->matrix(matrix));
  file.close();
  shadows_.reset();
}

void SolweigWriter::commit() {
  svfs_->commit();
  svfs_.reset();
  if (shadows_) write_shadow_matrices();
  if (frame_.package != nullptr) write_surface_rasters(frame_, folder_.temporary());
  folder_.commit(svfs_name);
}

std::uint64_t SolweigWriter::bytes_for(const RasterFrame& frame) {
  // One file after the other
  std::uint64_t bytes = zipped_geotiff_bytes(without_shadows(frame)), spool_bytes = 0;
  if (first_shadow_band(frame.bands) < frame.bands.size()) {
    spool_bytes = ShadowSpool::bytes_for(frame);
    bytes = std::max(bytes, NpzFile::bytes_for(frame.columns * shadow_patch_count, frame.threads));
  }
  if (frame.package != nullptr) bytes = std::max(bytes, surface_rasters_bytes(frame));
  return bytes + spool_bytes;
}

}  // namespace farlod
