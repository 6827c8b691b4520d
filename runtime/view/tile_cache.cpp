// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/tile_cache.hpp"

namespace farlod {

std::shared_ptr<const std::string> TileCache::get(const TileAddress& tile, const std::function<std::string()>& make) {
  {
    const std::scoped_lock lock(mutex_);
    const auto found = entries_.find(tile);
    if (found != entries_.end()) {
      uses_.splice(uses_.begin(), uses_, found->second.use);
      return found->second.glb;
    }
  }
  auto made = std::make_shared<const std::string>(make());
  const std::scoped_lock lock(mutex_);
  if (entries_.contains(tile)) return made;
  uses_.push_front(tile);
  entries_[tile] = {made, uses_.begin()};
  bytes_ += made->size();
  let_go();
  return made;
}

void TileCache::let_go() {
  while (bytes_ > most_bytes_ && uses_.size() > 1) {
    const auto oldest = entries_.find(uses_.back());
    bytes_ -= oldest->second.glb->size();
    entries_.erase(oldest);
    uses_.pop_back();
  }
}

}  // namespace farlod
