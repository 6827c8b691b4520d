// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farlod/package.hpp"

#include "farlod/error.hpp"
#include "package/manifest.hpp"
#include "run/memory_limit.hpp"
#include "run/package_contents.hpp"

namespace farlod {

PackageContents::PackageContents(const std::filesystem::path& place)
    : folder(place), reader(place), description(package::described(reader.manifest())) {}

Package::Package(const std::filesystem::path& folder) : contents_(std::make_shared<PackageContents>(folder)) {}
Package::Package(Package&&) noexcept = default;
Package& Package::operator=(Package&&) noexcept = default;
Package::~Package() = default;

void Package::close() noexcept { contents_.reset(); }

const std::shared_ptr<PackageContents>& Package::contents() const {
  if (!contents_) throw InvalidArgument("the package is closed: open it again");
  return contents_;
}

const PackageDescription& Package::description() const { return contents()->description; }

PackageInUse::PackageInUse(const Package& package) : contents_(package.contents()) {
  contents_->reader.require_unchanged();
  const std::lock_guard lock(contents_->runs_mutex);
  ++contents_->runs;
  share_memory();
}

PackageInUse::~PackageInUse() {
  const std::lock_guard lock(contents_->runs_mutex);
  if (--contents_->runs > 0) share_memory();
}

void PackageInUse::share_memory() const {
  contents_->reader.hold_at_most(contents_->runs * bytes_of_blocks_at_work(contents_->reader.manifest()));
}

}  // namespace farlod
