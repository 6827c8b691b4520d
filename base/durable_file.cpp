// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "base/durable_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "farlod/error.hpp"

namespace farlod {
namespace {

constexpr std::string_view unfinished_ending = ".part";

/// A descriptor.
class OpenFile {
 public:
  OpenFile(const std::filesystem::path& path, int flags) : file_(open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() {
    if (file_ >= 0) close(file_);
  }
  [[nodiscard]] int descriptor() const { return file_; }

 private:
  int file_;
};

[[noreturn]] void refuse(const std::filesystem::path& path, int error) {
  const std::string reason = std::generic_category().message(error);
  throw OutputError(path.string() + " cannot be written: " + reason + (error == ENOSPC ? ". Is the disk full?" : ""));
}

void write_all(const std::filesystem::path& temporary, std::span<const std::byte> bytes, const std::filesystem::path& path) {
  const OpenFile file(temporary, O_WRONLY | O_CREAT | O_TRUNC);
  if (file.descriptor() < 0) refuse(path, errno);
  while (!bytes.empty()) {
    const ssize_t written = write(file.descriptor(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) refuse(path, errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

/// File systems that write what is told later fail here, and not before.
void settle_bytes_of(const std::filesystem::path& temporary, const std::filesystem::path& path) {
  const OpenFile file(temporary, O_RDONLY);
  if (file.descriptor() < 0) refuse(path, errno);
  if (fdatasync(file.descriptor()) != 0 && errno != EINVAL && errno != EROFS) refuse(path, errno);
}

}  // namespace

void write_durably(const std::filesystem::path& path, const std::function<void(const std::filesystem::path&)>& write) {
  const std::filesystem::path temporary = path.string().append(unfinished_ending);
  try {
    write(temporary);
    settle_bytes_of(temporary, path);
    std::filesystem::rename(temporary, path);
  } catch (const std::filesystem::filesystem_error& reason) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    refuse(path, reason.code().value());
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw;
  }
}

void write_durably(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  write_durably(path, [&](const std::filesystem::path& temporary) { write_all(temporary, bytes, path); });
}

void write_durably(const std::filesystem::path& path, std::string_view text) {
  write_durably(path, std::as_bytes(std::span(text)));
}

bool is_unfinished_file(const std::filesystem::path& path) { return path.extension() == unfinished_ending; }

void settle_names_in(const std::filesystem::path& folder) {
  const OpenFile file(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY);
  if (file.descriptor() >= 0) fsync(file.descriptor());
}

}  // namespace farlod
