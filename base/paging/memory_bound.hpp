// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

namespace farlod {

/// While it lives, keeps the memory of the process down. Every few milliseconds, and whenever look_now() is called, it looks at
/// it, and lets go of what lies on disk (PageFile) when that takes more than its share, or when all comes near the limit. What is
/// in use comes back at once, so that the work goes on, if slower. Memory that does not lie on disk is not moved there: when that
/// alone exceeds the limit, a stop is requested.
class MemoryBound {
 public:
  /// What pages of files may take without a limit, and what they must have so that the work goes on at a good pace.
  static constexpr std::uint64_t most_of_files = std::uint64_t{512} << 20, least_of_files = std::uint64_t{48} << 20;

  /// `asked`: the token by which the caller may stop. `between_looks`: so often it looks by itself.
  explicit MemoryBound(std::optional<std::uint64_t> limit_bytes, const std::stop_token& asked = {},
                       std::chrono::milliseconds between_looks = std::chrono::milliseconds(2));
  MemoryBound(const MemoryBound&) = delete;
  MemoryBound& operator=(const MemoryBound&) = delete;
  ~MemoryBound();

  /// Makes all that live look. Each access to a file brings back as much as 64 KiB, so loops that read here and there fill more
  /// memory in some milliseconds than a limit leaves: they call this every hundred accesses or so. Costs some microseconds, and
  /// nothing without a bound. Any number of threads at once.
  static void look_now();

  /// Leaves to pages of files what is left of the limit by work that needs `in_memory_bytes` besides them.
  void expect(std::uint64_t in_memory_bytes);
  /// The most that was seen in use, without what lies on disk.
  [[nodiscard]] std::uint64_t most_needed() const { return most_needed_; }
  /// Stops when the caller asks, or when the limit is exceeded.
  [[nodiscard]] std::stop_token stop() const { return stop_.get_token(); }
  [[nodiscard]] bool is_exceeded() const { return exceeded_at_ > 0; }
  /// The bytes that were in use when the limit was exceeded, without what lies on disk.
  [[nodiscard]] std::uint64_t exceeded_at() const { return exceeded_at_; }

 private:
  void watch(const std::stop_token& ended, std::chrono::milliseconds between_looks);
  void look();
  void look_alone();

  std::mutex looking_;
  std::optional<std::uint64_t> limit_;
  std::stop_source stop_;
  struct Forward {
    std::stop_source& to;
    void operator()() const { to.request_stop(); }
  };
  std::stop_callback<Forward> forward_;
  std::atomic<std::uint64_t> exceeded_at_ = 0, most_needed_ = 0;
  std::atomic<std::uint64_t> of_files_;
  std::uint64_t near_limit_ = 0, near_files_ = 0;  ///< pages are let go no sooner than at these
  /// Programs and libraries: until pages are let go, those that were there at the beginning.
  std::uint64_t fewest_files_;
  bool has_let_go_ = false;
  std::jthread watcher_;  ///< last: it uses all the others
};

}  // namespace farlod
