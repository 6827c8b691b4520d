// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cpl_vsi.h>

#include <algorithm>
#include <string>

#include "farlod/error.hpp"
#include "gdal/gdal_errors.hpp"
#include "ingest/files/zip_directory.hpp"
#include "ingest/files/zip_members.hpp"

namespace farlod::ingest {
namespace {

namespace fs = std::filesystem;

/// GDAL searches its list of members for each one. With more members, the searches take longer than the reading.
constexpr std::size_t most_members = 100'000;

struct CloseFolder {
  void operator()(VSIDIR* folder) const { VSICloseDir(folder); }
};

std::unique_ptr<VSIDIR, CloseFolder> open_archive(const fs::path& archive, const std::string& gdal_name) {
  std::unique_ptr<VSIDIR, CloseFolder> folder(VSIOpenDir(gdal_name.c_str(), -1, nullptr));
  if (folder) return folder;
  throw InputError(archive.string() + " is a zip archive that cannot be read: it is empty, damaged, or was cut short.");
}

void require_city_size(const fs::path& archive, std::size_t members, std::uintmax_t unpacked_bytes) {
  if (members > most_members)
    throw InputError(archive.string() + " holds more than " + std::to_string(most_members) +
                     " files: unpack it, and give the folder instead.");
  if (unpacked_bytes > most_unpacked_bytes(fs::file_size(archive)))
    throw InputError(archive.string() + " claims to unpack to " + std::to_string(unpacked_bytes >> 20) +
                     " MiB, more than a hundred times its size: that is no city. Unpack it yourself if you trust it.");
}

std::vector<InputFile> list(const fs::path& archive) {
  const std::string gdal_name = "/vsizip/{" + fs::absolute(archive).lexically_normal().string() + "}";
  const auto folder = open_archive(archive, gdal_name);
  std::vector<InputFile> files;
  std::uintmax_t unpacked_bytes = 0;
  while (const VSIDIREntry* entry = VSIGetNextDirEntry(folder.get())) {
    if (VSI_ISDIR(entry->nMode)) continue;
    // The limit keeps the sum from overflowing: a declared size may be any number
    unpacked_bytes += std::min<std::uintmax_t>(entry->nSize, std::uintmax_t{1} << 46);
    require_city_size(archive, files.size(), unpacked_bytes);
    files.emplace_back((archive / printable(entry->pszName)).string(), fs::path(gdal_name) / entry->pszName, archive);
    files.back().declared_bytes = entry->nSize;
  }
  return files;
}

}  // namespace

std::vector<InputFile> files_in_zip(const fs::path& archive) {
  const GdalErrors quiet;
  std::vector<InputFile> files = list(archive);
  std::sort(files.begin(), files.end(), [](const InputFile& a, const InputFile& b) { return a.name < b.name; });
  return files;
}

}  // namespace farlod::ingest
