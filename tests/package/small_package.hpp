// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "package/layout.hpp"
#include "package/package_folder.hpp"
#include "tests/scenes/packed_city.hpp"

namespace farlod {

inline constexpr float infinite = std::numeric_limits<float>::infinity();
inline constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

using Bytes = std::vector<std::byte>;

[[nodiscard]] Bytes bytes_of(const std::filesystem::path& path);
void write_bytes(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// A package of three cells in two blocks, (0, 0) with two cells and (1, 0) with one, a house in each; and the means to damage
/// it. A bridge between the houses is seen from under.
class SmallPackage {
 public:
  explicit SmallPackage(FarMapKind kind = FarMapKind::box);

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] std::filesystem::path file(Block block, const char* name) const {
    return folder_ / package::block_folder(block) / name;
  }
  /// Without its checksum.
  [[nodiscard]] nlohmann::json manifest() const;
  /// With a checksum that is right.
  void write_manifest(const nlohmann::json& manifest) const;
  /// Makes the manifest tell size and checksum of the files as they are now, so that damage gets past those.
  void stamp_anew() const;

  static constexpr Block two_cells{0, 0}, one_cell{1, 0};
  static constexpr CellRange cells_of_two{0, 0, 2, 1};

 private:
  scenes::TemporaryFolder temporary_;
  std::filesystem::path folder_ = temporary_.path() / "small.farlod";
};

/// A `tiles.bin` in memory, to be changed byte by byte.
class TilesBytes {
 public:
  explicit TilesBytes(Bytes bytes) : bytes_(std::move(bytes)) {}

  [[nodiscard]] Bytes& bytes() { return bytes_; }
  [[nodiscard]] package::Header& header() { return at<package::Header>(0); }
  [[nodiscard]] package::Section& section(package::SectionKind kind);
  /// The n-th element of a section.
  template <class T>
  [[nodiscard]] T& element(package::SectionKind kind, std::size_t n) {
    return at<T>(section(kind).offset + n * sizeof(T));
  }
  template <class T>
  [[nodiscard]] T& at(std::size_t offset) {
    return *reinterpret_cast<T*>(bytes_.data() + offset);
  }

 private:
  Bytes bytes_;
};

/// What a PackageDamaged says; "no damage" when nothing is thrown.
[[nodiscard]] std::string damage_met_by(const std::function<void()>& work);

}  // namespace farlod
