// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string_view>

namespace farlod {

/// A file that appears under its name only when it is complete: it is written under a temporary name in the same folder and
/// renamed by commit(). Without commit() it is removed.
class AtomicFile {
 public:
  /// The temporary name ends with `ending`, for libraries that look at it.
  explicit AtomicFile(std::filesystem::path destination, std::string_view ending = "");
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  [[nodiscard]] const std::filesystem::path& destination() const { return destination_; }
  /// The path to write to. No file exists there yet.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }
  /// Renames the file, replacing an older one of this name. Throws OutputError.
  void commit();

 private:
  std::filesystem::path destination_, temporary_;
};

/// Writes a complete file, text or binary, or none: `write` fills the stream. Throws OutputError.
void write_atomically(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);

}  // namespace farlod
