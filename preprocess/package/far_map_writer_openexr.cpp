// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <half.h>

#include <limits>
#include <stdexcept>
#include <vector>

#include "farlod/expects.hpp"
#include "farlod/package/layout.hpp"
#include "package/far_map_writer.hpp"

namespace farlod {
namespace {

/// The two channels of one map, top row first.
struct MapPicture {
  std::vector<half> sky, distance_m;

  MapPicture(const BakedMap& map, std::uint32_t columns, std::uint32_t rows)
      : sky(static_cast<std::size_t>(columns) * rows, half(1.0F)), distance_m(sky.size(), half::posInf()) {
    if (map.distance_m.empty()) return;
    for (std::size_t row = 0; row < rows; ++row)
      for (std::size_t column = 0; column < columns; ++column) {
        const float d = map.distance_m[(rows - 1 - row) * columns + column];
        if (d == std::numeric_limits<float>::infinity()) continue;
        sky[row * columns + column] = half(0.0F);
        // What hides the sky farther away than half can say stays hidden
        distance_m[row * columns + column] = half(std::min(d, static_cast<float>(HALF_MAX)));
      }
  }
};

Imf::Header header_for(const CellRange& cells, int columns, int rows) {
  Imf::Header header(static_cast<int>(cells.width()) * columns, static_cast<int>(cells.height()) * rows);
  header.channels().insert(package::sky_channel, Imf::Channel(Imf::HALF));
  header.channels().insert(package::distance_channel, Imf::Channel(Imf::HALF));
  header.setTileDescription(Imf::TileDescription(static_cast<unsigned>(columns), static_cast<unsigned>(rows), Imf::ONE_LEVEL));
  header.compression() = Imf::ZIP_COMPRESSION;
  return header;
}

}  // namespace

void write_far_maps(const std::filesystem::path& path, std::span<const BakedMap> maps, const CellRange& cells,
                    const FarMapSettings& settings) {
  FARLOD_EXPECTS(maps.size() == static_cast<std::size_t>(cells.size()));
  const std::uint32_t columns = 4 * settings.side_columns, rows = settings.rows;
  try {
    Imf::TiledOutputFile file(path.c_str(), header_for(cells, static_cast<int>(columns), static_cast<int>(rows)), 0);
    for (std::size_t n = 0; n < maps.size(); ++n) {
      MapPicture picture(maps[n], columns, rows);
      const Cell cell = cells.cell_at(n);
      const int i = cell.i - cells.i_begin, j = cell.j - cells.j_begin;
      const Imath::V2i first_pixel(i * static_cast<int>(columns), j * static_cast<int>(rows));
      Imf::FrameBuffer frame;
      frame.insert(package::sky_channel, Imf::Slice::Make(Imf::HALF, picture.sky.data(), first_pixel, columns, rows));
      frame.insert(package::distance_channel, Imf::Slice::Make(Imf::HALF, picture.distance_m.data(), first_pixel, columns, rows));
      file.setFrameBuffer(frame);
      file.writeTile(i, j);
    }
  } catch (const std::exception& reason) {
    throw std::runtime_error(path.string() + " cannot be written: " + reason.what());
  }
}

}  // namespace farlod
