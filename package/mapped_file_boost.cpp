// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <sys/mman.h>

#include <boost/interprocess/file_mapping.hpp>
#include <boost/interprocess/mapped_region.hpp>

#include <filesystem>
#include <new>

#include "package/package_folder.hpp"

namespace farlod {

struct MappedFile::Impl {
  boost::interprocess::mapped_region region;
};

MappedFile::MappedFile(const PackageFile& file) : impl_(std::make_unique<Impl>()) {
  namespace ipc = boost::interprocess;
  try {
    // An empty file cannot be mapped; it has no bytes, and the reader will say what is missing
    if (std::filesystem::file_size(file.path) == 0) return;
    impl_->region = ipc::mapped_region(ipc::file_mapping(file.path.c_str(), ipc::read_only), ipc::read_only);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& reason) {
    throw PackageDamaged(file.name + " is missing or cannot be read. Copy the package again, or pack the city again. (" +
                         reason.what() + ")");
  }
}

MappedFile::MappedFile(MappedFile&&) noexcept = default;
MappedFile& MappedFile::operator=(MappedFile&&) noexcept = default;
MappedFile::~MappedFile() = default;

std::span<const std::byte> MappedFile::bytes() const {
  return {static_cast<const std::byte*>(impl_->region.get_address()), impl_->region.get_size()};
}

void MappedFile::let_go() const {
  if (impl_->region.get_size() == 0) return;
  // Not Boost's advise(): it asks through POSIX, and there the system is free to do nothing, as glibc does. What a file's shared
  // pages hold is not lost by this.
  madvise(impl_->region.get_address(), impl_->region.get_size(), MADV_DONTNEED);
}

}  // namespace farlod
