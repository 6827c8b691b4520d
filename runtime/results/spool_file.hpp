// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>

#include "results/atomic_file.hpp"

namespace farlod {

/// Bytes of a result that come before their turn wait on the disk, in a file beside the result that goes when this does.
class SpoolFile {
 public:
  /// Throws OutputError about the result, as do the other functions.
  explicit SpoolFile(const std::filesystem::path& result);

  /// Returns where the bytes are from now on.
  [[nodiscard]] std::uint64_t append(std::span<const std::byte> bytes);
  /// Fills `bytes` with what was appended there.
  void read(std::uint64_t place, std::span<std::byte> bytes);

 private:
  std::filesystem::path result_;
  AtomicFile file_;
  std::fstream stream_;
  std::uint64_t end_ = 0;
};

}  // namespace farlod
