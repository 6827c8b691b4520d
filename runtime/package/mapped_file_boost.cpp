// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <boost/interprocess/file_mapping.hpp>
#include <boost/interprocess/mapped_region.hpp>

#include "package/mapped_file.hpp"
#include "package/package_error.hpp"

namespace farlod {

struct MappedFile::Impl {
  boost::interprocess::mapped_region region;
};

MappedFile::MappedFile(const std::filesystem::path& path) : impl_(std::make_unique<Impl>()) {
  namespace ipc = boost::interprocess;
  try {
    // An empty file cannot be mapped; it has no bytes, and the reader will say what is missing
    if (std::filesystem::file_size(path) == 0) return;
    impl_->region = ipc::mapped_region(ipc::file_mapping(path.c_str(), ipc::read_only), ipc::read_only);
  } catch (const std::exception& reason) {
    throw PackageDamaged(path.string() + " is missing or cannot be read. Copy the package again, or pack the city again. (" +
                         reason.what() + ")");
  }
}

MappedFile::MappedFile(MappedFile&&) noexcept = default;
MappedFile& MappedFile::operator=(MappedFile&&) noexcept = default;
MappedFile::~MappedFile() = default;

std::span<const std::byte> MappedFile::bytes() const {
  return {static_cast<const std::byte*>(impl_->region.get_address()), impl_->region.get_size()};
}

}  // namespace farlod
