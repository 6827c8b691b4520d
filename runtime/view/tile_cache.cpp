// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/tile_cache.hpp"

#include <exception>

namespace farlod {

std::shared_ptr<const std::string> TileCache::get(const TileAddress& tile, const std::function<std::string()>& make) {
  std::unique_lock lock(mutex_);
  nobody_makes_it_.wait(lock, [&] { return !being_made_.contains(tile); });
  const auto found = entries_.find(tile);
  if (found != entries_.end()) {
    uses_.splice(uses_.begin(), uses_, found->second.use);
    return found->second.glb;
  }
  being_made_.insert(tile);
  lock.unlock();
  std::shared_ptr<const std::string> made;
  std::exception_ptr failure;
  try {
    made = std::make_shared<const std::string>(make());
  } catch (...) {
    failure = std::current_exception();
  }
  lock.lock();
  being_made_.erase(tile);
  nobody_makes_it_.notify_all();
  if (failure) std::rethrow_exception(failure);
  keep(tile, made);
  return made;
}

void TileCache::keep(const TileAddress& tile, const std::shared_ptr<const std::string>& made) {
  uses_.push_front(tile);
  entries_[tile] = {made, uses_.begin()};
  bytes_ += made->size();
  let_go();
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
