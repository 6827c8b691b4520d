// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/grid.hpp"
#include "city/city_model.hpp"
#include "farlod/pack.hpp"
#include "farmap/horizon_map_baker.hpp"
#include "pipeline/ground_load.hpp"
#include "tiles/crowns_on_ground.hpp"

namespace farlod::pipeline {

/// Blocks that are in work at a time, where there is memory: one is baked while another one is written.
inline constexpr std::size_t usual_blocks_at_once = 2;

/// On one core: baking and writing a far map of either kind.
inline constexpr double seconds_per_far_map = 4e-3;

/// The memory that packing takes. Pages of files take as much besides as there is.
struct PackMemory {
  double always_mib = 0.0;   ///< the program, and an index of the city: its buildings and cells
  double block_mib = 0.0;    ///< a block in work
  double on_disk_mib = 0.0;  ///< what lies in files

  [[nodiscard]] double in_memory_mib(std::size_t blocks) const;
  /// The least limit that can be kept: with one block in work.
  [[nodiscard]] double least_mib() const;
  /// How many blocks may be in work under the limit of a run, at most as many as wanted.
  [[nodiscard]] std::size_t blocks_at_once(std::size_t wanted, const RunSettings& run) const;
};

/// What is known of trees before they are placed.
struct CanopyLoad {
  std::uint64_t trees = 0;   ///< of inventories
  std::uint64_t pixels = 0;  ///< of a raster of canopies
  std::uint64_t cells = 0;   ///< of these, those that may have a crown
  bool has_trunks = false;   ///< whether there is a raster of trunks, too

  [[nodiscard]] std::uint64_t crowns() const { return trees + cells; }
};
[[nodiscard]] CanopyLoad canopy_load_of(const tiles::TreesOfCity& trees);

/// For cities of grounded buildings (Surface::grounded).
[[nodiscard]] PackMemory memory_of_pack(const CityModel& city, const GroundLoad& ground, const Grid& grid, FarMapKind far_map,
                                        const CanopyLoad& canopy = {});

/// Estimates memory and package size within a factor of two for cities of grounded buildings; cities of open shells have larger
/// far maps. The time is that of an idle machine like the one of docs/performance.md. `far_maps` are baked, of all cells when
/// absent.
[[nodiscard]] PackEstimate estimate_pack(const PackMemory& memory, const CityModel& city, const GroundLoad& ground,
                                         const Grid& grid, FarMapKind far_map, const CanopyLoad& canopy, std::size_t threads,
                                         std::optional<std::uint64_t> far_maps = {});

/// Throws LimitReached, whose message says what would do, when the limit cannot be kept; without one, when the machine has
/// clearly less memory than packing takes (is_beyond_machine).
void require_memory(const PackEstimate& estimate, const RunSettings& run);

}  // namespace farlod::pipeline
