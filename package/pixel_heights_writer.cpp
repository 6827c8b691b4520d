// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <fstream>
#include <vector>

#include "base/durable_file.hpp"
#include "base/expects.hpp"
#include "farlod/error.hpp"
#include "package/file_stamp.hpp"
#include "package/pixel_heights.hpp"

namespace farlod {
namespace {

void write_bytes_of(const std::filesystem::path& path, const package::SurfacePixels& pixels, const PixelHeightRows& heights) {
  package::HeightsHeader header{};
  header.magic = package::heights_magic;
  header.version = heights.in_grid ? package::placed_heights_version : package::heights_version;
  header.columns = pixels.columns;
  header.rows = pixels.rows;
  header.file_bytes = sizeof(header) + (heights.in_grid ? sizeof(PixelsInGrid) : 0) + heights.joined.size() * (sizeof(float) + 1);
  std::ofstream file(path, std::ios::binary);
  const auto put = [&file](const auto* first, std::size_t count) {
    file.write(reinterpret_cast<const char*>(first), static_cast<std::streamsize>(count * sizeof(*first)));
  };
  put(&header, 1);
  if (heights.in_grid) put(&*heights.in_grid, 1);
  std::vector<float> height_m(pixels.columns);
  for (std::size_t row = 0; row < pixels.rows; ++row) {
    heights.heights_of(row, height_m);
    put(height_m.data(), height_m.size());
  }
  put(heights.joined.data(), heights.joined.size());
  file.close();
  if (!file) throw OutputError(path.string() + " cannot be written. Is the disk full?");
}

}  // namespace

package::FileStamp write_pixel_heights(const std::filesystem::path& folder, const package::SurfacePixels& pixels,
                                       const PixelHeightRows& heights) {
  FARLOD_EXPECTS(heights.joined.size() == std::size_t{pixels.columns} * pixels.rows);
  make_folder(folder);
  package::FileStamp stamp;
  write_durably(folder / package::heights_file, [&](const std::filesystem::path& part) {
    write_bytes_of(part, pixels, heights);
    stamp = stamp_of(part);
  });
  return stamp;
}

package::FileStamp write_pixel_heights(const std::filesystem::path& folder, const package::SurfacePixels& pixels,
                                       const PixelHeights& heights) {
  FARLOD_EXPECTS(heights.height_m.size() == heights.joined.size());
  const auto heights_of = [&](std::size_t row, std::span<float> height_m) {
    std::copy_n(heights.height_m.begin() + static_cast<std::ptrdiff_t>(row * pixels.columns), height_m.size(), height_m.begin());
  };
  return write_pixel_heights(folder, pixels, PixelHeightRows{heights_of, heights.joined, heights.in_grid});
}

}  // namespace farlod
