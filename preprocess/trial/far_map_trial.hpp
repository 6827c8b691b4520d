// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stop_token>

#include "base/grid.hpp"
#include "farlod/pack.hpp"
#include "farmap/horizon_map_baker.hpp"
#include "package/tile_set.hpp"
#include "tiles/tiles.hpp"

namespace farlod {

/// The receivers of a trial: at random places of random cells, one half on the ground, one half on whatever is highest there.
struct FarErrorSettings {
  std::size_t cells = 24;
  std::size_t receivers_per_cell = 16;  ///< tried: those on ground that is built over are left out
  std::size_t rays = 1000;
  std::uint64_t seed = 20120901;
  double eye_height_m = 1.5;  ///< above the ground; on roofs receivers stand on the roof itself
};

/// Tries out far maps of the kind `horizon`: bakes those of a few cells, and evaluates receivers there with the evaluator that
/// farlod-svf uses. Receivers and their exact answers depend on neither the neighborhood nor the far maps, and are found once.
class FarMapTrial {
 public:
  /// The tiles must outlive it. Both functions end with Cancelled when `stop` is asked for.
  FarMapTrial(const TileSet& tiles, const Grid& grid, Assign assign, const FarErrorSettings& settings, std::stop_token stop = {});
  ~FarMapTrial();

  /// The same for the same arguments, on every machine and for any number of threads.
  [[nodiscard]] FarErrorEstimate run(int neighborhood, const HorizonMapSettings& far_map) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace farlod
