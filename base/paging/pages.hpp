// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>

#include "base/paging/page_file.hpp"

namespace farlod {

/// The least multiple of `unit` that is no smaller.
[[nodiscard]] constexpr std::size_t rounded_up(std::size_t bytes, std::size_t unit) { return (bytes + unit - 1) / unit * unit; }

/// Bytes that grow at their end. Many of them move to a file (PageFile), so that their pages can be let go. Where no such file
/// has room, they stay in memory. Growing moves `data`.
class Pages {
 public:
  /// Fewer bytes than these stay in memory.
  static constexpr std::size_t least_on_disk = std::size_t{16} << 20;

  Pages() = default;
  /// What a file holds. It may be read only.
  explicit Pages(PageFile file) : data_(file.data()), capacity_(file.size()), file_(std::move(file)) {}
  Pages(Pages&& other) noexcept { swap(other); }
  Pages& operator=(Pages&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Pages();

  [[nodiscard]] std::byte* data() { return data_; }
  [[nodiscard]] const std::byte* data() const { return data_; }
  [[nodiscard]] std::size_t capacity() const { return capacity_; }
  [[nodiscard]] bool are_on_disk() const { return file_.data() != nullptr; }
  /// Makes room for at least so many bytes, and for more than that, so that adding one by one is cheap. The first `used` bytes
  /// stay as they are, and those on disk are let go. Throws std::bad_alloc.
  void reserve(std::size_t bytes, std::size_t used);
  /// Gives back the memory of the pages from `begin` to `end`, if they are on disk: they are read again when somebody asks for
  /// them. May be called while others read.
  void let_go(std::size_t begin, std::size_t end) const { file_.let_go(begin, end); }

 private:
  void swap(Pages& other) noexcept;
  [[nodiscard]] bool reserve_on_disk(std::size_t bytes, std::size_t used);
  void reserve_in_memory(std::size_t bytes, std::size_t used);

  std::byte* data_ = nullptr;
  std::size_t capacity_ = 0;
  PageFile file_;         ///< where they lie on disk
  bool has_room_ = true;  ///< no file was refused yet
};

}  // namespace farlod
