// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <list>
#include <unordered_map>
#include <vector>

namespace farlod {

/// Decides which items stay in memory when not all of them fit: the least recently used are evicted. It only counts; the caller
/// loads and releases the items.
///   (1) the items that are kept hold no more bytes than the limit together, unless it is a single item
///   (2) the item that was used last is kept
class LruCache {
 public:
  /// Without a call there is no limit. What is too much now is evicted with the next use.
  void keep_at_most(std::uint64_t bytes) { limit_bytes_ = bytes; }
  /// An item is used, and is kept from now on. Returns the items that are evicted for it, the longest unused first.
  [[nodiscard]] std::vector<std::size_t> use(std::size_t item, std::uint64_t bytes);

 private:
  struct Kept {
    std::size_t item;
    std::uint64_t bytes;
  };
  std::uint64_t limit_bytes_ = std::numeric_limits<std::uint64_t>::max(), bytes_ = 0;
  std::list<Kept> by_use_;  ///< the last used first
  std::unordered_map<std::size_t, std::list<Kept>::iterator> entries_;
};

}  // namespace farlod
