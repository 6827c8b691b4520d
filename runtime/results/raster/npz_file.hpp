// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "results/raster/zip_file.hpp"

namespace farlod {

/// An array of unsigned bytes, rows × columns × depth, whose rows are asked for when they are written. One of another type or
/// shape has rows of as many bytes.
struct NpzArray {
  std::string name;
  std::size_t rows = 0, columns = 0, depth = 0;
  /// Makes ready what `fill` needs of some rows. Called by one thread at a time, row after row.
  std::function<void(std::size_t first_row, std::size_t end_row)> load;
  /// The columns · depth values of one of these rows. Called by several threads at once.
  std::function<void(std::size_t row, std::span<std::uint8_t> values)> fill;
  std::string type = "|u1";  ///< as NumPy writes it
  std::string shape = {};    ///< the same, such as "(3,)"; empty: (rows, columns, depth)

  [[nodiscard]] std::size_t row_bytes() const { return columns * depth; }
};

/// Writes a ZIP file of compressed arrays that NumPy opens (numpy.load). The same arrays give the same bytes, whatever the number
/// of threads.
class NpzFile {
 public:
  /// Writes to `path`. All functions throw OutputError, which names `result`.
  NpzFile(const std::filesystem::path& path, std::filesystem::path result, std::size_t threads);
  void add(const NpzArray& array);
  /// Without it, the file is none.
  void close();

  /// Rows that a thread compresses at once.
  [[nodiscard]] static constexpr std::size_t rows_at_once(std::size_t row_bytes) {
    constexpr std::size_t bytes_at_once = 1 << 20;
    return std::max<std::size_t>(1, bytes_at_once / std::max<std::size_t>(1, row_bytes));
  }
  /// What add() holds, besides what load() does for rows_at_once() · `threads` rows: those rows, compressed or not, and the
  /// states of zlib.
  [[nodiscard]] static constexpr std::uint64_t bytes_for(std::size_t row_bytes, std::size_t threads) {
    constexpr std::uint64_t state_bytes = 1 << 19;
    return threads * (2 * rows_at_once(row_bytes) * row_bytes + state_bytes);
  }

 private:
  void write_rows(const NpzArray& array);

  std::size_t threads_;
  ZipFile zip_;
};

}  // namespace farlod
