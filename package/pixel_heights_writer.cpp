// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fstream>

#include "base/durable_file.hpp"
#include "base/expects.hpp"
#include "farlod/error.hpp"
#include "package/file_stamp.hpp"
#include "package/pixel_heights.hpp"

namespace farlod {
namespace {

void write_bytes_of(const std::filesystem::path& path, const package::SurfacePixels& pixels, const PixelHeights& heights) {
  package::HeightsHeader header{};
  header.magic = package::heights_magic;
  header.version = package::heights_version;
  header.columns = pixels.columns;
  header.rows = pixels.rows;
  header.file_bytes = sizeof(header) + heights.height_m.size() * sizeof(float) + heights.joined.size();
  std::ofstream file(path, std::ios::binary);
  const auto put = [&file](const auto* first, std::size_t count) {
    file.write(reinterpret_cast<const char*>(first), static_cast<std::streamsize>(count * sizeof(*first)));
  };
  put(&header, 1);
  put(heights.height_m.data(), heights.height_m.size());
  put(heights.joined.data(), heights.joined.size());
  file.close();
  if (!file) throw OutputError(path.string() + " cannot be written. Is the disk full?");
}

}  // namespace

package::FileStamp write_pixel_heights(const std::filesystem::path& folder, const package::SurfacePixels& pixels,
                                       const PixelHeights& heights) {
  FARLOD_EXPECTS(heights.height_m.size() == std::size_t{pixels.columns} * pixels.rows &&
                 heights.joined.size() == heights.height_m.size());
  make_folder(folder);
  package::FileStamp stamp;
  write_durably(folder / package::heights_file, [&](const std::filesystem::path& part) {
    write_bytes_of(part, pixels, heights);
    stamp = stamp_of(part);
  });
  return stamp;
}

}  // namespace farlod
