// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <list>
#include <unordered_map>
#include <vector>

namespace farlod {

/// Which of many things to keep when not all of them fit: those that were used last. It counts; keeping and letting go are the
/// caller's.
///   (1) together, what is kept weighs no more than the limit, unless it is a single thing
///   (2) what was used last is kept
class LruCache {
 public:
  /// There is no limit before this is called; what is too much goes with the next use.
  void keep_at_most(std::uint64_t bytes) { most_bytes_ = bytes; }
  /// Something is used, and kept from now on. Returns what has to go for it, the longest unused first.
  [[nodiscard]] std::vector<std::size_t> use(std::size_t thing, std::uint64_t bytes);

  [[nodiscard]] std::size_t count() const { return order_.size(); }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  struct Kept {
    std::size_t thing;
    std::uint64_t bytes;
  };
  std::uint64_t most_bytes_ = std::numeric_limits<std::uint64_t>::max(), bytes_ = 0;
  std::list<Kept> order_;  ///< the last used first
  std::unordered_map<std::size_t, std::list<Kept>::iterator> places_;
};

}  // namespace farlod
