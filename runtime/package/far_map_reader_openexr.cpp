// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfTiledInputFile.h>

#include <array>
#include <mutex>
#include <span>
#include <string>

#include "farlod/expects.hpp"
#include "farlod/package/layout.hpp"
#include "package/far_map_reader.hpp"
#include "package/package_error.hpp"

namespace farlod {

struct FarMapReader::Impl {
  std::string name;
  CellRange cells;
  package::FarMapShape shape;
  Imf::TiledInputFile file;
  std::mutex one_reader;  // a frame buffer belongs to the file, not to the call

  Impl(const std::filesystem::path& path, const CellRange& c, const package::FarMapShape& s)
      : name(path.string()), cells(c), shape(s), file(path.c_str(), 0) {}

  [[noreturn]] void damaged(const std::string& what) const {
    throw PackageDamaged(name + " is damaged: " + what + ". Pack the city again.");
  }
  void check() const {
    const Imath::Box2i window = file.header().dataWindow();
    const std::uint32_t columns = shape.picture_columns(), rows = shape.picture_rows();
    if (file.tileXSize() != columns || file.tileYSize() != rows) damaged("its maps are not of the size that the manifest says");
    if (window.min.x != 0 || window.min.y != 0 || window.max.x + 1 != static_cast<int>(cells.width() * columns) ||
        window.max.y + 1 != static_cast<int>(cells.height() * rows))
      damaged("it does not hold a map for each cell of its block");
    const Imf::ChannelList& channels = file.header().channels();
    if (shape.is_box() && channels.findChannel(package::distance_channel) == nullptr) damaged("it has no distances");
    for (const char* slopes : {package::lower_channel, package::likely_channel, package::upper_channel})
      if (!shape.is_box() && channels.findChannel(slopes) == nullptr) damaged("it has no slopes");
  }
  /// The pixels of one cell, channel by channel, in the file's order of rows.
  std::vector<std::vector<float>> read(Cell cell, std::span<const char* const> names) {
    const std::uint32_t columns = shape.picture_columns(), rows = shape.picture_rows();
    const auto tile_x = static_cast<int>(cell.i - cells.i_begin), tile_y = static_cast<int>(cell.j - cells.j_begin);
    std::vector<std::vector<float>> channels(names.size(), std::vector<float>(static_cast<std::size_t>(columns) * rows));
    const std::lock_guard lock(one_reader);
    try {
      // Tell OpenEXR where pixel (0, 0) of the whole picture would lie, were it in memory
      const Imath::V2i first_pixel(tile_x * static_cast<int>(columns), tile_y * static_cast<int>(rows));
      Imf::FrameBuffer frame;
      for (std::size_t n = 0; n < names.size(); ++n)
        frame.insert(names[n], Imf::Slice::Make(Imf::FLOAT, channels[n].data(), first_pixel, columns, rows));
      file.setFrameBuffer(frame);
      file.readTile(tile_x, tile_y);
    } catch (const std::exception& reason) {
      damaged(reason.what());
    }
    return channels;
  }
};

FarMapReader::FarMapReader(const std::filesystem::path& path, const CellRange& cells, const package::FarMapShape& shape) {
  try {
    impl_ = std::make_unique<Impl>(path, cells, shape);
  } catch (const std::exception& reason) {
    throw PackageDamaged(path.string() + " cannot be read as a far map: " + reason.what() + ". Pack the city again.");
  }
  impl_->check();
}
FarMapReader::FarMapReader(FarMapReader&&) noexcept = default;
FarMapReader& FarMapReader::operator=(FarMapReader&&) noexcept = default;
FarMapReader::~FarMapReader() = default;

BoxFarMap FarMapReader::read_box(Cell cell, float top) const {
  FARLOD_EXPECTS(impl_->cells.contains(cell) && impl_->shape.is_box());
  if (top <= 0.0F) return {};
  const std::size_t w = impl_->shape.picture_columns(), h = impl_->shape.picture_rows();
  const std::vector<float> from_top_down = impl_->read(cell, std::array{package::distance_channel})[0];
  for (const float d : from_top_down)
    if (!(d > 0.0F)) impl_->damaged("a distance is not a positive number");
  // Pictures run downwards, maps upwards
  std::vector<float> distance_m(from_top_down.size());
  for (std::size_t row = 0; row < h; ++row)
    std::copy_n(from_top_down.begin() + static_cast<std::ptrdiff_t>((h - 1 - row) * w), w,
                distance_m.begin() + static_cast<std::ptrdiff_t>(row * w));
  return {BoxMap{impl_->shape.side_columns, impl_->shape.rows, top}, std::move(distance_m)};
}

void FarMapReader::read_slopes(Cell cell, FarHorizon& map) const {
  FARLOD_EXPECTS(impl_->cells.contains(cell) && !impl_->shape.is_box());
  auto slopes = impl_->read(cell, std::array{package::lower_channel, package::likely_channel, package::upper_channel});
  map.lower = std::move(slopes[0]);
  map.likely = std::move(slopes[1]);
  map.upper = std::move(slopes[2]);
  for (std::size_t n = 0; n < map.lower.size(); ++n)
    if (!(map.lower[n] >= 0.0F && map.lower[n] <= map.upper[n] && map.likely[n] >= 0.0F))
      impl_->damaged("its bounds are not in order");
}

}  // namespace farlod
