// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/lru_cache.hpp"

namespace farlod {

std::vector<std::size_t> LruCache::use(std::size_t thing, std::uint64_t bytes) {
  const auto known = places_.find(thing);
  if (known != places_.end()) {
    order_.splice(order_.begin(), order_, known->second);
  } else {
    order_.push_front({thing, bytes});
    places_[thing] = order_.begin();
    bytes_ += bytes;
  }
  std::vector<std::size_t> to_go;
  while (bytes_ > most_bytes_ && order_.size() > 1) {
    to_go.push_back(order_.back().thing);
    bytes_ -= order_.back().bytes;
    places_.erase(order_.back().thing);
    order_.pop_back();
  }
  return to_go;
}

}  // namespace farlod
