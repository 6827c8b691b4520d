// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>

namespace farlod {

/// A temporary file without a name (in $TMPDIR, or else in /var/tmp or /tmp), mapped as memory, which ends with its object; or a
/// file that is there, mapped to be read. Of its pages, those in use take memory.
class PageFile {
 public:
  PageFile() = default;
  /// Reserves the room on the disk. Has no bytes where no file can be made or the disk has no room.
  explicit PageFile(std::size_t bytes);
  /// A file that is there: it is not written to, and stays. Throws InputError where it cannot be mapped. Has no bytes where the
  /// file is empty.
  [[nodiscard]] static PageFile to_read(const std::filesystem::path& path);
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
  [[nodiscard]] bool map(std::size_t bytes, int protection);

  std::byte* data_ = nullptr;
  std::size_t size_ = 0;
  int file_ = -1;  ///< the descriptor
};

}  // namespace farlod
