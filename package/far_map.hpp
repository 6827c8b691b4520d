// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "base/azimuth.hpp"
#include "base/expects.hpp"
#include "farlod/point.hpp"
#include "package/horizon_edge.hpp"
#include "package/layout.hpp"

namespace farlod {

/// A box of places where receivers may be, in the cell frame.
struct PatchBox {
  Point2d low, high;
  double z_low_m = 0.0, z_high_m = 0.0;
};

/// How a far map of the kind `horizon` divides the places of its cell: squares in the plan, and layers in height, since a roof
/// looks over what a street does not. A patch is one layer of one square.
///   (1) each place at or above the lowest level belongs to one patch
///   (2) the uppermost layer has no lid
class ReceiverPatches {
 public:
  /// `levels_m` are the floors of the layers, ascending.
  ReceiverPatches(double cell_edge_m, std::uint32_t squares_per_edge, std::vector<float> levels_m)
      : cell_edge_m_(cell_edge_m), squares_per_edge_(squares_per_edge), levels_m_(std::move(levels_m)) {
    FARLOD_EXPECTS(squares_per_edge_ > 0 && !levels_m_.empty());
  }

  [[nodiscard]] std::uint32_t squares_per_edge() const { return squares_per_edge_; }
  [[nodiscard]] std::uint32_t layers() const { return static_cast<std::uint32_t>(levels_m_.size()); }
  [[nodiscard]] std::uint32_t squares() const { return squares_per_edge_ * squares_per_edge_; }
  [[nodiscard]] std::uint32_t count() const { return squares() * layers(); }
  [[nodiscard]] const std::vector<float>& levels_m() const { return levels_m_; }

  /// Where a layer ends; infinite for the uppermost.
  [[nodiscard]] double ceiling_m(std::uint32_t layer) const {
    return layer + 1 < layers() ? static_cast<double>(levels_m_[layer + 1]) : std::numeric_limits<double>::infinity();
  }
  /// Patches are numbered layer by layer, each square by square from the south-west.
  [[nodiscard]] std::uint32_t number(std::uint32_t square, std::uint32_t layer) const { return layer * squares() + square; }
  [[nodiscard]] PatchBox box(std::uint32_t patch) const {
    const std::uint32_t square = patch % squares(), layer = patch / squares();
    const double edge = cell_edge_m_ / squares_per_edge_;
    const std::uint32_t column = square % squares_per_edge_, row = square / squares_per_edge_;
    const Point2d low{column * edge, row * edge};
    return {low, low + Point2d{edge, edge}, levels_m_[layer], ceiling_m(layer)};
  }
  /// The layer of a height; the lowest for all below.
  [[nodiscard]] std::uint32_t layer_of(float z_m) const {
    // The last level at or below it: layers without thickness hold nothing
    const auto above = std::upper_bound(levels_m_.begin() + 1, levels_m_.end(), z_m);
    return static_cast<std::uint32_t>(above - levels_m_.begin()) - 1;
  }
  /// None below the lowest level.
  [[nodiscard]] std::optional<std::uint32_t> patch_of(const Point3f& p_cell) const {
    if (!(p_cell.z >= levels_m_.front())) return std::nullopt;
    const auto square_along = [&](float x) {
      const double k = std::floor(static_cast<double>(x) * squares_per_edge_ / cell_edge_m_);
      return static_cast<std::uint32_t>(std::clamp(k, 0.0, squares_per_edge_ - 1.0));
    };
    return number(square_along(p_cell.y) * squares_per_edge_ + square_along(p_cell.x), layer_of(p_cell.z));
  }

 private:
  double cell_edge_m_;
  std::uint32_t squares_per_edge_;
  std::vector<float> levels_m_;
};

/// The explicit occluders of a cell's far map. Views of what somebody else owns: the mapped file.
struct ExplicitOccluders {
  std::span<const HorizonEdge> edges;  ///< of the whole block, block frame
  std::span<const package::ExplicitOccluder> explicit_edges;
  Point2d cell_from_block_m;  ///< added to a place of the block frame, gives the cell frame
};

/// The far map of a cell, of the kind `horizon`: what the city beyond the neighborhood hides. The residual city is all of the far
/// city that is not explicit. Slopes are tangents of elevations, for each patch a row of azimuth bins (grid frame).
///   (1) from every place in a patch, all of the residual city lies below `high`
///   (2) from every place in a patch, everything below `low` is hidden, unless it lies below `overhang` or below a lower border
///       that is explicit or near
///   (3) `estimate` is the horizon of the residual city, averaged over the patch's floor; between two floors it is interpolated
///   (4) from every place in a patch, no lower border of the residual city (EdgeRole::underside) rises above `overhang`, but
///       those that stand before residual grounded edges that are higher
struct FarHorizon {
  ReceiverPatches patches;
  AzimuthBins bins;
  std::vector<float> low, estimate, high, overhang;
  ExplicitOccluders occluders;

  /// The bins of a patch, in `low`, `estimate`, `high` or `overhang`.
  [[nodiscard]] std::span<const float> row(const std::vector<float>& slopes, std::uint32_t patch) const {
    return std::span(slopes).subspan(static_cast<std::size_t>(patch) * bins.count, bins.count);
  }
  /// The layers, as bits, whose explicit occluders count for receivers between two heights: the layers that hold those heights,
  /// and the next one above. That one counts too because `estimate` is interpolated towards its floor, and leaves out what is
  /// explicit there.
  [[nodiscard]] std::uint32_t layers_met_from(float z_low_m, float z_high_m) const {
    const std::uint32_t lowest = patches.layer_of(z_low_m), highest = patches.layer_of(z_high_m) + 1;
    return (std::uint32_t{2} << highest) - (std::uint32_t{1} << lowest);
  }
  /// For the interpolation of `estimate`: the patch above, and the fraction of the way from the floor of `patch` to the floor of
  /// that one at which a height lies, from 0 to 1. The uppermost patch is its own.
  [[nodiscard]] std::pair<std::uint32_t, float> floor_above(std::uint32_t patch, float z_m) const {
    const std::vector<float>& levels_m = patches.levels_m();
    const std::uint32_t layer = patch / patches.squares();
    if (layer + 1 >= levels_m.size()) return {patch, 0.0F};
    const float thickness_m = levels_m[layer + 1] - levels_m[layer];
    return {patch + patches.squares(), thickness_m > 0.0F ? std::max(0.0F, z_m - levels_m[layer]) / thickness_m : 0.0F};
  }
};

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

/// The far map of a cell, of the kind `box`, as captured.
struct BakedBox {
  Point3f capture_cell;  ///< capture point, cell frame
  BoxMap shape;
  /// Texel rows from the horizontal upwards; infinite where the sky is seen; empty when all is sky.
  std::vector<float> distance_m;
};

/// The far map of a cell, of the kind `horizon`: a few explicit occluders, and of the residual city what FarHorizon promises.
struct BakedHorizon {
  ReceiverPatches patches;
  std::vector<package::ExplicitOccluder> explicit_edges;
  std::vector<float> low, estimate, high, overhang;
};

/// A block's far maps, in the order of CellRange::index_of.
using BakedBoxes = std::vector<BakedBox>;
struct BakedHorizons {
  std::vector<HorizonEdge> edges;  ///< the explicit ones of its cells, in the frame of its south-west cell
  std::vector<BakedHorizon> cells;
};
using BakedBlock = std::variant<BakedBoxes, BakedHorizons>;

}  // namespace farlod
