// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <new>

namespace farlod {

/// Memory that does not move, for structures of pointers that a city has millions of nodes of. All of it together, the first
/// Pages::least_on_disk lie in memory, and the rest in files (PageFile), where there is room. Any number of threads at once.
struct PagedHeap {
  /// Aligned for any fundamental type. Throws std::bad_alloc.
  [[nodiscard]] static void* allocate(std::size_t bytes);
  static void deallocate(void* data, std::size_t bytes) noexcept;
  /// What lies in files at present.
  [[nodiscard]] static std::size_t bytes_on_disk();
};

/// PagedHeap for the containers of other libraries. Meant for blocks of many elements: small ones stay in memory.
template <class T>
struct PagedAllocator {
  using value_type = T;  // which need not be complete yet

  PagedAllocator() = default;
  template <class U>
  PagedAllocator(const PagedAllocator<U>&) noexcept {}  // NOLINT(google-explicit-constructor): what the standard asks for

  [[nodiscard]] T* allocate(std::size_t count) {
    static_assert(alignof(T) <= alignof(std::max_align_t));
    if (count > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_alloc();
    return static_cast<T*>(PagedHeap::allocate(count * sizeof(T)));
  }
  void deallocate(T* data, std::size_t count) noexcept { PagedHeap::deallocate(data, count * sizeof(T)); }
  friend bool operator==(const PagedAllocator&, const PagedAllocator&) { return true; }
};

}  // namespace farlod
