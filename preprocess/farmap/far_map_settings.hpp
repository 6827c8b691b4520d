// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace farlod {

enum class FarMapKind : std::uint8_t {
  horizon,  ///< occluders by name and bounds for the rest: without parallax
  box       ///< the paper's: a picture on the walls of a box, looked up by direction alone
};

/// Of the kind `box`.
struct BoxMapSettings {
  std::uint32_t side_columns = 64;
  std::uint32_t rows = 64;
  double capture_height_m = 1.5;  ///< above the ground at the cell's centre, where most receivers will stand
};

/// Of the kind `horizon`.
struct HorizonMapSettings {
  std::uint32_t azimuth_bins = 256;
  std::uint32_t squares_per_edge = 1;  ///< 1 to 4
  std::uint32_t layers = 8;            ///< 2 to package::most_layers
  /// An occluder is explicit where it may rise higher than this (sine of the elevation) over what surely or likely hides the sky.
  double tolerance = 0.05;
  /// An occluder that rises less than this share of the tolerance over what all viewpoints see is not looked at for what is
  /// likely.
  double weakest = 0.6;
};

struct FarMapSettings {
  FarMapKind kind = FarMapKind::horizon;
  BoxMapSettings box;
  HorizonMapSettings horizon;
};

}  // namespace farlod
