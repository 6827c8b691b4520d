// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <oneapi/tbb/parallel_for.h>
#include <zlib.h>

#include <array>
#include <limits>
#include <new>
#include <utility>
#include <vector>

#include "base/expects.hpp"
#include "results/raster/npz_file.hpp"

namespace farlod {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// The header of an array, whose length with it is a multiple of 64.
Bytes npy_header(const NpzArray& array) {
  const std::string of_bytes =
      "(" + std::to_string(array.rows) + ", " + std::to_string(array.columns) + ", " + std::to_string(array.depth) + ")";
  std::string text = "{'descr': '" + array.type +
                     "', 'fortran_order': False, 'shape': " + (array.shape.empty() ? of_bytes : array.shape) + ", }";
  constexpr std::size_t before = 10, multiple = 64;
  text.append(multiple - 1 - (before + text.size()) % multiple, ' ').append("\n");
  // The magic word, version 1.0, and the length of the text, little-endian
  const std::string begin{
      '\x93', 'N', 'U', 'M', 'P', 'Y', 1, 0, static_cast<char>(text.size() % 256), static_cast<char>(text.size() / 256)};
  const std::string all = begin + text;
  return {all.begin(), all.end()};
}

/// A piece of a member by itself, so that pieces are compressed by several threads: it ends at a whole byte, and knows nothing of
/// those before it.
struct Piece {
  Bytes compressed;
  std::uint32_t crc = 0;
};

/// Matrices of 0 and 1 have long runs. Those of Omiya, whose third is canopy, become 11 % as large; without a strategy, level 1
/// leaves 15 % in two thirds of the time, level 6 8 % in four times.
constexpr int npz_compression_level = 6, npz_strategy = Z_RLE;
constexpr int raw_window_bits = -15, npz_memory_level = 9;

Piece piece_of(const Bytes& bytes) {
  FARLOD_EXPECTS(bytes.size() < std::numeric_limits<uInt>::max() / 2);
  z_stream stream{};
  if (deflateInit2(&stream, npz_compression_level, Z_DEFLATED, raw_window_bits, npz_memory_level, npz_strategy) != Z_OK)
    throw std::bad_alloc();
  constexpr std::size_t end_of_flush = 16;
  Piece piece{Bytes(deflateBound(&stream, bytes.size()) + end_of_flush),
              static_cast<std::uint32_t>(crc32(0, bytes.data(), static_cast<uInt>(bytes.size())))};
  // zlib only reads there
  stream.next_in = const_cast<Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = piece.compressed.data();
  stream.avail_out = static_cast<uInt>(piece.compressed.size());
  const int flushed = deflate(&stream, Z_FULL_FLUSH);
  FARLOD_EXPECTS(flushed == Z_OK && stream.avail_in == 0 && stream.avail_out > 0);
  piece.compressed.resize(stream.total_out);
  deflateEnd(&stream);
  return piece;
}

/// An empty last block.
constexpr std::array<std::uint8_t, 2> end_of_deflated{3, 0};

}  // namespace

NpzFile::NpzFile(const std::filesystem::path& path, std::filesystem::path result, std::size_t threads)
    : threads_(threads), zip_(path, std::move(result)) {}

void NpzFile::write_rows(const NpzArray& array) {
  const std::size_t rows_of_piece = rows_at_once(array.row_bytes());
  for (std::size_t first = 0; first < array.rows; first += threads_ * rows_of_piece) {
    const std::size_t end = std::min(array.rows, first + threads_ * rows_of_piece);
    array.load(first, end);
    std::vector<Piece> pieces((end - first + rows_of_piece - 1) / rows_of_piece);
    oneapi::tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t n) {
      const std::size_t begin = first + n * rows_of_piece, rows = std::min(rows_of_piece, end - begin);
      Bytes values(rows * array.row_bytes());
      for (std::size_t row = 0; row < rows; ++row)
        array.fill(begin + row, std::span(values).subspan(row * array.row_bytes(), array.row_bytes()));
      pieces[n] = piece_of(values);
    });
    for (std::size_t n = 0; n < pieces.size(); ++n) {
      const std::size_t rows = std::min(rows_of_piece, end - first - n * rows_of_piece);
      zip_.append(pieces[n].compressed, rows * array.row_bytes(), pieces[n].crc);
    }
  }
}

void NpzFile::add(const NpzArray& array) {
  zip_.begin(array.name + ".npy", ZipFile::Method::deflated);
  const Bytes header = npy_header(array);
  const Piece piece = piece_of(header);
  zip_.append(piece.compressed, header.size(), piece.crc);
  write_rows(array);
  zip_.append(end_of_deflated, 0, 0);
  zip_.end();
}

void NpzFile::close() { zip_.close(); }

}  // namespace farlod
