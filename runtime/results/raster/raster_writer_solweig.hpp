// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "results/atomic_file.hpp"
#include "results/raster/raster_writer.hpp"
#include "results/raster/shadow_spool.hpp"

namespace farlod {

/// Writes a folder with all that SOLWEIG of UMEP reads, on one grid: `svfs.zip` has the bands as zipped_geotiff_writer() writes
/// them, and `shadowmats.npz` those of Quantities::shadow_patches as matrices of 0 and 1, where the frame has them.
/// What write_surface_rasters() writes is there as well, where the frame has a package.
class SolweigWriter final : public RasterWriter {
 public:
  /// Throws OutputError where there is something of this name that is no such folder.
  SolweigWriter(const RasterFrame& frame, const std::filesystem::path& path);
  void write(const RasterTile& tile) override;
  void commit() override;
  /// What write() and commit() hold.
  [[nodiscard]] static std::uint64_t bytes_for(const RasterFrame& frame);

 private:
  void write_shadow_matrices();

  RasterFrame frame_;
  AtomicFolder folder_;
  std::size_t shadow_band_;  ///< the first of them; the number of bands where there are none
  std::optional<ShadowSpool> shadows_;
  std::unique_ptr<RasterWriter> svfs_;
};

}  // namespace farlod
