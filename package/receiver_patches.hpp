// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "base/expects.hpp"
#include "farlod/point.hpp"

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

}  // namespace farlod
