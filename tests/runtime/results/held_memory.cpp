// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/runtime/results/held_memory.hpp"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> held_bytes{0}, most_held_bytes{0};

// What stands in for `new` and `delete` cannot use them. NOLINTBEGIN(cppcoreguidelines-no-malloc)
void release(void* memory) noexcept {
  held_bytes -= malloc_usable_size(memory);
  std::free(memory);
}

}  // namespace

// The other forms without alignment call these
void* operator new(std::size_t bytes) {
  void* memory = std::malloc(bytes);
  if (memory == nullptr) throw std::bad_alloc();
  const std::size_t size = malloc_usable_size(memory), held = held_bytes += size;
  for (std::size_t most = most_held_bytes; most < held && !most_held_bytes.compare_exchange_weak(most, held);) {
  }
  return memory;
}
// AddressSanitizer has its own of this one, which does not call ours
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  try {
    return operator new(bytes);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
// NOLINTEND(cppcoreguidelines-no-malloc)
void operator delete(void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { release(memory); }

namespace farlod {

HeldMemory::HeldMemory() : before_(held_bytes) { most_held_bytes = before_; }

std::size_t HeldMemory::most_bytes() const { return most_held_bytes - before_; }

}  // namespace farlod
