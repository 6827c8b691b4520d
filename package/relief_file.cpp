// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "package/file_stamp.hpp"
#include "package/relief.hpp"

namespace farlod {

using package::ReliefHeader;

ReliefFile::ReliefFile(const PackageFolder& folder, const package::Manifest& manifest)
    : name_(folder.file(package::relief_file).name), file_(folder.plain_file(package::relief_file)) {
  check_stamp(folder.file(package::relief_file), file_, *manifest.relief);
  const std::span<const std::byte> bytes = file_.bytes();
  require(bytes.size() >= sizeof(ReliefHeader), "it has no header");
  const auto& header = *reinterpret_cast<const ReliefHeader*>(bytes.data());
  require(header.magic == package::relief_magic, "it does not begin as relief.bin does");
  require_readable_version(name_, header.version, package::relief_version, package::relief_version);
  require(
      header.file_bytes == bytes.size() &&
          sizeof(ReliefHeader) + header.vertex_count * sizeof(Point3f) + header.triangle_count * sizeof(Triangle) == bytes.size(),
      "its length is not that of its triangles");
  const std::byte* const vertices = bytes.data() + sizeof(ReliefHeader);
  mesh_.vertices = {reinterpret_cast<const Point3f*>(vertices), header.vertex_count};
  mesh_.triangles = {reinterpret_cast<const Triangle*>(vertices + mesh_.vertices.size_bytes()), header.triangle_count};
  require(std::ranges::all_of(mesh_.vertices, [](const Point3f& p) { return package::is_on_earth(p); }),
          "a vertex lies nowhere on Earth");
  const auto exists = [&](const Triangle& t) { return std::max({t.a, t.b, t.c}) < header.vertex_count; };
  require(std::ranges::all_of(mesh_.triangles, exists), "a triangle has a vertex that does not exist");
}

}  // namespace farlod
