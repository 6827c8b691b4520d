// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <type_traits>

#include "farlod/canopy.hpp"
#include "farlod/point.hpp"
#include "package/layout.hpp"

namespace farlod {

/// The shape that a crown fills evenly.
enum class CrownShape : std::uint8_t {
  spheroid,  ///< with a vertical axis
  cylinder,  ///< upright
  prism      ///< an upright square: a pixel of a canopy raster
};

inline constexpr std::size_t crown_shape_count = 3;

/// What winter does to a crown.
enum class Foliage : std::uint8_t { unknown, evergreen, deciduous };

/// A crown, as it is stored (crowns.bin) and computed with. A trunk is no part of it.
struct Crown {
  float x_m, y_m;         ///< of its axis: of its cell's frame where it is stored, elsewhere of a frame that is named
  float bottom_m, top_m;  ///< heights of that frame; bottom < top
  float half_width_m;     ///< radius of a spheroid or a cylinder, half of a square's edge; above 0
  CrownShape shape;
  Foliage foliage;
  /// Turn of the square of a prism, counter-clockwise, in 65536ths of a right angle. Other shapes have 0.
  std::uint16_t turn;

  [[nodiscard]] double turn_rad() const { return turn * (std::numbers::pi / 2.0 / 65536.0); }
  bool operator==(const Crown&) const = default;
};
static_assert(sizeof(Crown) == 24);

/// The same crown in a frame that lies `by` from where the crown's own frame does, in the plan: its place there is larger by it.
[[nodiscard]] inline Crown moved(Crown crown, Point2d by) {
  crown.x_m = static_cast<float>(static_cast<double>(crown.x_m) + by.x);
  crown.y_m = static_cast<float>(static_cast<double>(crown.y_m) + by.y);
  return crown;
}

/// Whether a crown has shed its leaves.
[[nodiscard]] inline bool is_bare(Foliage foliage, Season season) {
  return season == Season::leaf_off && foliage != Foliage::evergreen;
}

/// ψ of a crown in a run: the share of the light that passes it.
[[nodiscard]] inline double transmissivity_of(Foliage foliage, const CanopySettings& settings) {
  if (is_bare(foliage, settings.season)) return settings.transmissivity.value_or(leaf_off_transmissivity);
  return settings.season == Season::leaf_on ? settings.transmissivity.value_or(leaf_on_transmissivity) : leaf_on_transmissivity;
}

/// κ of a crown in a run, in 1/m.
[[nodiscard]] inline double extinction_per_m_of(Foliage foliage, const CanopySettings& settings) {
  const double of_bare = std::log(leaf_off_transmissivity) / std::log(leaf_on_transmissivity);
  return is_bare(foliage, settings.season) ? of_bare * settings.extinction_per_m : settings.extinction_per_m;
}

}  // namespace farlod

namespace farlod::package {

/// The bytes of `crowns.bin`, which packages of cities with trees have, and no others: a header, a record for each cell that has
/// crowns, and the crowns, without gaps between them. docs/package_format.md tells the same in words; where they differ, this
/// file wins. All numbers are little-endian.

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
