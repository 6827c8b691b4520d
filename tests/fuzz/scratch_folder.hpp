// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>

#include "base/expects.hpp"

namespace farlod {

/// Readers open files by name. A folder in memory, the process's own, goes when the process ends.
class ScratchFolder {
 public:
  ScratchFolder() : path_(root() / ("farlod_fuzz_" + std::to_string(getpid()))) { std::filesystem::create_directories(path_); }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// A file in it with these bytes, in the place of an older one.
  [[nodiscard]] std::filesystem::path write(std::span<const std::uint8_t> bytes, const std::filesystem::path& name) const {
    const std::filesystem::path file = path_ / name;
    std::ofstream stream(file, std::ios::binary | std::ios::trunc);
    stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    stream.close();
    FARLOD_EXPECTS(stream);
    return file;
  }

 private:
  static std::filesystem::path root() {
    return std::filesystem::is_directory("/dev/shm") ? std::filesystem::path("/dev/shm") : std::filesystem::temp_directory_path();
  }

  std::filesystem::path path_;
};

}  // namespace farlod
