// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "results/raster_tile.hpp"

namespace farlod {

/// Writes a raster tile by tile, so that nobody has to hold it whole. The file appears when it is committed, and not before.
class RasterWriter {
 public:
  RasterWriter() = default;
  virtual ~RasterWriter() = default;
  RasterWriter(const RasterWriter&) = delete;
  RasterWriter& operator=(const RasterWriter&) = delete;

  /// Tiles come in any order, each once or not at all; the same order makes the same bytes. Throws OutputError.
  virtual void write(const RasterTile& tile) = 0;
  /// The tiles that did not come have no answers. Throws OutputError.
  virtual void commit() = 0;
};

}  // namespace farlod
