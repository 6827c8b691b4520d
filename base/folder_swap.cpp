// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "base/folder_swap.hpp"

#include <fcntl.h>
#include <cstdio>

#include <cerrno>
#include <system_error>

#include "base/durable_file.hpp"
#include "farlod/error.hpp"

namespace farlod {
namespace {

namespace fs = std::filesystem;

bool swap_in_one_step(const fs::path& here, const fs::path& there) {
  return renameat2(AT_FDCWD, here.c_str(), AT_FDCWD, there.c_str(), RENAME_EXCHANGE) == 0;
}

[[noreturn]] void refuse(const fs::path& path, const std::error_code& reason) {
  throw OutputError(path.string() + " cannot be put in its place: " + reason.message());
}

/// The error, if there is one.
std::error_code moved(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  return error;
}

}  // namespace

void swap_folders(const fs::path& here, const fs::path& there, const fs::path& aside) {
  if (!swap_in_one_step(here, there)) {
    const int reason = errno;
    // File systems without the step say so in several ways
    if (reason != EINVAL && reason != ENOSYS && reason != EOPNOTSUPP) refuse(there, {reason, std::generic_category()});
    if (const auto error = moved(there, aside)) refuse(there, error);
    if (const auto error = moved(here, there)) {
      (void)moved(aside, there);
      refuse(there, error);
    }
    if (const auto error = moved(aside, here)) refuse(here, error);
  }
  settle_names_in(there.parent_path());
}

void move_folder(const fs::path& from, const fs::path& to) {
  if (const auto error = moved(from, to)) refuse(to, error);
  settle_names_in(to.parent_path());
}

}  // namespace farlod
