// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "base/paging/page_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <map>
#include <mutex>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "farlod/error.hpp"

namespace farlod {
namespace {

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

/// All mapped files of the process. A file is mapped, moved and unmapped only while the list is locked.
struct MappedFiles {
  std::mutex mutex;
  std::map<std::byte*, std::size_t> sizes;
};
MappedFiles& mapped_files() {
  static MappedFiles files;
  return files;
}

/// Without a reservation, a full disk would end the program when a page is first written.
bool has_room(int file, std::size_t bytes) { return posix_fallocate(file, 0, static_cast<off_t>(bytes)) == 0; }

/// The pages are shared with the file, so that nothing that was written is lost.
void let_go_of(std::byte* data, std::size_t bytes) { madvise(data, bytes, MADV_DONTNEED); }

}  // namespace

PageFile::PageFile(std::size_t bytes) : file_(make_file()) {
  if (file_ >= 0 && has_room(file_, bytes)) (void)map(bytes, PROT_READ | PROT_WRITE);
}

PageFile PageFile::to_read(const std::filesystem::path& path) {
  PageFile file;
  file.file_ = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file.file_ < 0) throw InputError(path.string() + " cannot be read: " + std::generic_category().message(errno));
  const std::size_t bytes = std::filesystem::file_size(path);
  if (bytes > 0 && !file.map(bytes, PROT_READ)) throw InputError(path.string() + " cannot be mapped as memory");
  return file;
}

bool PageFile::map(std::size_t bytes, int protection) {
  MappedFiles& files = mapped_files();
  const std::lock_guard lock(files.mutex);
  void* const mapped = mmap(nullptr, bytes, protection, MAP_SHARED, file_, 0);
  if (mapped == MAP_FAILED) return false;
  data_ = static_cast<std::byte*>(mapped);
  size_ = bytes;
  files.sizes.emplace(data_, size_);
  return true;
}

PageFile::~PageFile() {
  if (data_ != nullptr) {
    MappedFiles& files = mapped_files();
    const std::lock_guard lock(files.mutex);
    files.sizes.erase(data_);
    munmap(data_, size_);
  }
  if (file_ >= 0) close(file_);
}

void PageFile::swap(PageFile& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(size_, other.size_);
  std::swap(file_, other.file_);
}

bool PageFile::grow(std::size_t bytes) {
  if (data_ == nullptr || !has_room(file_, bytes)) return false;
  MappedFiles& files = mapped_files();
  const std::lock_guard lock(files.mutex);
  void* const mapped = mremap(data_, size_, bytes, MREMAP_MAYMOVE);
  if (mapped == MAP_FAILED) return false;
  files.sizes.erase(data_);
  data_ = static_cast<std::byte*>(mapped);
  size_ = bytes;
  files.sizes.emplace(data_, size_);
  return true;
}

void PageFile::let_go(std::size_t begin, std::size_t end) const {
  static const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const std::size_t first = begin / page * page, last = std::min((end + page - 1) / page * page, size_);
  if (first < last) let_go_of(data_ + first, last - first);
}

void PageFile::let_go_of_all() {
  MappedFiles& files = mapped_files();
  const std::lock_guard lock(files.mutex);
  for (const auto& [data, size] : files.sizes) let_go_of(data, size);
}

}  // namespace farlod
