// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tiles/level_areas.hpp"
#include "tiles/pixel_square.hpp"
#include "tiles/stepped_surface.hpp"

namespace farlod::tiles {

/// Half a side of a pixel, where two surfaces end, or one; what is not there has the heights NaN. Counted in half pixels.
struct TornPiece {
  enum class Along { x, y };
  Along along;
  std::int64_t line, begin, end;                           ///< across, and along
  std::array<std::array<double, 2>, 2> heights_of_side_m;  ///< of what is left or below, and of the other: at begin and end

  [[nodiscard]] HalfPixels place(std::int64_t n) const { return along == Along::x ? HalfPixels{n, line} : HalfPixels{line, n}; }
  /// Half a pixel to a side.
  [[nodiscard]] HalfPixels aside(std::int64_t n, std::size_t side) const {
    const std::int64_t across = line + (side == 0 ? -1 : 1);
    return along == Along::x ? HalfPixels{n, across} : HalfPixels{across, n};
  }
  [[nodiscard]] bool is_level() const;
};

/// The walls on the lines between the pixels of a raster, and the borders of what ends there. Level pieces of one line that
/// continue each other become one.
class WallLines {
 public:
  WallLines(const PixelPlaces& at, std::size_t columns, SteppedSurface& surface)
      : at_(at), surface_(surface), northward_walls_(columns + 1), northward_tops_(columns + 1) {}

  /// Pieces of a line come from south to north, or from west to east; of two lines along x, one is ended before the next begins.
  void add(const TornPiece& piece);
  void end_line_along_x();
  void end();

 private:
  void add_level(const TornPiece& piece);
  void add_wall(const TornPiece& piece);
  void add_wall(TornPiece::Along along, std::int64_t line, const LevelRun::Run& run);
  void add_top(const TornPiece& piece, std::size_t side);
  void add_top(TornPiece::Along along, std::int64_t line, const LevelRun::Run& run);

  const PixelPlaces& at_;
  SteppedSurface& surface_;
  std::vector<LevelRun> northward_walls_, northward_tops_;
  LevelRun eastward_walls_, eastward_tops_;
  std::int64_t eastward_line_ = 0;
};

}  // namespace farlod::tiles
