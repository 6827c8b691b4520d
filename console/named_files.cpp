// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "console/named_files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <system_error>

#include "farlod/error.hpp"

namespace farlod {
namespace {

namespace fs = std::filesystem;

/// Whether two names are of one file, which may not be there yet.
bool are_one(const fs::path& a, const fs::path& b) {
  std::error_code error;
  const fs::path one = fs::weakly_canonical(fs::absolute(a, error), error),
                 other = fs::weakly_canonical(fs::absolute(b, error), error);
  return one == other || fs::equivalent(a, b, error);
}

/// A folder that is no package is refused later, in other words.
bool lies_in_package(const fs::path& file, const fs::path& folder) {
  std::error_code error;
  if (!fs::is_regular_file(folder / "manifest.json", error)) return false;
  const fs::path inner = fs::weakly_canonical(fs::absolute(file, error), error), outer = fs::canonical(folder, error);
  if (error) return false;
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

/// Why no file can be made in a folder; 0 where it can. A file is made that has no name, and where the system knows none such,
/// one that loses it at once.
int error_of_making_in(const fs::path& folder) {
  constexpr mode_t owner_only = 0600;
  int file = open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, owner_only);
  if (file < 0 && (errno == EOPNOTSUPP || errno == EISDIR || errno == ENOENT)) {
    const fs::path probe = folder / (".farlod." + std::to_string(getpid()) + ".probe");
    file = open(probe.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, owner_only);
    if (file >= 0) unlink(probe.c_str());
  }
  if (file < 0) return errno;
  close(file);
  return 0;
}

void require_place(const NamedOutput& output) {
  std::error_code error;
  const fs::path folder = output.path.has_parent_path() ? output.path.parent_path() : fs::path(".");
  const fs::file_status status = fs::status(output.path, error);
  if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status)) return;
  if (fs::is_directory(status) && !output.may_be_folder)
    throw OutputError(output.path, "there is a folder of this name; choose another for " + output.option);
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw OutputError(output.path, folder.string() + " is a file, and no folder; choose another for " + output.option);
  if (!fs::is_directory(folder, error))
    throw OutputError(output.path, "there is no folder " + folder.string() + "; make it first, or choose another");
  if (fs::is_regular_file(status) && access(output.path.c_str(), W_OK) == 0) return;
  if (const int why = error_of_making_in(folder); why != 0)
    throw OutputError(output.path, "nothing can be written in " + folder.string() + " (" + std::generic_category().message(why) +
                                       "); choose another folder for " + output.option);
}

void require_no_input(const NamedOutput& output, const NamedInputs& inputs) {
  for (const NamedFile& input : inputs.files)
    if (!input.path.empty() && are_one(output.path, input.path))
      throw OutputError(output.path, "it is the file of " + input.option + "; choose another name for " + output.option);
  if (!inputs.package.empty() && lies_in_package(output.path, inputs.package))
    throw OutputError(output.path, "it lies in the package " + inputs.package.string() +
                                       ", which is to hold nothing else; choose " + "another folder for " + output.option);
}

}  // namespace

void require_writable(std::span<const NamedOutput> outputs, const NamedInputs& inputs) {
  for (std::size_t n = 0; n < outputs.size(); ++n) {
    const NamedOutput& output = outputs[n];
    if (output.path.empty()) continue;
    require_place(output);
    std::error_code error;
    const bool is_device = fs::is_other(output.path, error);
    if (is_device) continue;
    require_no_input(output, inputs);
    for (const NamedOutput& earlier : outputs.first(n))
      if (!earlier.path.empty() && are_one(output.path, earlier.path))
        throw OutputError(output.path, "both " + earlier.option + " and " + output.option + " name it; choose two names");
  }
}

}  // namespace farlod
