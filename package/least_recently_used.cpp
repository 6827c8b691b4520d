// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/least_recently_used.hpp"

namespace farlod {

std::vector<std::size_t> LruCache::use(std::size_t item, std::uint64_t bytes) {
  // Move the item to the front, or put it there
  const auto known = entries_.find(item);
  if (known != entries_.end()) {
    by_use_.splice(by_use_.begin(), by_use_, known->second);
  } else {
    by_use_.push_front({item, bytes});
    entries_[item] = by_use_.begin();
    bytes_ += bytes;
  }
  // Evict from the back until the rest fits; the item itself stays
  std::vector<std::size_t> evicted;
  while (bytes_ > limit_bytes_ && by_use_.size() > 1) {
    evicted.push_back(by_use_.back().item);
    bytes_ -= by_use_.back().bytes;
    entries_.erase(by_use_.back().item);
    by_use_.pop_back();
  }
  return evicted;
}

}  // namespace farlod
