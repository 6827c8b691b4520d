// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "results/raster/raster_frame.hpp"

namespace farlod {

/// Writes a raster tile by tile, so that nobody has to hold the whole raster. The file appears with commit(), and not before. A
/// format of several files lets the others appear first.
class RasterWriter {
 public:
  RasterWriter() = default;
  virtual ~RasterWriter() = default;
  RasterWriter(const RasterWriter&) = delete;
  RasterWriter& operator=(const RasterWriter&) = delete;

  /// Tiles come in any order, each once or not at all. The same order gives the same bytes. Throws OutputError.
  virtual void write(const RasterTile& tile) = 0;
  /// Tiles that did not come have no data. Throws OutputError.
  virtual void commit() = 0;
};

}  // namespace farlod
