// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace farlod {

enum class LockKind { shared, exclusive };

/// A lock on a file, which other processes ask for too (flock). It ends with the object or with the process, however that ends,
/// so that no lock outlives a kill. Two locks of one process exclude each other as those of two processes do. On a file system
/// that knows no locks, everybody gets one.
class FileLock {
 public:
  /// Makes the file where there is none. Nothing where a lock that somebody holds excludes this one. Throws OutputError where the
  /// file cannot be made.
  [[nodiscard]] static std::optional<FileLock> try_lock(const std::filesystem::path& path, LockKind kind);
  /// On a file that is there and is not written to, which may be of somebody else. Nothing where there is none.
  [[nodiscard]] static std::optional<FileLock> try_lock_existing(const std::filesystem::path& path, LockKind kind);
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  ~FileLock();

  /// Writes into the file who holds the lock: process, machine and `purpose`. Only of what try_lock() gave, exclusively.
  void sign(std::string_view purpose) const;

 private:
  explicit FileLock(int file) : file_(file) {}
  int file_ = -1;  ///< the descriptor
};

/// What the last one who signed the file wrote; empty where nobody did.
[[nodiscard]] std::string holder_of(const std::filesystem::path& lock_file);

}  // namespace farlod
