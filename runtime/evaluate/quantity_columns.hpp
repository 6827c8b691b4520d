// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "farlod/quantities.hpp"

namespace farlod {

/// What the names of the columns of horizons begin with (columns_of).
inline constexpr std::string_view horizon_column = "horizon";

/// Patches of each band from the horizon upwards, without the zenith, and the bands' height as a share of the right angle. A band
/// of Reinhart's is half of one of Tregenza's, with twice as many patches; the zenith takes what is left.
struct PatchBands {
  std::vector<std::uint32_t> counts;
  double height = 0.0;
};
[[nodiscard]] PatchBands patch_bands_of(SkyPatchSet set);

/// Where svf_total is among columns_of, and its lower bound, which the upper one follows; nothing where they are not.
struct TotalColumns {
  std::optional<std::size_t> total, low;
};
[[nodiscard]] TotalColumns total_columns_of(const Quantities& quantities);

/// The last columns of columns_of: those of canopies.
[[nodiscard]] std::size_t count_canopy_columns(const Quantities& quantities);

}  // namespace farlod
