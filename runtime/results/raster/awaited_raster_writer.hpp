// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <thread>

#include "results/raster/raster_writer.hpp"

namespace farlod {

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
