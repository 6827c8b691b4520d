// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "view/tile_tree.hpp"

namespace farlod {

/// Tiles that were made, up to so many bytes: of more, those go that were asked for the longest ago.
class TileCache {
 public:
  explicit TileCache(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// The tile, made if it is not there. Of those who ask for a new one at the same time, one makes it, and the others wait; where
  /// it throws, the next one tries.
  [[nodiscard]] std::shared_ptr<const std::string> get(const TileAddress& tile, const std::function<std::string()>& make);

 private:
  struct Entry {
    std::shared_ptr<const std::string> glb;
    std::list<TileAddress>::iterator use;
  };
  void keep(const TileAddress& tile, const std::shared_ptr<const std::string>& made);
  void let_go();

  std::size_t most_bytes_, bytes_ = 0;
  std::mutex mutex_;
  std::condition_variable nobody_makes_it_;
  std::set<TileAddress> being_made_;
  std::map<TileAddress, Entry> entries_;
  std::list<TileAddress> uses_;  ///< the last one first
};

}  // namespace farlod
