// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "farlod/export.hpp"

namespace farlod {

/// What decides the answers of a run: names of settings and their values, texts of whoever makes the file.
using AnswerKey = std::vector<std::pair<std::string, std::string>>;

/// A file in which a run keeps the answers of each cell as soon as it has them, so that another run of the same package,
/// receivers and settings takes them from there (RunSettings::answers): one that goes on after the first was interrupted, or one
/// that puts together what several have computed, each its shard (RunSettings::shard). Whatever ends a process, what it kept is
/// whole: a cell whose checksum is wrong counts as not computed. A file is for the processor architecture and the version that
/// wrote it.
class FARLOD_EXPORT AnswerFile {
 public:
  /// What becomes of a file that is there and has another key, or cannot be read.
  enum class OfAnotherKey { refuse, replace };

  /// Opens the file to read and to add to it, or makes it. Throws Busy while another process has it, OutputError which names the
  /// setting that differs and both values, or what the disk refuses.
  [[nodiscard]] static AnswerFile open(const std::filesystem::path& path, const AnswerKey& key, OfAnotherKey of_another);
  /// Opens files of the same key to read them together; nothing is added. Throws OutputError where one is not there or differs.
  [[nodiscard]] static AnswerFile together(const std::vector<std::filesystem::path>& paths, const AnswerKey& key);
  AnswerFile(AnswerFile&&) noexcept;
  AnswerFile& operator=(AnswerFile&&) noexcept;
  ~AnswerFile();

  /// Cells whose answers it has.
  [[nodiscard]] std::size_t cells() const;
  /// True if it replaced a file of another key; `difference` is what differed then.
  [[nodiscard]] const std::string& replaced() const;

  // For the runs of the library; from any thread.

  /// The bytes of a cell; nothing where it has none.
  [[nodiscard]] std::optional<std::vector<std::byte>> find(std::uint64_t cell) const;
  /// Adds a cell. Throws OutputError.
  void keep(std::uint64_t cell, const std::vector<std::byte>& bytes) const;
  [[nodiscard]] bool is_read_only() const;

 private:
  struct Contents;
  explicit AnswerFile(std::unique_ptr<Contents> contents);
  std::unique_ptr<Contents> contents_;
};

}  // namespace farlod
