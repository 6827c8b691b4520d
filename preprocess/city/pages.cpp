// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "city/pages.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>
#include <utility>
#include <vector>

namespace farlod {
namespace {

/// By how much a file grows at a time. All that is behind is let go then.
constexpr std::size_t step_on_disk = std::size_t{8} << 20;

std::size_t rounded_up(std::size_t bytes, std::size_t unit) { return (bytes + unit - 1) / unit * unit; }

/// /tmp comes last: on many systems it is memory.
std::vector<std::string> temporary_folders() {
  // Nobody changes the environment. NOLINTNEXTLINE(concurrency-mt-unsafe)
  const char* chosen = std::getenv("TMPDIR");
  if (chosen != nullptr && *chosen != '\0') return {chosen};
  return {"/var/tmp", "/tmp"};
}

/// A file without a name, which disappears with its last descriptor; -1 where none can be made.
int make_file() {
  for (const std::string& folder : temporary_folders()) {
    if (const int file = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600); file >= 0) return file;
    // Some file systems have no such files
    std::string name = folder + "/farlod-XXXXXX";
    if (const int file = mkostemp(name.data(), O_CLOEXEC); file >= 0) {
      unlink(name.c_str());
      return file;
    }
  }
  return -1;
}

}  // namespace

// Only realloc grows memory in its place, and it takes what malloc gave. NOLINTBEGIN(cppcoreguidelines-no-malloc)
Pages::~Pages() {
  if (file_ < 0) {
    std::free(data_);
    return;
  }
  munmap(data_, capacity_);
  close(file_);
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
  // What is not used of it takes no memory yet
  reserve_in_memory(std::max(bytes, 2 * capacity_), used);
}

bool Pages::reserve_on_disk(std::size_t bytes, std::size_t used) {
  const bool is_new = file_ < 0;
  const int file = is_new ? make_file() : file_;
  if (file < 0) return false;
  // Without a reservation, a full disk would end the program when a page is first written
  void* mapped = MAP_FAILED;
  if (posix_fallocate(file, 0, static_cast<off_t>(bytes)) == 0) {
    if (!is_new) let_go(0, capacity_);
    mapped = is_new ? mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0)
                    : mremap(data_, capacity_, bytes, MREMAP_MAYMOVE);
  }
  if (mapped == MAP_FAILED) {
    if (is_new) close(file);
    return false;
  }
  if (is_new) {
    if (used > 0) std::memcpy(mapped, data_, used);
    std::free(data_);
  }
  data_ = static_cast<std::byte*>(mapped);
  capacity_ = bytes;
  file_ = file;
  return true;
}

void Pages::reserve_in_memory(std::size_t bytes, std::size_t used) {
  // realloc moves large arrays without copying them
  auto* const moved = static_cast<std::byte*>(file_ < 0 ? std::realloc(data_, bytes) : std::malloc(bytes));
  if (moved == nullptr) throw std::bad_alloc();
  if (file_ >= 0) {
    std::memcpy(moved, data_, used);
    munmap(data_, capacity_);
    close(std::exchange(file_, -1));
  }
  data_ = moved;
  capacity_ = bytes;
}
// NOLINTEND(cppcoreguidelines-no-malloc)

void Pages::let_go(std::size_t begin, std::size_t end) const {
  if (file_ < 0) return;
  static const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const std::size_t first = begin / page * page, last = std::min(rounded_up(end, page), capacity_);
  // The pages are shared with the file, so that nothing that was written is lost
  if (first < last) madvise(data_ + first, last - first, MADV_DONTNEED);
}

}  // namespace farlod
