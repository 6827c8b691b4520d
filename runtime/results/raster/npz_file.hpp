// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace farlod {

/// An array of unsigned bytes, rows × columns × depth, whose rows are asked for when they are written.
struct NpzArray {
  std::string name;
  std::size_t rows = 0, columns = 0, depth = 0;
  /// Makes ready what `fill` needs of some rows. Called by one thread at a time, row after row.
  std::function<void(std::size_t first_row, std::size_t end_row)> load;
  /// The columns · depth values of one of these rows. Called by several threads at once.
  std::function<void(std::size_t row, std::span<std::uint8_t> values)> fill;

  [[nodiscard]] std::size_t row_bytes() const { return columns * depth; }
};

/// Writes a ZIP file of compressed arrays that NumPy opens (numpy.load), larger than 4 GiB or not. The same arrays give the same
/// bytes, whatever the number of threads: members have the first time that a ZIP file can name.
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
  struct Member {
    std::string name;
    std::uint64_t place = 0, bytes = 0, compressed_bytes = 0;
    std::uint32_t crc = 0;
  };
  void write(std::span<const std::uint8_t> bytes);
  void write_piece(Member& member, std::span<const std::uint8_t> compressed, std::uint64_t bytes, std::uint32_t crc);
  void write_rows(const NpzArray& array, Member& member);
  void write_central_directory();

  std::filesystem::path result_;
  std::size_t threads_;
  std::ofstream stream_;
  std::uint64_t end_ = 0;
  std::vector<Member> members_;
};

}  // namespace farlod
