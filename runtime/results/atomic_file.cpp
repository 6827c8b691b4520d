// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/atomic_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

#include "farlod/error.hpp"

namespace farlod {

AtomicFile::AtomicFile(std::filesystem::path destination, std::string_view ending) : destination_(std::move(destination)) {
  // The process number keeps two runs that write the same file apart
  std::string name(1, '.');
  name.append(destination_.filename().string()).append(1, '.').append(std::to_string(getpid())).append(".partial").append(ending);
  temporary_ = destination_.parent_path() / name;
}

AtomicFile::~AtomicFile() {
  std::error_code nothing_to_remove;
  std::filesystem::remove(temporary_, nothing_to_remove);
}

void AtomicFile::commit() {
  std::error_code error;
  std::filesystem::rename(temporary_, destination_, error);
  if (error) throw OutputError(destination_, error.message());
}

AtomicFolder::~AtomicFolder() {
  std::error_code nothing_to_remove;
  std::filesystem::remove_all(temporary(), nothing_to_remove);
}

void AtomicFolder::commit(const std::string& mark) {
  const std::filesystem::path& destination = name_.destination();
  const AtomicFile older(destination, ".older");
  std::error_code nothing_there, error;
  if (std::filesystem::exists(destination / mark, nothing_there)) std::filesystem::rename(destination, older.temporary(), error);
  if (error) throw OutputError(destination, error.message());
  name_.commit();
  std::filesystem::remove_all(older.temporary(), nothing_there);
}

void write_atomically(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write) {
  AtomicFile file(path);
  errno = 0;
  std::ofstream stream(file.temporary(), std::ios::binary);
  if (stream) write(stream);
  stream.close();
  // The stream does not say why it failed; the system's last error does
  if (!stream) throw OutputError(path, errno != 0 ? std::generic_category().message(errno) : "the disk refused the data");
  file.commit();
}

}  // namespace farlod
