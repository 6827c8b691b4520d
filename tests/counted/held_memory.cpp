// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/counted/held_memory.hpp"

#include <malloc.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> held_bytes{0}, most_held_bytes{0};

void count(void* memory) {
  if (memory == nullptr) return;
  const std::size_t size = malloc_usable_size(memory), held = held_bytes += size;
  for (std::size_t most = most_held_bytes; most < held && !most_held_bytes.compare_exchange_weak(most, held);) {
  }
}

}  // namespace

// What stands in for malloc and `new` cannot use them. NOLINTBEGIN(cppcoreguidelines-no-malloc)
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)

namespace {

void release(void* memory) noexcept {
  held_bytes -= malloc_usable_size(memory);
  std::free(memory);
}

}  // namespace

// The other forms without alignment call these
void* operator new(std::size_t bytes) {
  void* memory = std::malloc(bytes);
  if (memory == nullptr) throw std::bad_alloc();
  count(memory);
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
void operator delete(void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { release(memory); }

#else

// The functions behind those of glibc
extern "C" {
void* behind_malloc(std::size_t bytes) asm("__libc_malloc");
void* behind_calloc(std::size_t count, std::size_t bytes) asm("__libc_calloc");
void* behind_realloc(void* memory, std::size_t bytes) asm("__libc_realloc");
void* behind_memalign(std::size_t alignment, std::size_t bytes) asm("__libc_memalign");
void behind_free(void* memory) asm("__libc_free");

// All that hand out what free() takes
void* counted_malloc(std::size_t bytes) noexcept asm("malloc");
void* counted_calloc(std::size_t items, std::size_t bytes) noexcept asm("calloc");
void* counted_realloc(void* before, std::size_t bytes) noexcept asm("realloc");
void* counted_memalign(std::size_t alignment, std::size_t bytes) noexcept asm("memalign");
void* counted_aligned_alloc(std::size_t alignment, std::size_t bytes) noexcept asm("aligned_alloc");
int counted_posix_memalign(void** memory, std::size_t alignment, std::size_t bytes) noexcept asm("posix_memalign");
void counted_free(void* memory) noexcept asm("free");
}

void* counted_malloc(std::size_t bytes) noexcept {
  void* memory = behind_malloc(bytes);
  count(memory);
  return memory;
}
void* counted_calloc(std::size_t items, std::size_t bytes) noexcept {
  void* memory = behind_calloc(items, bytes);
  count(memory);
  return memory;
}
void* counted_realloc(void* before, std::size_t bytes) noexcept {
  const std::size_t size = before == nullptr ? 0 : malloc_usable_size(before);
  void* memory = behind_realloc(before, bytes);
  if (memory != nullptr || bytes == 0) held_bytes -= size;
  count(memory);
  return memory;
}
void* counted_memalign(std::size_t alignment, std::size_t bytes) noexcept {
  void* memory = behind_memalign(alignment, bytes);
  count(memory);
  return memory;
}
void* counted_aligned_alloc(std::size_t alignment, std::size_t bytes) noexcept { return counted_memalign(alignment, bytes); }
int counted_posix_memalign(void** memory, std::size_t alignment, std::size_t bytes) noexcept {
  *memory = counted_memalign(alignment, bytes);
  return *memory == nullptr ? ENOMEM : 0;
}
void counted_free(void* memory) noexcept {
  if (memory != nullptr) held_bytes -= malloc_usable_size(memory);
  behind_free(memory);
}

#endif
// NOLINTEND(cppcoreguidelines-no-malloc)

namespace farlod {

HeldMemory::HeldMemory() : before_(held_bytes) { most_held_bytes = before_; }

std::size_t HeldMemory::most_bytes() const { return most_held_bytes - before_; }

std::size_t HeldMemory::now_bytes() { return held_bytes; }

}  // namespace farlod
