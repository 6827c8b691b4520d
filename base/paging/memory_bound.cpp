// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "base/paging/memory_bound.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <shared_mutex>
#include <vector>

#include "base/paging/page_file.hpp"

namespace farlod {
namespace {

/// The least and the largest distance from the limit at which pages are let go: some threads read a gigabyte a second each, and
/// other programs may keep the watcher from looking for some milliseconds.
constexpr std::uint64_t least_margin = std::uint64_t{16} << 20, largest_margin = std::uint64_t{256} << 20;

struct Resident {
  std::uint64_t all = 0, files = 0;  ///< bytes; libraries and programs are files, too
  [[nodiscard]] std::uint64_t in_memory() const { return all - std::min(all, files); }
};

/// As the system counts it at the moment.
Resident resident() {
  static const int statm = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);  // of the process: until it ends
  static const auto page = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  std::array<char, 128> text{};
  const ssize_t count = pread(statm, text.data(), text.size(), 0);
  // Pages: of the address space, resident, and of these those of files
  std::array<std::uint64_t, 3> pages{};
  const char *at = text.data(), *const end = text.data() + std::max<ssize_t>(count, 0);
  for (std::uint64_t& number : pages) {
    at = std::find_if_not(at, end, [](char c) { return c == ' '; });
    at = std::from_chars(at, end, number).ptr;
  }
  return {pages[1] * page, pages[2] * page};
}

std::uint64_t margin_of(std::uint64_t limit) { return std::min(limit, std::clamp(limit / 8, least_margin, largest_margin)); }

/// Allocators keep what was freed. The program may have chosen that of oneTBB.
void give_back_freed_memory() {
  malloc_trim(0);
  constexpr int clean_all_buffers = 0;  // TBBMALLOC_CLEAN_ALL_BUFFERS
  using Command = int (*)(int, void*);
  static const auto command = reinterpret_cast<Command>(dlsym(RTLD_DEFAULT, "scalable_allocation_command"));
  if (command != nullptr) command(clean_all_buffers, nullptr);
}

/// Those of the process.
struct LivingBounds {
  std::shared_mutex mutex;
  std::vector<MemoryBound*> bounds;
  std::atomic<int> count = 0;
};
LivingBounds& living_bounds() {
  static LivingBounds living;
  return living;
}

}  // namespace

MemoryBound::MemoryBound(std::optional<std::uint64_t> limit_bytes, const std::stop_token& asked,
                         std::chrono::milliseconds between_looks)
    : limit_(limit_bytes),
      forward_(asked, Forward{stop_}),
      of_files_(most_of_files),
      fewest_files_(resident().files),
      watcher_([this, between_looks](const std::stop_token& ended) { watch(ended, between_looks); }) {
  expect(0);
  LivingBounds& living = living_bounds();
  const std::lock_guard lock(living.mutex);
  living.bounds.push_back(this);
  ++living.count;
  look();
}

MemoryBound::~MemoryBound() {
  LivingBounds& living = living_bounds();
  const std::lock_guard lock(living.mutex);
  std::erase(living.bounds, this);
  --living.count;
}

void MemoryBound::look_now() {
  LivingBounds& living = living_bounds();
  if (living.count == 0) return;
  const std::shared_lock lock(living.mutex);
  for (MemoryBound* bound : living.bounds) bound->look();
}

void MemoryBound::expect(std::uint64_t in_memory_bytes) {
  if (!limit_) return;
  // Before anything is known, a third is kept for the work
  const std::uint64_t margin = margin_of(*limit_), needed = std::max(in_memory_bytes, *limit_ / 3) + margin;
  of_files_ = std::max(*limit_ - std::min(*limit_, needed), least_of_files);
}

void MemoryBound::watch(const std::stop_token& ended, std::chrono::milliseconds between_looks) {
  std::mutex mutex;
  std::condition_variable_any woken;
  std::unique_lock lock(mutex);
  for (;;) {
    woken.wait_for(lock, ended, between_looks, [] { return false; });
    if (ended.stop_requested()) return;
    look();
  }
}

/// One look at a time is enough.
void MemoryBound::look() {
  const std::unique_lock alone(looking_, std::try_to_lock);
  if (alone.owns_lock()) look_alone();
}

void MemoryBound::look_alone() {
  const std::uint64_t limit = limit_.value_or(std::numeric_limits<std::uint64_t>::max());
  const Resident now = resident();
  most_needed_ = std::max(most_needed_.load(), now.in_memory() + std::min(now.files, fewest_files_));
  if (now.files <= std::max(of_files_.load(), near_files_) && now.all <= std::max(limit - margin_of(limit), near_limit_)) return;
  PageFile::let_go_of_all();
  const Resident left = resident();
  // Others may have read again by now what was let go
  fewest_files_ = has_let_go_ ? std::min(fewest_files_, left.files) : left.files;
  has_let_go_ = true;
  const std::uint64_t needed = left.in_memory() + fewest_files_;
  // What cannot be let go may lie above the thresholds: wait until half of what it leaves is used
  near_files_ = fewest_files_ + of_files_ / 2;
  near_limit_ = needed + (limit - std::min(limit, needed)) / 2;
  if (needed <= limit || is_exceeded()) return;
  give_back_freed_memory();
  const std::uint64_t still_needed = resident().in_memory() + fewest_files_;
  if (still_needed <= limit) return;
  exceeded_at_ = still_needed;
  stop_.request_stop();
}

}  // namespace farlod
