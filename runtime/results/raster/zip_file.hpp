// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

namespace farlod {

/// Writes a ZIP file, larger than 4 GiB or not. The same members give the same bytes: all have the first time that a ZIP file can
/// name, 1 January 1980.
class ZipFile {
 public:
  enum class Method : std::uint16_t { stored = 0, deflated = 8 };

  /// Writes to `path`. All functions throw OutputError, which names `result`.
  ZipFile(const std::filesystem::path& path, std::filesystem::path result);

  /// A member in pieces: each as it stands in the file, and the length and the CRC-32 of what it stands for.
  void begin(std::string name, Method method);
  void append(std::span<const std::uint8_t> piece, std::uint64_t bytes, std::uint32_t crc);
  void end();
  /// A file as it is, under its own name.
  void add(const std::filesystem::path& file);
  /// Without it, the file is none.
  void close();

 private:
  struct Member {
    std::string name;
    Method method = Method::stored;
    std::uint64_t place = 0, bytes = 0, bytes_in_file = 0;
    std::uint32_t crc = 0;
  };
  void write(std::span<const std::uint8_t> bytes);
  void write_local_header(const Member& member);
  void write_central_directory();

  std::filesystem::path result_;
  std::ofstream stream_;
  std::uint64_t end_ = 0;
  std::vector<Member> members_;
};

}  // namespace farlod
