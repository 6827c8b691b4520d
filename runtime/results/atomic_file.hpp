// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>

namespace farlod {

/// A file that appears under its name only when it is whole: it is written under a temporary name in the same folder, and
/// renamed by commit(). What is not committed is removed.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path destination);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  [[nodiscard]] const std::filesystem::path& destination() const { return destination_; }
  /// Where to write. Nothing is there yet.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }
  /// Gives the file its name, replacing what had it. Throws OutputError.
  void commit();

 private:
  std::filesystem::path destination_, temporary_;
};

/// Writes a text file as a whole or not at all: `write` fills the stream. Throws OutputError.
void write_text_atomically(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);

}  // namespace farlod
