// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/spool_file.hpp"

#include <cerrno>
#include <system_error>

#include "farlod/error.hpp"

namespace farlod {
namespace {

/// The stream does not say why it failed; the system's last error does.
std::string reason() { return errno != 0 ? std::generic_category().message(errno) : "the disk refused the data"; }

}  // namespace

SpoolFile::SpoolFile(const std::filesystem::path& result) : result_(result), file_(result.string() + ".spool") {
  errno = 0;
  stream_.open(file_.temporary(), std::ios::binary | std::ios::in | std::ios::out | std::ios::trunc);
  if (!stream_) throw OutputError(result_, reason());
}

std::uint64_t SpoolFile::append(std::span<const std::byte> bytes) {
  errno = 0;
  stream_.seekp(static_cast<std::streamoff>(end_));
  stream_.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!stream_) throw OutputError(result_, reason());
  end_ += bytes.size();
  return end_ - bytes.size();
}

void SpoolFile::read(std::uint64_t place, std::span<std::byte> bytes) {
  errno = 0;
  stream_.seekg(static_cast<std::streamoff>(place));
  stream_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!stream_) throw OutputError(result_, reason());
}

}  // namespace farlod
