// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "farlod/point.hpp"

namespace farlod {

/// The four walls of the box around a neighborhood, unrolled into one picture: east, north, west, south.
enum class BoxSide : std::uint8_t { east = 0, north = 1, west = 2, south = 3 };

/// A pixel of a far map. Columns run through the four sides, rows upwards from the horizontal.
struct Texel {
  std::uint32_t column = 0, row = 0;
  bool operator==(const Texel&) const = default;
};

/// How directions and texels of a far map of the kind `box` correspond (the paper's map, on a box instead of a cube).
///
/// A direction meets the wall of a square of half edge 1 at (across, up): `across` ∈ [−1, 1] runs counter-clockwise along the
/// side, `up` ∈ [0, top) is the height there. The box has no lid: it is as tall as the far city needs, so that what passes
/// above `top` is sky. Directions below the horizontal have no texel either, since the sky is not there.
///   (1) texel_of(direction_of(t)) == t for each texel
///   (2) directions between the sides and texels correspond everywhere but at the four vertical edges, which belong to
///       the east and west sides
struct BoxMap {
  std::uint32_t side_columns = 64;  ///< texels along one side; the picture has 4·side_columns columns
  std::uint32_t rows = 64;
  float top = 1.0F;  ///< height of the box as a multiple of its half edge, above the capture height

  [[nodiscard]] std::uint32_t columns() const { return 4 * side_columns; }

  /// The texel that a direction of the grid frame meets; none above the box and below the horizontal.
  [[nodiscard]] std::optional<Texel> texel_of(const Point3d& direction) const;
  /// The direction through the middle of a texel, not of length 1: its longer horizontal component is ±1.
  [[nodiscard]] Point3d direction_of(Texel texel) const;
};

inline std::optional<Texel> BoxMap::texel_of(const Point3d& d) const {
  const double reach = std::max(std::abs(d.x), std::abs(d.y));
  if (!(d.z >= 0.0) || !(d.z < static_cast<double>(top) * reach)) return std::nullopt;
  // Which side, and how far along it counter-clockwise
  const bool east_or_west = std::abs(d.x) >= std::abs(d.y);
  const auto side = east_or_west ? (d.x > 0.0 ? BoxSide::east : BoxSide::west) : (d.y > 0.0 ? BoxSide::north : BoxSide::south);
  const double across = (east_or_west ? d.y / d.x : -d.x / d.y);
  const double up = d.z / (static_cast<double>(top) * reach);
  const auto clamp_to = [](double x, std::uint32_t n) { return std::min(static_cast<std::uint32_t>(x * n), n - 1); };
  return Texel{static_cast<std::uint32_t>(side) * side_columns + clamp_to(0.5 * (across + 1.0), side_columns),
               clamp_to(up, rows)};
}

inline Point3d BoxMap::direction_of(Texel texel) const {
  const auto side = static_cast<BoxSide>(texel.column / side_columns);
  const double across = 2.0 * (texel.column % side_columns + 0.5) / side_columns - 1.0;
  const double up = static_cast<double>(top) * (texel.row + 0.5) / rows;
  switch (side) {
    case BoxSide::east:
      return {1.0, across, up};
    case BoxSide::north:
      return {-across, 1.0, up};
    case BoxSide::west:
      return {-1.0, -across, up};
    case BoxSide::south:
      break;
  }
  return {across, -1.0, up};
}

}  // namespace farlod
