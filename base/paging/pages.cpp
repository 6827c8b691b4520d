// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "base/paging/pages.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>

namespace farlod {
namespace {

/// By how much a file grows at a time. All that is behind is let go then.
constexpr std::size_t step_on_disk = std::size_t{8} << 20;

}  // namespace

// Only realloc grows memory in its place, and it takes what malloc gave. NOLINTBEGIN(cppcoreguidelines-no-malloc)
Pages::~Pages() {
  if (!are_on_disk()) std::free(data_);
}

void Pages::swap(Pages& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(capacity_, other.capacity_);
  std::swap(file_, other.file_);
  std::swap(has_room_, other.has_room_);
}

void Pages::reserve(std::size_t bytes, std::size_t used) {
  if (bytes <= capacity_) return;
  if (bytes >= least_on_disk && has_room_) {
    has_room_ = reserve_on_disk(rounded_up(bytes, step_on_disk), used);
    if (has_room_) return;
  }
  // What is not used of it takes no memory yet. What may go to disk soon is not given more room than it may have here
  const std::size_t most = has_room_ ? least_on_disk : 2 * capacity_;
  reserve_in_memory(std::max(bytes, std::min(2 * capacity_, most)), used);
}

bool Pages::reserve_on_disk(std::size_t bytes, std::size_t used) {
  if (are_on_disk()) {
    file_.let_go(0, capacity_);
    if (!file_.grow(bytes)) return false;
  } else {
    PageFile file(bytes);
    if (file.data() == nullptr) return false;
    if (used > 0) std::memcpy(file.data(), data_, used);
    std::free(data_);
    file_ = std::move(file);
  }
  data_ = file_.data();
  capacity_ = bytes;
  return true;
}

void Pages::reserve_in_memory(std::size_t bytes, std::size_t used) {
  // realloc moves large arrays without copying them
  auto* const moved = static_cast<std::byte*>(are_on_disk() ? std::malloc(bytes) : std::realloc(data_, bytes));
  if (moved == nullptr) throw std::bad_alloc();
  if (are_on_disk()) {
    std::memcpy(moved, data_, used);
    file_ = PageFile();  // leaves the old file to the temporary
  }
  data_ = moved;
  capacity_ = bytes;
}
// NOLINTEND(cppcoreguidelines-no-malloc)

}  // namespace farlod
