// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace farlod {

/// A text file that is written by appending and gets its name when it is committed. A file that is not committed is removed. A
/// destination that is a pipe is written to at once, and cannot be overwritten. Uses a buffer of fixed size. All members throw
/// OutputError.
class CityTextFile {
 public:
  explicit CityTextFile(std::filesystem::path destination);
  ~CityTextFile();
  CityTextFile(const CityTextFile&) = delete;
  CityTextFile& operator=(const CityTextFile&) = delete;

  /// The buffer to append to. Call `drain` after each building.
  [[nodiscard]] std::string& text() { return buffer_; }
  /// Writes the buffer to the file if it is full.
  void drain() {
    if (buffer_.size() >= buffer_bytes) flush();
  }
  /// The number of bytes appended so far.
  [[nodiscard]] std::uint64_t position() const { return flushed_bytes_ + buffer_.size(); }
  /// Overwrites the bytes from `position` on.
  void overwrite(std::uint64_t position, std::string_view text);
  /// Appends the whole text of another file, which is not committed.
  void append(CityTextFile& other);
  /// Returns the number of bytes in the file.
  std::uint64_t commit();

 private:
  static constexpr std::size_t buffer_bytes = std::size_t{1} << 20U;
  void flush();
  [[noreturn]] void fail() const;

  std::filesystem::path destination_, temporary_;  ///< a pipe has no temporary file
  std::fstream file_;
  std::string buffer_;
  std::uint64_t flushed_bytes_ = 0;
};

/// Appends whole millimetres as metres with three decimals.
void append_metres(std::string& text, std::int64_t value_mm);

}  // namespace farlod
