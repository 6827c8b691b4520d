// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "farlod/box.hpp"
#include "package/crown.hpp"

namespace farlod {

/// When pixels of a canopy raster count as one.
struct PixelMerging {
  /// An aligned square of pixels is one prism for those who are so many of its edges away from it.
  double edges_away = 12.0;
};
/// Each pixel counts by itself, wherever a receiver is.
inline constexpr PixelMerging no_pixel_merging{std::numeric_limits<double>::infinity()};

/// Crowns of which those that are pixels of a canopy raster are merged, the more the farther away they are: 2 × 2 pixels, 4 × 4
/// and so on. docs/concepts.md, "Canopies of rasters". Immutable: threads may share it.
class CanopyLevels {
 public:
  /// Prisms of one size, turn and foliage are pixels of one raster; the levels of squares go on as long as a square is no larger
  /// than `largest_square_m`.
  explicit CanopyLevels(const std::vector<Crown>& crowns, double largest_square_m = 16.0);

  /// Whether all places see the same crowns, since there are no pixels.
  [[nodiscard]] bool has_pixels() const { return !rasters_.empty(); }
  /// What stands for the crowns as seen from the places of a box, in an order that depends on nothing else.
  [[nodiscard]] std::vector<Crown> seen_from(const Box2d& places, const PixelMerging& merging = {}) const;

 private:
  /// A square with its pixels, of which there is one at least, as one prism.
  struct Square {
    std::uint64_t place;  ///< column and row of the square, their bits in turn
    Crown crown;
    std::size_t first, end;  ///< its quarters in the level below
  };
  struct Raster {
    double pixel_m;
    std::vector<std::vector<Square>> levels;  ///< from the pixels upwards, each in the order of the places
  };

  static std::vector<Square> squares_over(const std::vector<Square>& quarters);
  static void add_seen(const Raster& raster, std::size_t level, const Square& square, const Box2d& places,
                       const PixelMerging& merging, std::vector<Crown>& seen);

  std::vector<Crown> single_;
  std::vector<Raster> rasters_;
};

}  // namespace farlod
