// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "package/far_terrain.hpp"
#include "package/file_stamp.hpp"

namespace farlod {

using package::FarTerrainHeader;

FarTerrainFile::FarTerrainFile(const PackageFolder& folder, const package::Manifest& manifest)
    : name_(folder.file(package::far_terrain_file).name), file_(folder.plain_file(package::far_terrain_file)) {
  check_stamp(folder.file(package::far_terrain_file), file_, *manifest.far_terrain);
  const std::span<const std::byte> bytes = file_.bytes();
  require(bytes.size() >= sizeof(FarTerrainHeader), "it has no header");
  const auto& header = *reinterpret_cast<const FarTerrainHeader*>(bytes.data());
  require(header.magic == package::far_terrain_magic, "it does not begin as far_terrain.bin does");
  require_readable_version(name_, header.version, package::far_terrain_version, package::far_terrain_version);
  require(header.file_bytes == bytes.size() &&
              sizeof(FarTerrainHeader) + header.vertex_count * sizeof(Point3f) + header.triangle_count * sizeof(Triangle) ==
                  bytes.size(),
          "its length is not that of its triangles");
  const std::byte* const vertices = bytes.data() + sizeof(FarTerrainHeader);
  mesh_.vertices = {reinterpret_cast<const Point3f*>(vertices), header.vertex_count};
  mesh_.triangles = {reinterpret_cast<const Triangle*>(vertices + mesh_.vertices.size_bytes()), header.triangle_count};
  require(std::ranges::all_of(mesh_.vertices, [](const Point3f& p) { return package::is_on_earth(p); }),
          "a vertex lies nowhere on Earth");
  const auto exists = [&](const Triangle& t) { return std::max({t.a, t.b, t.c}) < header.vertex_count; };
  require(std::ranges::all_of(mesh_.triangles, exists), "a triangle has a vertex that does not exist");
}

}  // namespace farlod
