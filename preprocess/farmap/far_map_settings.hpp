// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "farlod/pack.hpp"

namespace farlod {

/// Settings of the kind `box`.
struct BoxMapSettings {
  std::uint32_t side_columns = 64;
  std::uint32_t rows = 64;
  double capture_height_m = 1.5;  ///< above the ground at the cell's centre, where most receivers will stand
};

/// Settings of the kind `horizon`.
struct HorizonMapSettings {
  std::uint32_t azimuth_bins = 256;
  std::uint32_t squares_per_edge = 1;  ///< 1 to 4
  std::uint32_t layers = 8;            ///< 2 to package::most_layers
  /// An occluder is explicit where it may rise by more than this (sine of the elevation) over what hides the sky anyway.
  double tolerance = 0.05;
  /// A hidden occluder is weak, and counts for the estimate, where it may rise by more than this share of the tolerance.
  double weak_share = 0.6;
};

struct FarMapSettings {
  FarMapKind kind = FarMapKind::horizon;
  BoxMapSettings box;
  HorizonMapSettings horizon;
};

}  // namespace farlod
