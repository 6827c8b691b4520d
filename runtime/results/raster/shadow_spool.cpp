// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/shadow_spool.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "base/expects.hpp"

namespace farlod {
namespace {

/// A column is three bytes, so that patch p is bit p % 8 of byte p / 8.
constexpr std::size_t bytes_of_shadow_column = 3;
static_assert(patches_of_shadow_column == 8 * bytes_of_shadow_column);
constexpr std::size_t matrix_bytes = columns_of_shadow_matrix * bytes_of_shadow_column;  // of a pixel
constexpr std::size_t tile_pixels = raster_tile_edge * raster_tile_edge;

constexpr std::uint8_t without_data(ShadowMatrix matrix) { return matrix == ShadowMatrix::building ? 0x00 : 0xFF; }

/// The bits of each byte, a byte each, from the least on.
constexpr auto bytes_of_bits = [] {
  std::array<std::array<std::uint8_t, 8>, 256> table{};
  for (std::size_t byte = 0; byte < table.size(); ++byte)
    for (std::size_t bit = 0; bit < 8; ++bit) table[byte][bit] = static_cast<std::uint8_t>(byte >> bit & 1U);
  return table;
}();

void pack(std::span<const float> column, std::uint8_t byte_without_data, std::uint8_t* bytes) {
  for (const float value : column) {
    const std::uint32_t bits = std::isnan(value) ? byte_without_data * 0x010101U : static_cast<std::uint32_t>(value);
    for (std::size_t n = 0; n < bytes_of_shadow_column; ++n) bytes[n] = static_cast<std::uint8_t>(bits >> 8 * n);
    bytes += matrix_bytes;
  }
}

constexpr std::array<const char*, shadow_matrix_count> matrix_names{"shadowmat", "vegshadowmat", "vbshmat"};

}  // namespace

ShadowSpool::ShadowSpool(const RasterFrame& frame, const std::filesystem::path& result)
    : columns_(frame.columns), rows_(frame.rows), file_(result) {}

void ShadowSpool::add(TilePlace place, std::span<const std::span<const float>> columns) {
  FARLOD_EXPECTS(columns.size() == shadow_column_count);
  std::vector<std::uint8_t> bytes(shadow_matrix_count * tile_pixels * matrix_bytes);
  for (std::size_t n = 0; n < columns.size(); ++n) {
    const std::size_t matrix = n / columns_of_shadow_matrix, column = n % columns_of_shadow_matrix;
    pack(columns[n], without_data(static_cast<ShadowMatrix>(matrix)),
         bytes.data() + matrix * tile_pixels * matrix_bytes + column * bytes_of_shadow_column);
  }
  places_.emplace(place, file_.append(std::as_bytes(std::span(bytes))));
}

void ShadowSpool::load(ShadowMatrix matrix, std::size_t first_row, std::size_t end_row) {
  const std::size_t tiles = tiles_along(columns_), row_bytes = raster_tile_edge * matrix_bytes;
  loaded_.assign((end_row - first_row) * tiles * row_bytes, without_data(matrix));
  first_row_ = first_row;
  for (std::size_t row = first_row; row < end_row; ++row) {
    const std::size_t tile_row = row / raster_tile_edge;
    for (auto t = places_.lower_bound({tile_row, 0}); t != places_.end() && t->first.row == tile_row; ++t) {
      const std::size_t before =
          static_cast<std::size_t>(matrix) * tile_pixels * matrix_bytes + row % raster_tile_edge * row_bytes;
      const auto bytes = std::span(loaded_).subspan(((row - first_row) * tiles + t->first.column) * row_bytes, row_bytes);
      file_.read(t->second + before, std::as_writable_bytes(bytes));
    }
  }
}

void ShadowSpool::fill(std::size_t row, std::span<std::uint8_t> values) const {
  const std::uint8_t* bits = loaded_.data() + (row - first_row_) * tiles_along(columns_) * raster_tile_edge * matrix_bytes;
  std::uint8_t* value = values.data();
  constexpr std::size_t whole_bytes = shadow_patch_count / 8, rest = shadow_patch_count % 8;
  for (std::size_t column = 0; column < columns_; ++column, bits += matrix_bytes, value += rest) {
    for (std::size_t byte = 0; byte < whole_bytes; ++byte, value += 8) std::memcpy(value, bytes_of_bits[bits[byte]].data(), 8);
    std::memcpy(value, bytes_of_bits[bits[whole_bytes]].data(), rest);
  }
}

NpzArray ShadowSpool::matrix(ShadowMatrix matrix) {
  return {matrix_names[static_cast<std::size_t>(matrix)],
          rows_,
          columns_,
          shadow_patch_count,
          [this, matrix](std::size_t first, std::size_t end) { load(matrix, first, end); },
          [this](std::size_t row, std::span<std::uint8_t> values) { fill(row, values); }};
}

std::uint64_t ShadowSpool::bytes_for(const RasterFrame& frame) {
  const std::uint64_t tile = shadow_matrix_count * tile_pixels * matrix_bytes;
  const std::uint64_t rows = frame.threads * NpzFile::rows_at_once(frame.columns * shadow_patch_count);
  return std::max<std::uint64_t>(tile, rows * tiles_along(frame.columns) * raster_tile_edge * matrix_bytes);
}

}  // namespace farlod
