// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <istream>
#include <memory>
#include <string>

namespace farlod::ingest {

/// Whether a path leads to a pipe: one with a name, or the standard input when another program writes to it.
[[nodiscard]] bool is_pipe(const std::filesystem::path& path);

/// A city that another program writes while it is read. A pipe gives its bytes once; its beginning is kept, so that the format
/// can be recognized first.
class InputPipe {
 public:
  explicit InputPipe(const std::filesystem::path& path) : name_(path.string()), rest_(path, std::ios::binary) {}

  /// The first bytes, at most so many. Before `take_all`.
  [[nodiscard]] const std::string& beginning(std::size_t most_bytes);
  /// All bytes. Throws InputError when it is called a second time.
  [[nodiscard]] std::unique_ptr<std::istream> take_all();

 private:
  std::string name_, beginning_;
  std::ifstream rest_;
  bool is_taken_ = false;
};

}  // namespace farlod::ingest
