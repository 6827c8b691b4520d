// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfTiledInputFile.h>

#include <mutex>
#include <string>

#include "farlod/expects.hpp"
#include "farlod/package/layout.hpp"
#include "package/far_map_reader.hpp"
#include "package/package_error.hpp"

namespace farlod {

struct FarMapReader::Impl {
  std::string name;
  CellRange cells;
  std::uint32_t columns, rows;
  Imf::TiledInputFile file;
  std::mutex one_reader;  // a frame buffer belongs to the file, not to the call

  Impl(const std::filesystem::path& path, const CellRange& c, std::uint32_t w, std::uint32_t h)
      : name(path.string()), cells(c), columns(w), rows(h), file(path.c_str(), 0) {}

  [[noreturn]] void damaged(const std::string& what) const {
    throw PackageDamaged(name + " is damaged: " + what + ". Pack the city again.");
  }
  void check() const {
    const Imath::Box2i window = file.header().dataWindow();
    if (file.tileXSize() != columns || file.tileYSize() != rows) damaged("its maps are not of the size that the manifest says");
    if (window.min.x != 0 || window.min.y != 0 || window.max.x + 1 != static_cast<int>(cells.width() * columns) ||
        window.max.y + 1 != static_cast<int>(cells.height() * rows))
      damaged("it does not hold a map for each cell of its block");
    if (file.header().channels().findChannel(package::distance_channel) == nullptr) damaged("it has no distances");
  }
};

FarMapReader::FarMapReader(const std::filesystem::path& path, const CellRange& cells, std::uint32_t side_columns,
                           std::uint32_t rows) {
  try {
    impl_ = std::make_unique<Impl>(path, cells, 4 * side_columns, rows);
  } catch (const std::exception& reason) {
    throw PackageDamaged(path.string() + " cannot be read as a far map: " + reason.what() + ". Pack the city again.");
  }
  impl_->check();
}
FarMapReader::FarMapReader(FarMapReader&&) noexcept = default;
FarMapReader& FarMapReader::operator=(FarMapReader&&) noexcept = default;
FarMapReader::~FarMapReader() = default;

FarMap FarMapReader::read(Cell cell, float top) const {
  FARLOD_EXPECTS(impl_->cells.contains(cell));
  if (top <= 0.0F) return {};
  const std::uint32_t w = impl_->columns, h = impl_->rows;
  const auto tile_x = static_cast<int>(cell.i - impl_->cells.i_begin), tile_y = static_cast<int>(cell.j - impl_->cells.j_begin);
  std::vector<float> from_top_down(static_cast<std::size_t>(w) * h);
  const std::lock_guard lock(impl_->one_reader);
  try {
    // Tell OpenEXR where pixel (0, 0) of the whole picture would lie, were it in memory
    const Imath::V2i first_pixel(tile_x * static_cast<int>(w), tile_y * static_cast<int>(h));
    Imf::FrameBuffer frame;
    frame.insert(package::distance_channel, Imf::Slice::Make(Imf::FLOAT, from_top_down.data(), first_pixel, w, h));
    impl_->file.setFrameBuffer(frame);
    impl_->file.readTile(tile_x, tile_y);
  } catch (const std::exception& reason) {
    impl_->damaged(reason.what());
  }
  for (const float d : from_top_down)
    if (!(d > 0.0F)) impl_->damaged("a distance is not a positive number");
  // Pictures run downwards, maps upwards
  std::vector<float> distance_m(from_top_down.size());
  for (std::size_t row = 0; row < h; ++row)
    std::copy_n(from_top_down.begin() + static_cast<std::ptrdiff_t>((h - 1 - row) * w), w,
                distance_m.begin() + static_cast<std::ptrdiff_t>(row * w));
  return {BoxMap{w / 4, h, top}, std::move(distance_m)};
}

}  // namespace farlod
