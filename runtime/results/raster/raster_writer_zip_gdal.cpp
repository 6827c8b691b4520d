// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/raster_writer_zip_gdal.hpp"

#include <cpl_conv.h>
#include <cpl_string.h>

#include <fstream>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "base/expects.hpp"
#include "farlod/error.hpp"
#include "gdal/gdal_errors.hpp"
#include "results/atomic_file.hpp"

namespace farlod {
namespace {

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

/// A ZIP file that is being written by GDAL.
class ZipFile {
 public:
  ZipFile(const std::filesystem::path& path, const std::filesystem::path& result)
      : result_(result), zip_(CPLCreateZip(path.c_str(), nullptr)) {
    if (zip_ == nullptr) fail();
  }
  ~ZipFile() {
    if (zip_ != nullptr) CPLCloseZip(zip_);
  }
  ZipFile(const ZipFile&) = delete;
  ZipFile& operator=(const ZipFile&) = delete;

  /// The file as it is: the blocks of a GeoTIFF are compressed already.
  void add(const std::filesystem::path& file) {
    CPLStringList options;
    options.SetNameValue("COMPRESSED", "NO");
    options.SetNameValue("TIMESTAMP", "315532800");  // the first second that a ZIP file can name, where GDAL asks (3.7 and later)
    must(CPLCreateFileInZip(zip_, file.filename().c_str(), options.List()));
    std::ifstream bytes(file, std::ios::binary);
    std::vector<char> piece(ZippedGeotiffWriter::bytes_at_once);
    while (bytes.read(piece.data(), static_cast<std::streamsize>(piece.size())) || bytes.gcount() > 0)
      must(CPLWriteFileInZip(zip_, piece.data(), static_cast<int>(bytes.gcount())));
    if (!bytes.eof()) fail();
    must(CPLCloseFileInZip(zip_));
  }
  void close() {
    void* const zip = zip_;
    zip_ = nullptr;
    must(CPLCloseZip(zip));
  }

 private:
  void must(CPLErr error) const {
    if (error != CE_None) fail();
  }
  [[noreturn]] void fail() const { throw OutputError(result_, errors_.any() ? errors_.last() : "the disk refused the data"); }

  GdalErrors errors_;
  std::filesystem::path result_;
  void* zip_;
};

}  // namespace

struct ZippedGeotiffWriter::Impl {
  AtomicFile file;
  AtomicFolder folder;  ///< of the bands
  std::vector<std::filesystem::path> paths;
  std::vector<std::unique_ptr<GeotiffWriter>> bands;

  Impl(const RasterFrame& frame, const std::filesystem::path& path) : file(path, ".zip"), folder(path.string() + ".bands") {
    std::error_code error;
    std::filesystem::create_directory(folder.temporary(), error);
    if (error) throw OutputError(path, error.message());
    for (std::size_t n = 0; n < frame.bands.size(); ++n) {
      paths.push_back(folder.temporary() / (frame.bands[n].name + ".tif"));
      bands.push_back(std::make_unique<GeotiffWriter>(frame_of_band(frame, n), paths.back()));
    }
  }
};

ZippedGeotiffWriter::ZippedGeotiffWriter(const RasterFrame& frame, const std::filesystem::path& path)
    : impl_(std::make_unique<Impl>(frame, path)) {}

ZippedGeotiffWriter::~ZippedGeotiffWriter() = default;

void ZippedGeotiffWriter::write(const RasterTile& tile) {
  const std::vector<std::span<const float>> values = bands_of(tile);
  FARLOD_EXPECTS(values.size() == impl_->bands.size());
  for (std::size_t n = 0; n < values.size(); ++n) impl_->bands[n]->write(tile_of_band(tile.place, values[n]));
}

void ZippedGeotiffWriter::commit() {
  ZipFile zip(impl_->file.temporary(), impl_->file.destination());
  for (std::size_t n = 0; n < impl_->bands.size(); ++n) {
    impl_->bands[n]->commit();
    impl_->bands[n].reset();
    zip.add(impl_->paths[n]);
    std::error_code is_removed_later;
    std::filesystem::remove(impl_->paths[n], is_removed_later);
  }
  zip.close();
  impl_->file.commit();
}

}  // namespace farlod
