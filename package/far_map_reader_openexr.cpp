// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/openexr.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>

#include "base/expects.hpp"
#include "package/far_map_reader.hpp"
#include "package/layout.hpp"

// Reads with OpenEXR's core library (in C): it takes a third of the time of the C++ classes for a tile, and any number of threads
// may read one file at once.

namespace farlod {
namespace {

constexpr int only_part = 0, only_level = 0;
/// Those that are known, and room for those of later writers. The memory that a picture takes grows with them.
constexpr int most_channels = 16;
/// Deflate, which makes the most of nothing, shrinks to 1/1032. A tile that claims more does not hold what it claims.
constexpr std::uint64_t most_shrinking = 1100;

/// An error handler: OpenEXR's own prints, and a library never does. The result codes tell what went wrong.
void ignore_message(exr_const_context_t, exr_result_t, const char*) {}

/// A channel to read, and where its pixels go.
struct ChannelTarget {
  const char* channel;
  std::vector<float>* pixels;
};

/// Decodes one tile.
class TileDecoder {
 public:
  TileDecoder(exr_const_context_t file, const exr_chunk_info_t& chunk) : file_(file) {
    state_ = exr_decoding_initialize(file_, only_part, &chunk, &pipeline_);
  }
  TileDecoder(const TileDecoder&) = delete;
  TileDecoder& operator=(const TileDecoder&) = delete;
  ~TileDecoder() { exr_decoding_destroy(file_, &pipeline_); }

  exr_result_t run(std::span<const ChannelTarget> wanted) {
    if (state_ != EXR_ERR_SUCCESS) return state_;
    // Give each channel of the file a place, wanted or not
    const std::span channels(pipeline_.channels, static_cast<std::size_t>(pipeline_.channel_count));
    for (exr_coding_channel_info_t& channel : channels) direct(channel, pixels_of(channel.channel_name, wanted, unwanted_));
    state_ = exr_decoding_choose_default_routines(file_, only_part, &pipeline_);
    return state_ == EXR_ERR_SUCCESS ? exr_decoding_run(file_, only_part, &pipeline_) : state_;
  }

 private:
  /// Channels that nobody wants get a place too: OpenEXR 3.1 promises to skip a channel without one, and does not.
  static std::vector<float>& pixels_of(std::string_view channel, std::span<const ChannelTarget> wanted,
                                       std::vector<float>& otherwise) {
    for (const ChannelTarget& w : wanted)
      if (channel == w.channel) return *w.pixels;
    return otherwise;
  }
  /// Tells OpenEXR to convert a channel to floats, row by row without gaps.
  static void direct(exr_coding_channel_info_t& channel, std::vector<float>& pixels) {
    pixels.resize(static_cast<std::size_t>(channel.width) * static_cast<std::size_t>(channel.height));
    channel.decode_to_ptr = reinterpret_cast<std::uint8_t*>(pixels.data());
    channel.user_data_type = EXR_PIXEL_FLOAT;
    channel.user_bytes_per_element = sizeof(float);
    channel.user_pixel_stride = sizeof(float);
    channel.user_line_stride = channel.width * static_cast<std::int32_t>(sizeof(float));
  }

  exr_const_context_t file_;
  exr_decode_pipeline_t pipeline_{};  // zeros, as EXR_DECODE_PIPELINE_INITIALIZER, which clang warns of
  exr_result_t state_ = EXR_ERR_SUCCESS;
  std::vector<float> unwanted_;  ///< of all channels that nobody wants, one after the other
};

}  // namespace

struct FarMapReader::Impl {
  std::string name;
  CellRange cells;
  package::FarMapShape shape;
  std::optional<package::CellRuns> mapped;
  exr_context_t file = nullptr;

