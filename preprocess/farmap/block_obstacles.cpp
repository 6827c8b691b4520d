// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "farmap/block_obstacles.hpp"

namespace farlod {

void BlockObstacles::renumber(std::vector<package::NamedObstacle>& named) {
  for (package::NamedObstacle& n : named) n.row = row_of(n.row);
}

std::uint32_t BlockObstacles::row_of(std::uint32_t number) {
  const Obstacle& o = city_.obstacles()[number];
  const auto next = static_cast<std::uint32_t>(o.is_edge ? edges.size() : triangles.size());
  const auto [entry, is_new] = rows_.try_emplace(number, next);
  if (is_new && o.is_edge) edges.push_back({placed(o.corners[0]), placed(o.corners[1]), o.rises});
  if (is_new && !o.is_edge) triangles.push_back({placed(o.corners[0]), placed(o.corners[1]), placed(o.corners[2])});
  return entry->second;
}

Point3f BlockObstacles::placed(const Point3d& p) const {
  return {static_cast<float>(p.x - corner_.x), static_cast<float>(p.y - corner_.y), static_cast<float>(p.z)};
}

}  // namespace farlod
