// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "farlod/surfaces.hpp"
#include "results/spool_file.hpp"

namespace farlod {

/// Receivers on surfaces, kept on disk until all have come, for formats whose rows cannot be written as text beforehand. Parts
/// come in any order and go in that of their numbers. All functions throw OutputError, which names the result.
class SurfaceSpool {
 public:
  explicit SurfaceSpool(const std::filesystem::path& result) : file_(result) {}

  /// Each part comes once at the most.
  void add(std::size_t part, std::span<const SurfacePoint> rows);
  /// Hands over all rows, one by one; a row is valid during its call only.
  void for_each(const std::function<void(const SurfacePoint&)>& take);
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  struct Part {
    std::uint64_t begin;
    std::size_t bytes, rows;
  };
  SpoolFile file_;
  std::map<std::size_t, Part> parts_;
  std::size_t size_ = 0;
};

}  // namespace farlod
