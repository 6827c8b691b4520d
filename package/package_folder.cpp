// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/package_folder.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <optional>

#include "base/file_lock.hpp"
#include "package/no_package.hpp"

namespace farlod {
namespace fs = std::filesystem;
namespace {

/// Throws PackageDamaged where a name within the folder of a package is anything but a file, or a folder on the way to it is
/// anything but a folder: a link, which may lead out of the package; a pipe or a device, which a reader could wait for without an
/// end. The folder itself may be a link; `shown` is what messages call it. A file that is missing is for its reader to tell.
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

}  // namespace

namespace fs = std::filesystem;
namespace {

/// A folder whose making was interrupted has the name of the package, and this.
constexpr const char* unfinished_ending = ".unfinished";

void require_folder(const fs::path& name) {
  std::error_code error;
  const fs::file_status status = fs::status(name, error);
  if (fs::is_directory(status)) return;
  if (!fs::status_known(status))
    throw PackageUnusable(name.string() + " cannot be looked at: " + error.message() + ". Check its name, and who may read it.");
  const fs::path unfinished = (name.has_filename() ? name : name.parent_path()).string() + unfinished_ending;
  if (fs::is_directory(unfinished, error))
    throw PackageUnusable(name.string() +
                          " is not finished: farlod-pack is making it, or was interrupted; the same command goes "
                          "on with " +
                          unfinished.string() + ".");
  throw no_package(name);
}

/// A descriptor of a folder. Paths below /proc/self/fd lead to what it was opened on, whatever has its name.
class OpenFolder {
 public:
  explicit OpenFolder(const fs::path& name) : file_(open(name.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC)), path_(name) {
    const fs::path by_descriptor = "/proc/self/fd/" + std::to_string(file_);
    std::error_code unread;
    if (file_ >= 0 && fs::is_directory(by_descriptor, unread)) path_ = by_descriptor;
  }
  OpenFolder(const OpenFolder&) = delete;
  OpenFolder& operator=(const OpenFolder&) = delete;
  ~OpenFolder() {
    if (file_ >= 0) close(file_);
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  int file_;
  fs::path path_;
};

}  // namespace

struct PackageFolder::Impl {
  fs::path name;
  std::unique_ptr<OpenFolder> folder;
  std::optional<FileLock> lock;  ///< shared with other readers

  explicit Impl(const fs::path& n) : name(n) {
    // A package that is being replaced gives its name away between the two steps, and is removed then
    constexpr int most_tries = 20;
    for (int n_try = 0; n_try < most_tries && !lock; ++n_try) {
      require_folder(name);
      folder = std::make_unique<OpenFolder>(name);
      const fs::path manifest = folder->path() / package::manifest_file;
      std::error_code unread;
      // What else is wrong with it, its reader tells
      if (fs::symlink_status(manifest, unread).type() != fs::file_type::regular) return;
      lock = FileLock::try_lock_existing(manifest, LockKind::shared);
    }
  }
};

PackageFolder::PackageFolder(const fs::path& name) : impl_(std::make_unique<Impl>(name)) {}
PackageFolder::PackageFolder(PackageFolder&&) noexcept = default;
PackageFolder& PackageFolder::operator=(PackageFolder&&) noexcept = default;
PackageFolder::~PackageFolder() = default;

const fs::path& PackageFolder::name() const { return impl_->name; }

PackageFile PackageFolder::file(const fs::path& within) const {
  return {impl_->folder->path() / within, (impl_->name / within).string()};
}

PackageFile PackageFolder::plain_file(const fs::path& within) const {
  require_plain_file(impl_->folder->path(), within, impl_->name);
  return file(within);
}

}  // namespace farlod
