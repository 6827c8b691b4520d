// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "farlod/quantities.hpp"
#include "farlod/raster.hpp"
#include "results/provenance.hpp"

namespace farlod {

/// One of the numbers that a pixel has.
using Band = ColumnDescription;

/// The bands of sky view factors. `quantity` is "svf" or "svf_solid": the name of the first band; `_low` and `_high` behind it
/// are those of the bounds.
[[nodiscard]] std::vector<Band> svf_bands(const std::string& quantity, RasterBands bands);

/// The values of a tile, band by band in the order of RasterFrame::bands. They are those of the tile, and live as long.
[[nodiscard]] std::vector<std::span<const float>> bands_of(const RasterTile& tile);

/// Place, size and bands of a north-up raster in the output CRS, without its values. Row 0 is the northernmost.
struct RasterFrame {
  Point2d north_west_m;  ///< the outer corner of the first pixel, projected frame
  double step_m = 1.0;   ///< edge of a pixel
  std::size_t columns = 0, rows = 0;
  std::vector<Band> bands = {};  ///< at least one
  std::string crs_wkt = {};
  std::optional<int> epsg = {};  ///< the same CRS by its code, where it has one
  std::size_t threads = 1;       ///< of the run; a writer that compresses may use some. They change no byte
  Provenance provenance = {};
  const Package* package = nullptr;  ///< whose outlines and ground a picture shows; none of them where there is none
  std::size_t drawn_band = 0;        ///< which of the bands a picture shows
  std::string conditions = {};       ///< that it is drawn for, in words: when, below what sky, how high
  std::string why_no_value = {};     ///< of pixels outside of buildings, in a few words; empty: they have no data
  std::string landmark = {};         ///< the building that the drawn band is about, by its id; empty: it is about none
};

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

/// A writer that is made by a thread of its own while cells are evaluated, since loading GDAL takes as long as a small city does,
/// and is waited for at its first tile. That thread does all that the writer does, too: PROJ reads its database once for each
/// thread. Where the writer cannot be made, write() and commit() throw what its maker threw.
class AwaitedRasterWriter : public RasterWriter {
 public:
  using Make = std::function<std::unique_ptr<RasterWriter>()>;

  /// While the writer is made, its thread is one of the `threads` of the run.
  AwaitedRasterWriter(Make make, std::size_t threads);
  ~AwaitedRasterWriter() override;
  void write(const RasterTile& tile) override;
  void commit() override;

 private:
  using Made = std::shared_future<std::unique_ptr<RasterWriter>>;
  using Task = std::packaged_task<void(const Made&)>;

  void work(const Make& make, std::size_t threads);
  void do_in_thread(Task task);

  std::mutex mutex_;
  std::condition_variable changed_;
  Task task_;             ///< valid: to be done
  bool is_over_ = false;  ///< nothing more will come
  std::thread thread_;
};

}  // namespace farlod
