// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace farlod {

/// A temporary file without a name (in $TMPDIR, or else in /var/tmp or /tmp), mapped as memory. It ends with its object. Of its
/// pages, those in use take memory.
class PageFile {
 public:
  PageFile() = default;
  /// Reserves the room on the disk. Has no bytes where no file can be made or the disk has no room.
  explicit PageFile(std::size_t bytes);
  PageFile(PageFile&& other) noexcept { swap(other); }
  PageFile& operator=(PageFile&& other) noexcept {
    swap(other);
    return *this;
  }
  ~PageFile();

  [[nodiscard]] std::byte* data() const { return data_; }
  [[nodiscard]] std::size_t size() const { return size_; }
  /// Moves `data`. Returns false, and leaves all as it is, where the disk has no room.
  [[nodiscard]] bool grow(std::size_t bytes);
  /// Gives back the memory of the pages from `begin` to `end`: they are read again when somebody asks for them. May be called
  /// while others read or write.
  void let_go(std::size_t begin, std::size_t end) const;
  /// The same for all files of the process.
  static void let_go_of_all();

 private:
  void swap(PageFile& other) noexcept;

  std::byte* data_ = nullptr;
  std::size_t size_ = 0;
  int file_ = -1;  ///< the descriptor
};

}  // namespace farlod
