// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/spool_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <string>
#include <system_error>
#include <type_traits>

#include "base/expects.hpp"
#include "farlod/error.hpp"

namespace farlod {
namespace {

/// The stream does not say why it failed; the system's last error does.
std::string reason() { return errno != 0 ? std::generic_category().message(errno) : "the disk refused the data"; }

/// What a row has besides the name of its building, which stands behind it.
struct FixedPart {
  std::uint64_t name_bytes;
  std::uint32_t surface;
  SurfaceKind kind;
  Point3d p_projected;
  double azimuth_radians, tilt_radians, area_m2;
  std::optional<double> svf, low, high;
};
static_assert(std::is_trivially_copyable_v<FixedPart>);

void append(std::string& bytes, const void* value, std::size_t size) {
  if (size != 0) bytes.append(static_cast<const char*>(value), size);
}

void append_row(std::string& bytes, const SurfacePoint& r) {
  const FixedPart fixed{r.building.size(), r.surface, r.kind, r.p_projected, r.azimuth.radians(),
                        r.tilt.radians(),  r.area_m2, r.svf,  r.low,         r.high};
  append(bytes, &fixed, sizeof(fixed));
  bytes += r.building;
}

/// Reads one after the other what append() wrote.
class Cursor {
 public:
  explicit Cursor(const std::string& bytes) : bytes_(bytes) {}
  void take(void* value, std::size_t size) {
    FARLOD_EXPECTS(size <= bytes_.size() - place_);
    if (size != 0) std::memcpy(value, bytes_.data() + place_, size);
    place_ += size;
  }
  void take(SurfacePoint& r) {
    FixedPart fixed;
    take(&fixed, sizeof(fixed));
    r.building.resize(fixed.name_bytes);
    take(r.building.data(), fixed.name_bytes);
    r.surface = fixed.surface;
    r.kind = fixed.kind;
    r.p_projected = fixed.p_projected;
    r.azimuth = Angle::radians(fixed.azimuth_radians);
    r.tilt = Angle::radians(fixed.tilt_radians);
    r.area_m2 = fixed.area_m2;
    r.svf = fixed.svf;
    r.low = fixed.low;
    r.high = fixed.high;
  }

 private:
  const std::string& bytes_;
  std::size_t place_ = 0;
};

}  // namespace

SpoolFile::SpoolFile(const std::filesystem::path& result) : result_(result), file_(result.string() + ".spool") {
  errno = 0;
  stream_.open(file_.temporary(), std::ios::binary | std::ios::in | std::ios::out | std::ios::trunc);
  if (!stream_) throw OutputError(result_, reason());
}

std::uint64_t SpoolFile::append(std::span<const std::byte> bytes) {
  errno = 0;
  stream_.seekp(static_cast<std::streamoff>(end_));
  stream_.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!stream_) throw OutputError(result_, reason());
  end_ += bytes.size();
  return end_ - bytes.size();
}

void SpoolFile::read(std::uint64_t place, std::span<std::byte> bytes) {
  errno = 0;
  stream_.seekg(static_cast<std::streamoff>(place));
  stream_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!stream_) throw OutputError(result_, reason());
}

TileSpool::TileSpool(const RasterFrame& frame, const std::filesystem::path& result)
    : columns_(frame.columns), rows_(frame.rows), file_(result) {}

void TileSpool::add(const RasterTile& tile) { places_.emplace(tile.place, file_.append(std::as_bytes(bands_of(tile).front()))); }

std::vector<float> TileSpool::pixels_of_tile_row(std::size_t tile_row) {
  const std::size_t rows = pixels_of_tile(tile_row, rows_);
  std::vector<float> pixels(columns_ * rows, std::numeric_limits<float>::quiet_NaN());
  std::vector<float> tile(raster_tile_edge * raster_tile_edge);
  for (auto t = places_.lower_bound({tile_row, 0}); t != places_.end() && t->first.row == tile_row; ++t) {
    file_.read(t->second, std::as_writable_bytes(std::span(tile)));
    const std::size_t tile_column = t->first.column, columns = pixels_of_tile(tile_column, columns_);
    for (std::size_t row = 0; row < rows; ++row)
      std::copy_n(tile.data() + row * raster_tile_edge, columns, pixels.data() + row * columns_ + tile_column * raster_tile_edge);
  }
  return pixels;
}

void SurfaceSpool::add(std::size_t part, std::span<const SurfacePoint> rows) {
  if (rows.empty()) return;
  std::string bytes;
  for (const SurfacePoint& row : rows) {
    append_row(bytes, row);
    const std::size_t count = row.further.size();
    append(bytes, &count, sizeof(count));
    append(bytes, row.further.data(), count * sizeof(float));
  }
  const std::uint64_t begin = file_.append(std::as_bytes(std::span(bytes)));
  const bool is_new = parts_.emplace(part, Part{begin, bytes.size(), rows.size()}).second;
  FARLOD_EXPECTS(is_new);
  size_ += rows.size();
}

void SurfaceSpool::for_each(const std::function<void(const SurfacePoint&)>& take) {
  std::string bytes;
  SurfacePoint row;
  for (const auto& [number, part] : parts_) {
    bytes.resize(part.bytes);
    file_.read(part.begin, std::as_writable_bytes(std::span(bytes)));
    Cursor cursor(bytes);
    for (std::size_t n = 0; n < part.rows; ++n) {
      cursor.take(row);
      std::size_t count = 0;
      cursor.take(&count, sizeof(count));
      row.further.resize(count);
      cursor.take(row.further.data(), count * sizeof(float));
      take(row);
    }
  }
}

}  // namespace farlod
