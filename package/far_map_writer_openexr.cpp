// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <half.h>

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/expects.hpp"
#include "package/layout.hpp"
#include "package/package_writer.hpp"

namespace farlod {
namespace {

/// The channels of one cell's picture, top row first.
using Picture = std::map<std::string, std::vector<half>>;

Picture picture_of(const BakedBox& map, std::uint32_t columns, std::uint32_t rows) {
  std::vector<half> sky(static_cast<std::size_t>(columns) * rows, half(1.0F)), distance_m(sky.size(), half::posInf());
  for (std::size_t row = 0; row < rows && !map.distance_m.empty(); ++row)
    for (std::size_t column = 0; column < columns; ++column) {
      const float d = map.distance_m[(rows - 1 - row) * columns + column];
      if (d == std::numeric_limits<float>::infinity()) continue;
      sky[row * columns + column] = half(0.0F);
      // What hides the sky farther away than half can say stays hidden
      distance_m[row * columns + column] = half(std::min(d, static_cast<float>(HALF_MAX)));
    }
  return {{package::sky_channel, std::move(sky)}, {package::distance_channel, std::move(distance_m)}};
}

half next_half(half h, int step) {
  half result;
  result.setBits(static_cast<unsigned short>(h.bits() + step));
  return result;
}
/// The nearest half on one side of a slope; slopes are not negative, so that bits are in order.
half rounded_up(float slope) {
  const half h(slope);
  return static_cast<float>(h) < slope ? next_half(h, 1) : h;
}
half rounded_down(float slope) {
  const half h(std::min(slope, static_cast<float>(HALF_MAX)));
  return static_cast<float>(h) > slope ? next_half(h, -1) : h;
}

Picture picture_of(const BakedHorizon& map, std::uint32_t, std::uint32_t) {
  std::vector<half> low, estimate, high, overhang;
  for (const float slope : map.low) low.push_back(rounded_down(slope));
  for (const float slope : map.high) high.push_back(rounded_up(slope));
  for (const float slope : map.estimate) estimate.emplace_back(slope);
  for (const float slope : map.overhang) overhang.push_back(rounded_up(slope));
  return {{package::low_channel, std::move(low)},
          {package::estimate_channel, std::move(estimate)},
          {package::high_channel, std::move(high)},
          {package::overhang_channel, std::move(overhang)}};
}

/// One cell's picture after the other, in a file of tiles.
class TiledFile {
 public:
  TiledFile(const std::filesystem::path& path, package::PictureTiles tiles, const package::FarMapShape& shape,
            const Picture& channels)
      : tiles_(tiles),
        columns_(static_cast<int>(shape.picture_columns())),
        rows_(static_cast<int>(shape.picture_rows())),
        file_(path.c_str(), header(channels, compression_of(shape)), 0) {}

  /// OpenEXR wants pixels that it may write. NOLINTNEXTLINE(performance-unnecessary-value-param)
  void add(package::PictureTile tile, Picture picture) {
    const Imath::V2i first_pixel(tile.column * columns_, tile.row * rows_);
    Imf::FrameBuffer frame;
    for (auto& [name, pixels] : picture) {
      FARLOD_EXPECTS(pixels.size() == static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
      frame.insert(name, Imf::Slice::Make(Imf::HALF, pixels.data(), first_pixel, columns_, rows_));
    }
    file_.setFrameBuffer(frame);
    file_.writeTile(tile.column, tile.row);
  }

 private:
  /// Horizons are read cell by cell while receivers wait: as runs they take a third more bytes than zipped, and half of the
  /// time.
  static Imf::Compression compression_of(const package::FarMapShape& shape) {
    return shape.is_box() ? Imf::ZIP_COMPRESSION : Imf::RLE_COMPRESSION;
  }
  [[nodiscard]] Imf::Header header(const Picture& channels, Imf::Compression compression) const {
    Imf::Header header(static_cast<int>(tiles_.columns) * columns_, static_cast<int>(tiles_.rows) * rows_);
    for (const auto& [name, pixels] : channels) header.channels().insert(name, Imf::Channel(Imf::HALF));
    header.setTileDescription(
        Imf::TileDescription(static_cast<unsigned>(columns_), static_cast<unsigned>(rows_), Imf::ONE_LEVEL));
    header.compression() = compression;
    return header;
  }

  package::PictureTiles tiles_;
  int columns_, rows_;
  Imf::TiledOutputFile file_;
};

template <class Maps>
void write_all(const std::filesystem::path& path, const Maps& maps, const CellRange& cells, const package::FarMapShape& shape,
               const std::optional<package::CellRuns>& mapped) {
  const package::PictureTiles tiles = package::picture_tiles(cells, mapped);
  FARLOD_EXPECTS(std::cmp_equal(maps.size(), tiles.columns * tiles.rows));
  const auto picture = [&](std::size_t n) { return picture_of(maps[n], shape.picture_columns(), shape.picture_rows()); };
  TiledFile file(path, tiles, shape, picture(0));
  // Maps follow each other as tiles do, row by row
  const auto columns = static_cast<std::size_t>(tiles.columns);
  for (std::size_t n = 0; n < maps.size(); ++n)
    file.add({static_cast<std::int32_t>(n % columns), static_cast<std::int32_t>(n / columns)}, picture(n));
}

}  // namespace

void round_as_stored(BakedHorizon& map) {
  for (float& slope : map.low) slope = rounded_down(slope);
  for (float& slope : map.estimate) slope = half(slope);
  for (float& slope : map.high) slope = rounded_up(slope);
  for (float& slope : map.overhang) slope = rounded_up(slope);
}

void write_far_maps(const std::filesystem::path& path, const BakedBlock& maps, const CellRange& cells,
                    const package::FarMapShape& shape, const std::optional<package::CellRuns>& mapped) {
  try {
    if (const auto* boxes = std::get_if<BakedBoxes>(&maps)) {
      write_all(path, *boxes, cells, shape, mapped);
    } else {
      write_all(path, std::get<BakedHorizons>(maps).cells, cells, shape, mapped);
    }
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& reason) {
    throw std::runtime_error(path.string() + " cannot be written: " + reason.what());
  }
}

}  // namespace farlod
