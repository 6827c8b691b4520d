// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <vector>

#include "farlod/raster.hpp"
#include "farlod/shadow_patches.hpp"
#include "results/raster/npz_file.hpp"
#include "results/raster/raster_writer.hpp"
#include "results/spool_file.hpp"

namespace farlod {

/// Turns the columns of Quantities::shadow_patches, which come tile by tile, into the three matrices of UMEP: rows × columns ×
/// 153 bytes of 0 and 1, from the north-west. Until then they lie in a file beside the result, 63 bytes a pixel.
///
/// UMEP has a value for each pixel. Pixels without data, which are those inside buildings, see no sky (0 in the matrix of
/// buildings), and no crown (1 in those of vegetation).
class ShadowSpool {
 public:
  /// All functions throw OutputError, which names `result`.
  ShadowSpool(const RasterFrame& frame, const std::filesystem::path& result);

  /// `columns` are the shadow_column_count bands of a tile.
  void add(TilePlace place, std::span<const std::span<const float>> columns);
  /// The three matrices, by UMEP's names. One at a time is read; the spool must outlive it.
  [[nodiscard]] NpzArray matrix(ShadowMatrix matrix);

  /// What a tile is packed into, and what reading a matrix takes with so many threads.
  [[nodiscard]] static std::uint64_t bytes_for(const RasterFrame& frame);

 private:
  void load(ShadowMatrix matrix, std::size_t first_row, std::size_t end_row);
  void fill(std::size_t row, std::span<std::uint8_t> values) const;

  std::size_t columns_, rows_;
  SpoolFile file_;
  std::map<TilePlace, std::uint64_t> places_;  ///< in the file
  std::size_t first_row_ = 0;                  ///< of those that are loaded
  std::vector<std::uint8_t> loaded_;           ///< bits of whole rows of tiles, row by row
};

}  // namespace farlod
