// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "base/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "farlod/error.hpp"

namespace farlod {
namespace {

/// False where another one holds it.
bool is_locked_now(int file, LockKind kind) {
  const int operation = (kind == LockKind::shared ? LOCK_SH : LOCK_EX) | LOCK_NB;
  while (flock(file, operation) != 0) {
    if (errno == EINTR) continue;
    // Anything else: the file system has no locks, so that nobody holds one
    return errno != EWOULDBLOCK;
  }
  return true;
}

/// Who holds a lock may remove the file, and another one may make it anew before we get our lock.
bool is_still_there(int file, const std::filesystem::path& path) {
  struct stat ours {
  }, there{};
  return fstat(file, &ours) == 0 && stat(path.c_str(), &there) == 0 && ours.st_dev == there.st_dev && ours.st_ino == there.st_ino;
}

std::string machine() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "an unknown machine";
}

}  // namespace

std::optional<FileLock> FileLock::try_lock(const std::filesystem::path& path, LockKind kind) {
  constexpr mode_t for_all_by_umask = 0666;
  while (true) {
    const int file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, for_all_by_umask);
    if (file < 0) throw OutputError(path, std::generic_category().message(errno));
    FileLock lock(file);
    if (!is_locked_now(file, kind)) return std::nullopt;
    if (is_still_there(file, path)) return lock;
  }
}

std::optional<FileLock> FileLock::try_lock_existing(const std::filesystem::path& path, LockKind kind) {
  // Network file systems want to write where a lock excludes; a package on a read-only disk is read all the same
  int file = kind == LockKind::exclusive ? open(path.c_str(), O_RDWR | O_CLOEXEC) : -1;
  if (file < 0) file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return std::nullopt;
  FileLock lock(file);
  if (!is_locked_now(file, kind)) return std::nullopt;
  return lock;
}

FileLock::FileLock(FileLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
  std::swap(file_, other.file_);
  return *this;
}

FileLock::~FileLock() {
  if (file_ >= 0) close(file_);
}

void FileLock::sign(std::string_view purpose) const {
  const std::string text = std::string(purpose) + ", process " + std::to_string(getpid()) + " on " + machine();
  // Only people read it: what cannot be written harms nobody
  if (ftruncate(file_, 0) != 0) return;
  [[maybe_unused]] const ssize_t written = pwrite(file_, text.data(), text.size(), 0);
}

std::string holder_of(const std::filesystem::path& lock_file) {
  std::ifstream file(lock_file);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace farlod
