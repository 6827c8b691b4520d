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

/// A temporary file beside a result, for bytes that are computed before their turn to be written. Removed by the destructor.
class SpoolFile {
 public:
  /// All functions throw OutputError, which names the result.
  explicit SpoolFile(const std::filesystem::path& result);

  /// Returns the position of the bytes.
  [[nodiscard]] std::uint64_t append(std::span<const std::byte> bytes);
  /// Fills `bytes` from this position.
  void read(std::uint64_t place, std::span<std::byte> bytes);

 private:
  std::filesystem::path result_;
  AtomicFile file_;
  std::fstream stream_;
  std::uint64_t end_ = 0;
};

}  // namespace farlod
