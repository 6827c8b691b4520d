// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "package/file_stamp.hpp"
#include "package/layout.hpp"
#include "package/pixel_heights.hpp"

namespace farlod {

using package::HeightsHeader;

bool package::is_natural_relief(const Manifest& m) {
  // With fewer triangles for each pixel, edges are drawn sooner: blocks on level ground have 0.2, natural relief 2. With more
  // walls, edges tell better where horizons jump, and are not slower: surveys of towns have 0.1
  constexpr double least_triangles_per_pixel = 0.5, most_walls_per_pixel = 0.02;
  // More are too many to be counted by a march
  constexpr std::uint32_t most_along = std::uint32_t{1} << 28;
  if (!m.heights() || !m.pixels->walls || m.far_terrain || std::max(m.pixels->columns, m.pixels->rows) > most_along) return false;
  const double pixels = static_cast<double>(m.pixels->columns) * m.pixels->rows;
  return static_cast<double>(m.triangles) >= least_triangles_per_pixel * pixels &&
         static_cast<double>(*m.pixels->walls) <= most_walls_per_pixel * pixels;
}

PixelHeightsFile::PixelHeightsFile(const PackageFolder& folder, const package::Manifest& manifest)
    : name_(folder.file(package::heights_file).name), file_(folder.plain_file(package::heights_file)) {
  const package::SurfacePixels& pixels = *manifest.pixels;
  check_stamp(folder.file(package::heights_file), file_, *pixels.heights);
  const std::span<const std::byte> bytes = file_.bytes();
  require(bytes.size() >= sizeof(HeightsHeader), "it has no header");
  const auto& header = *reinterpret_cast<const HeightsHeader*>(bytes.data());
  require(header.magic == package::heights_magic, "it does not begin as heights.bin does");
  require_readable_version(name_, header.version, package::heights_version, package::heights_version);
  const std::uint64_t count = std::uint64_t{header.columns} * header.rows;
  require(header.columns == pixels.columns && header.rows == pixels.rows, "its pixels are not those of the manifest");
  require(header.file_bytes == bytes.size() && (bytes.size() - sizeof(HeightsHeader)) / 5 == count &&
              (bytes.size() - sizeof(HeightsHeader)) % 5 == 0,
          "its length is not that of its pixels");
  const std::byte* const heights = bytes.data() + sizeof(HeightsHeader);
  height_m_ = {reinterpret_cast<const float*>(heights), count};
  joined_ = {reinterpret_cast<const std::uint8_t*>(heights + height_m_.size_bytes()), count};
  check_pixels(pixels);
}

void PixelHeightsFile::check_pixels(const package::SurfacePixels& pixels) const {
  const auto has_height = [&](std::size_t n) { return !std::isnan(height_m_[n]); };
  for (std::size_t row = 0, n = 0; row < pixels.rows; ++row)
    for (std::size_t column = 0; column < pixels.columns; ++column, ++n) {
      require(!has_height(n) || std::abs(height_m_[n]) <= package::farthest_in_tile_m, "a height lies nowhere on Earth");
      const bool east = (joined_[n] & JoinedPixels::east) != 0, north = (joined_[n] & JoinedPixels::north) != 0;
      require(!east || (column + 1 < pixels.columns && has_height(n) && has_height(n + 1)), "a pixel is joined with none");
      require(!north || (row + 1 < pixels.rows && has_height(n) && has_height(n + pixels.columns)),
              "a pixel is joined with none");
    }
}

}  // namespace farlod
