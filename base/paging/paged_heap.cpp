// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "base/paging/paged_heap.hpp"

#include <algorithm>
#include <cstdlib>
#include <list>
#include <mutex>

#include "base/paging/page_file.hpp"
#include "base/paging/pages.hpp"

namespace farlod {
namespace {

/// Smaller pieces would leave holes in the files.
constexpr std::size_t least_piece = std::size_t{64} << 10;
/// Each file is a quarter of all before it, or as large as this: few files, little of their room unused.
constexpr std::size_t least_file = std::size_t{16} << 20;

/// A file, filled from its beginning. It ends when none of its pieces is in use.
struct Segment {
  PageFile file;
  std::size_t used = 0, pieces = 0;

  [[nodiscard]] bool holds(const std::byte* data) const { return file.data() <= data && data < file.data() + file.size(); }
  [[nodiscard]] bool has_room_for(std::size_t bytes) const { return used + bytes <= file.size(); }
  std::byte* take(std::size_t bytes) {
    ++pieces;
    used += bytes;
    return file.data() + used - bytes;
  }
};

class Heap {
 public:
  /// Null where the piece is to lie in memory.
  std::byte* take(std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    if (bytes < least_piece) return nullptr;
    if (in_memory_ + bytes <= Pages::least_on_disk) {
      in_memory_ += bytes;
      return nullptr;
    }
    const std::size_t whole = rounded_up(bytes, alignof(std::max_align_t));
    if (segments_.empty() || !segments_.back().has_room_for(whole)) {
      Segment segment{PageFile(std::max({least_file, rounded_up(on_disk_ / 4, least_file), whole}))};
      if (segment.file.data() == nullptr) {
        in_memory_ += bytes;
        return nullptr;
      }
      on_disk_ += segment.file.size();
      segments_.push_back(std::move(segment));
    }
    return segments_.back().take(whole);
  }

  /// False: the piece lies in memory.
  bool give_back(const std::byte* data, std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    if (bytes < least_piece) return false;
    const auto segment = std::find_if(segments_.begin(), segments_.end(), [&](const Segment& s) { return s.holds(data); });
    if (segment == segments_.end()) {
      in_memory_ -= bytes;
      return false;
    }
    if (--segment->pieces == 0) {
      on_disk_ -= segment->file.size();
      segments_.erase(segment);
    }
    return true;
  }

  std::size_t on_disk() {
    const std::lock_guard lock(mutex_);
    return on_disk_;
  }

 private:
  std::mutex mutex_;
  std::list<Segment> segments_;
  std::size_t in_memory_ = 0, on_disk_ = 0;
};

Heap& heap() {
  static Heap the_heap;
  return the_heap;
}

}  // namespace

// Blocks of bytes are what malloc is for. NOLINTBEGIN(cppcoreguidelines-no-malloc)
void* PagedHeap::allocate(std::size_t bytes) {
  if (void* const on_disk = heap().take(bytes)) return on_disk;
  void* const in_memory = std::malloc(bytes);
  if (in_memory == nullptr) throw std::bad_alloc();
  return in_memory;
}

void PagedHeap::deallocate(void* data, std::size_t bytes) noexcept {
  if (!heap().give_back(static_cast<const std::byte*>(data), bytes)) std::free(data);
}
// NOLINTEND(cppcoreguidelines-no-malloc)

std::size_t PagedHeap::bytes_on_disk() { return heap().on_disk(); }

}  // namespace farlod
