// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/scenes/packed_once.hpp"

#include <cstdlib>
#include <stdexcept>
#include <system_error>

#include "tests/scenes/temporary_folder.hpp"

namespace farlod::scenes {
namespace {

namespace fs = std::filesystem;

std::string folder_name(const PackedFrom& from) {
  const std::hash<std::string> hash;
  return from.name + '-' + std::to_string(hash(text_of(from.program))) + '-' + std::to_string(hash(from.text));
}

/// Those of other programs or texts. Whoever reads them has another build, which is not run beside this one.
void remove_older(const fs::path& folder, const std::string& name) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder.parent_path())) {
    const std::string other = entry.path().filename().string();
    const std::size_t program_hash = other.rfind('-', other.rfind('-') - 1);
    if (other.substr(0, program_hash) == name && entry.path() != folder) fs::remove_all(entry.path(), ignored);
  }
}

/// Goes with all its files, unless it was renamed.
struct Removed {
  fs::path folder;
  ~Removed() {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
};

}  // namespace

fs::path packed_once(const PackedFrom& from, const std::function<bool(const fs::path&)>& pack) {
  const fs::path packages = FARLOD_PACKAGES_DIR;
  fs::path folder = packages / folder_name(from);
  if (fs::exists(folder)) return folder;
  fs::create_directories(packages);
  std::string unfinished = (packages / ".XXXXXX").string();
  if (mkdtemp(unfinished.data()) == nullptr) throw std::runtime_error("no folder can be made in " + packages.string());
  const Removed at_the_end{unfinished};
  std::error_code another_was_faster;
  // A folder appears with all of its files; it is not empty, so that another one does not take its place
  if (pack(unfinished)) fs::rename(unfinished, folder, another_was_faster);
  if (!fs::exists(folder)) throw std::runtime_error(from.name + " could not be packed");
  remove_older(folder, from.name);
  return folder;
}

fs::path this_program() { return fs::read_symlink("/proc/self/exe"); }

}  // namespace farlod::scenes
