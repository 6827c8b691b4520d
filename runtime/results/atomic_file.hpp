// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
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

/// The same for a folder, which is removed with all that is in it.
class AtomicFolder {
 public:
  explicit AtomicFolder(const std::filesystem::path& destination) : name_(destination, ".folder") {}
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& destination() const { return name_.destination(); }
  /// The folder to write to. It does not exist yet.
  [[nodiscard]] const std::filesystem::path& temporary() const { return name_.temporary(); }
  /// Renames the folder. One of this name is replaced if it holds `mark`, a file that says what it is; else it is left alone.
  /// Throws OutputError.
  void commit(const std::string& mark);

 private:
  AtomicFile name_;
};

/// Writes a complete file, text or binary, or none: `write` fills the stream. Throws OutputError.
void write_atomically(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);

}  // namespace farlod