  Impl(const PackageFile& opened, const CellRange& c, package::FarMapShape s, std::optional<package::CellRuns> m)
      : name(opened.name), cells(c), shape(std::move(s)), mapped(std::move(m)) {
    exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
    how.error_handler_fn = ignore_message;
    const exr_result_t result = exr_start_read(&file, opened.path.c_str(), &how);
    if (result == EXR_ERR_SUCCESS) return;
    exr_finish(&file);
    throw PackageDamaged(name + " cannot be read as a far map: " + exr_get_default_error_message(result) +
                         ". Pack the city again.");
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() { exr_finish(&file); }

  [[noreturn]] void damaged(const std::string& what) const {
    throw PackageDamaged(name + " is damaged: " + what + ". Pack the city again.");
  }
  void require(exr_result_t result) const {
    if (result != EXR_ERR_SUCCESS) damaged(exr_get_default_error_message(result));
  }
  /// Checks once what all tiles have in common. Must be called before the object is shared between threads.
  void check() {
    int parts = 0;
    exr_storage_t storage = EXR_STORAGE_LAST_TYPE;
    require(exr_get_count(file, &parts));
    require(exr_get_storage(file, only_part, &storage));
    if (parts != 1 || storage != EXR_STORAGE_TILED) damaged("it is not one picture of tiles");
    check_places();
    check_channels();
    // OpenEXR reads its table of tiles with the first tile that is asked for: ask now, while there is one thread
    exr_chunk_info_t chunk;
    require(exr_read_tile_chunk_info(file, only_part, 0, 0, only_level, only_level, &chunk));
  }
  void check_places() const {
    const std::uint32_t columns = shape.picture_columns(), rows = shape.picture_rows();
    std::uint32_t tile_columns = 0, tile_rows = 0;
    exr_tile_level_mode_t levels = EXR_TILE_LAST_TYPE;
    exr_tile_round_mode_t rounding = EXR_TILE_ROUND_LAST_TYPE;
    require(exr_get_tile_descriptor(file, only_part, &tile_columns, &tile_rows, &levels, &rounding));
    if (tile_columns != columns || tile_rows != rows) damaged("its maps are not of the size that the manifest says");
    exr_attr_box2i_t window{};
    require(exr_get_data_window(file, only_part, &window));
    const package::PictureTiles tiles = package::picture_tiles(cells, mapped);
    if (window.min.x != 0 || window.min.y != 0 || std::int64_t{window.max.x} + 1 != tiles.columns * columns ||
        std::int64_t{window.max.y} + 1 != tiles.rows * rows)
      damaged(mapped ? "it does not hold a map for each cell that the manifest names"
                     : "it does not hold a map for each cell of its block");
  }
  void check_channels() const {
    const exr_attr_chlist_t* channels = nullptr;
    require(exr_get_channels(file, only_part, &channels));
    const std::span entries(channels->entries, static_cast<std::size_t>(channels->num_channels));
    if (channels->num_channels > most_channels) damaged("it has more than " + std::to_string(most_channels) + " channels");
    const auto has = [&](std::string_view wanted) {
      return std::any_of(entries.begin(), entries.end(), [&](const auto& entry) { return wanted == entry.name.str; });
    };
    if (shape.is_box() && !has(package::distance_channel)) damaged("it has no distances");
    for (const char* slopes : {package::low_channel, package::estimate_channel, package::high_channel, package::overhang_channel})
      if (!shape.is_box() && !has(slopes)) damaged("it has no slopes");
  }
  [[nodiscard]] exr_chunk_info_t chunk_of(Cell cell) const {
    const package::PictureTile tile = package::picture_tile(cell, cells, mapped);
    exr_chunk_info_t chunk;
    require(exr_read_tile_chunk_info(file, only_part, tile.column, tile.row, only_level, only_level, &chunk));
    // Before there is memory for it
    if (chunk.unpacked_size / most_shrinking > chunk.packed_size) damaged("a map is larger than what is stored of it can be");
    return chunk;
  }
  /// The pixels of one cell, in the file's order of rows.
  void read(Cell cell, std::span<const ChannelTarget> wanted) const {
    require(TileDecoder(file, chunk_of(cell)).run(wanted));
    for (const ChannelTarget& w : wanted)
      if (w.pixels->size() != static_cast<std::size_t>(shape.picture_columns()) * shape.picture_rows())
        damaged("a channel does not have a value for each pixel");
  }
};

FarMapReader::FarMapReader(const PackageFile& file, const CellRange& cells, const package::FarMapShape& shape,
                           const std::optional<package::CellRuns>& mapped)
    : impl_(std::make_unique<Impl>(file, cells, shape, mapped)) {
  impl_->check();
}
FarMapReader::FarMapReader(FarMapReader&&) noexcept = default;
FarMapReader& FarMapReader::operator=(FarMapReader&&) noexcept = default;
FarMapReader::~FarMapReader() = default;

BoxFarMap FarMapReader::read_box(Cell cell, float top) const {
  FARLOD_EXPECTS(impl_->cells.contains(cell) && impl_->shape.is_box());
  if (top <= 0.0F) return {};
  const std::size_t w = impl_->shape.picture_columns(), h = impl_->shape.picture_rows();
  std::vector<float> from_top_down;
  impl_->read(cell, std::array{ChannelTarget{package::distance_channel, &from_top_down}});
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
  impl_->read(
      cell, std::array{ChannelTarget{package::low_channel, &map.low}, ChannelTarget{package::estimate_channel, &map.estimate},
                       ChannelTarget{package::high_channel, &map.high}, ChannelTarget{package::overhang_channel, &map.overhang}});
  std::size_t in_order = 0;
  // Count without branches, so that the loop can be vectorised: it runs for each cell that is evaluated
  for (std::size_t n = 0; n < map.low.size(); ++n)
    in_order += (map.low[n] >= 0.0F ? 1U : 0U) & (map.low[n] <= map.high[n] ? 1U : 0U) & (map.estimate[n] >= 0.0F ? 1U : 0U) &
                (map.overhang[n] >= 0.0F ? 1U : 0U);
  if (in_order != map.low.size()) impl_->damaged("its bounds are not in order");
}

std::uint64_t FarMapReader::stored_bytes(Cell cell) const {
  FARLOD_EXPECTS(impl_->cells.contains(cell));
  return impl_->chunk_of(cell).packed_size;
}

}  // namespace farlod
