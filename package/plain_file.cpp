// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/plain_file.hpp"

#include <iterator>
#include <string>
#include <system_error>

#include "farlod/error.hpp"

namespace farlod {
namespace fs = std::filesystem;

void require_plain_file(const fs::path& folder, const fs::path& name, const fs::path& shown) {
  fs::path path = folder, shown_path = shown;
  for (auto part = name.begin(); part != name.end(); ++part) {
    path /= *part;
    shown_path /= *part;
    std::error_code unread;
    const fs::file_type type = fs::symlink_status(path, unread).type();
    if (type == fs::file_type::symlink)
      throw PackageDamaged(shown_path.string() +
                           " is a link, and may lead out of the package: put what it leads to in its place.");
    if (type == fs::file_type::none || type == fs::file_type::not_found) return;
    const bool is_last = std::next(part) == name.end();
    if (type != (is_last ? fs::file_type::regular : fs::file_type::directory))
      throw PackageDamaged(shown_path.string() + (is_last ? " is not a file" : " is not a folder") +
                           ". Copy the package again, or pack the city again.");
  }
}

}  // namespace farlod
