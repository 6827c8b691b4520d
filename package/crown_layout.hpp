// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "package/crown.hpp"
#include "package/layout.hpp"

/// The bytes of `crowns.bin`, which packages of cities with trees have, and no others: a header, a record for each cell that has
/// crowns, and the crowns, without gaps between them. docs/package_format.md tells the same in words; where they differ, this
/// file wins. All numbers are little-endian.
namespace farlod::package {

/// The version of `crowns.bin`, which changes on its own.
inline constexpr std::uint32_t crowns_version = 1;
inline constexpr std::array<char, 8> crowns_magic{'F', 'A', 'R', 'L', 'O', 'D', 'C', '\n'};
inline constexpr const char* crowns_file = "crowns.bin";  ///< in the folder of the package

/// Limit of the coordinates and the half width of a crown.
inline constexpr float farthest_crown_m = 1.3e7F;

struct CrownsHeader {
  std::array<char, 8> magic;
  std::uint32_t version;
  float largest_half_width_m;  ///< of all crowns: how far from a cell those can lie that reach it
  std::uint64_t cell_count;    ///< cells that have crowns
  std::uint64_t crown_count;
  std::uint64_t file_bytes;
  std::array<std::uint8_t, 24> reserved;  ///< zero
};
static_assert(sizeof(CrownsHeader) == 64);

/// A cell that has crowns: those whose axes lie in it. Cells are in order, row by row from the south, each row from the west.
struct CrownCellRecord {
  std::int32_t i, j;
  std::uint64_t first_crown;  ///< where its crowns begin; those of the cell before end there
  std::uint32_t crown_count;  ///< above 0
  float z_low_m, z_high_m;    ///< the least bottom and the largest top of its crowns
  std::uint32_t reserved;     ///< zero
};
static_assert(sizeof(CrownCellRecord) == 32);

// Crown: the frame is that of the cell, as for the vertices of its tile
static_assert(std::is_trivially_copyable_v<Crown> && alignof(Crown) == 4 && alignof(CrownCellRecord) == 8);

/// What a `crowns.bin` of so many cells and crowns has; neither of the two may exceed 2³⁶.
[[nodiscard]] constexpr std::uint64_t crowns_file_bytes(std::uint64_t cell_count, std::uint64_t crown_count) {
  return sizeof(CrownsHeader) + cell_count * sizeof(CrownCellRecord) + crown_count * sizeof(Crown);
}

}  // namespace farlod::package
