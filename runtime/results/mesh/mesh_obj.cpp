// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/mesh/mesh_obj.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <ostream>

#include "results/atomic_file.hpp"

namespace farlod {
namespace {

/// The name of a group is one word.
std::string group_of(const MeshPart& part) {
  std::string name = part.building ? part.id : "ground";
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }, '_');
  return name.empty() ? "building_" + std::to_string(*part.building) : name;
}

}  // namespace

void write_obj(const std::vector<MeshPart>& parts, Point2d offset_m, const std::vector<std::string>& remarks,
               const std::filesystem::path& path) {
  write_atomically(path, [&](std::ostream& file) {
    for (const std::string& remark : remarks) file << "# " << remark << '\n';
    file << fmt::format("# Offset: add {:.0f} to x and {:.0f} to y; z is the height above sea level\n", offset_m.x, offset_m.y);
    std::size_t first = 1;  // OBJ counts from 1
    const MeshPart* last = nullptr;
    for (const MeshPart& part : parts) {
      if (last == nullptr || last->building != part.building) file << "g " << group_of(part) << '\n';
      last = &part;
      std::string text;
      for (const Point3d& p : part.vertices_projected)
        fmt::format_to(std::back_inserter(text), "v {:.4f} {:.4f} {:.4f}\n", p.x - offset_m.x, p.y - offset_m.y, p.z);
      for (const MeshTriangle& t : part.triangles)
        fmt::format_to(std::back_inserter(text), "f {} {} {}\n", first + t.vertices[0], first + t.vertices[1],
                       first + t.vertices[2]);
      first += part.vertices_projected.size();
      file << text;
    }
  });
}

}  // namespace farlod
