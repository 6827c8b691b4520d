// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fstream>

#include "base/durable_file.hpp"
#include "farlod/error.hpp"
#include "package/far_terrain.hpp"
#include "package/file_stamp.hpp"

namespace farlod {
namespace {

void write_bytes_of(const std::filesystem::path& path, const FarTerrain& far_terrain) {
  package::FarTerrainHeader header{};
  header.magic = package::far_terrain_magic;
  header.version = package::far_terrain_version;
  header.vertex_count = static_cast<std::uint32_t>(far_terrain.vertices.size());
  header.triangle_count = static_cast<std::uint32_t>(far_terrain.triangles.size());
  header.file_bytes =
      sizeof(header) + far_terrain.vertices.size() * sizeof(Point3f) + far_terrain.triangles.size() * sizeof(Triangle);
  std::ofstream file(path, std::ios::binary);
  const auto put = [&file](const auto* first, std::size_t count) {
    file.write(reinterpret_cast<const char*>(first), static_cast<std::streamsize>(count * sizeof(*first)));
  };
  put(&header, 1);
  put(far_terrain.vertices.data(), far_terrain.vertices.size());
  put(far_terrain.triangles.data(), far_terrain.triangles.size());
  file.close();
  if (!file) throw OutputError(path.string() + " cannot be written. Is the disk full?");
}

}  // namespace

std::optional<package::FileStamp> write_far_terrain(const std::filesystem::path& folder, const FarTerrain& far_terrain) {
  if (far_terrain.empty()) return std::nullopt;
  make_folder(folder);
  package::FileStamp stamp;
  write_durably(folder / package::far_terrain_file, [&](const std::filesystem::path& part) {
    write_bytes_of(part, far_terrain);
    stamp = stamp_of(part);
  });
  return stamp;
}

}  // namespace farlod
