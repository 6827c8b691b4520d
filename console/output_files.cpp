// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "console/output_files.hpp"

#include <fstream>

#include "farlod/error.hpp"

namespace farlod {

void require_folder_of(const std::filesystem::path& file) {
  const auto folder = file.parent_path();
  if (folder.empty() || std::filesystem::is_directory(folder)) return;
  throw OutputError(file, "there is no folder " + folder.string() + "; make it first, or choose another");
}

void write_text(const std::string& path, const std::string& text) {
  if (path.empty()) return;
  std::ofstream file(path);
  file << text;
  file.close();
  if (!file) throw OutputError(path, "is there such a folder, and room on the disk?");
}

}  // namespace farlod
