// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fstream>

#include "base/durable_file.hpp"
#include "farlod/error.hpp"
#include "package/file_stamp.hpp"
#include "package/relief.hpp"

namespace farlod {
namespace {

void write_bytes_of(const std::filesystem::path& path, const Relief& relief) {
  package::ReliefHeader header{};
  header.magic = package::relief_magic;
  header.version = package::relief_version;
  header.vertex_count = static_cast<std::uint32_t>(relief.vertices.size());
  header.triangle_count = static_cast<std::uint32_t>(relief.triangles.size());
  header.file_bytes = sizeof(header) + relief.vertices.size() * sizeof(Point3f) + relief.triangles.size() * sizeof(Triangle);
  std::ofstream file(path, std::ios::binary);
  const auto put = [&file](const auto* first, std::size_t count) {
    file.write(reinterpret_cast<const char*>(first), static_cast<std::streamsize>(count * sizeof(*first)));
  };
  put(&header, 1);
  put(relief.vertices.data(), relief.vertices.size());
  put(relief.triangles.data(), relief.triangles.size());
  file.close();
  if (!file) throw OutputError(path.string() + " cannot be written. Is the disk full?");
}

}  // namespace

std::optional<package::FileStamp> write_relief(const std::filesystem::path& folder, const Relief& relief) {
  if (relief.empty()) return std::nullopt;
  make_folder(folder);
  package::FileStamp stamp;
  write_durably(folder / package::relief_file, [&](const std::filesystem::path& part) {
    write_bytes_of(part, relief);
    stamp = stamp_of(part);
  });
  return stamp;
}

}  // namespace farlod
