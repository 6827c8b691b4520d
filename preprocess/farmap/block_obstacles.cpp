// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "farmap/block_obstacles.hpp"

namespace farlod {

void BlockObstacles::renumber(std::vector<package::NamedObstacle>& named) {
  for (package::NamedObstacle& n : named) n.row = row_of(n.row);
}

std::uint32_t BlockObstacles::row_of(std::uint32_t number) {
  const Obstacle& o = city_.obstacles()[number];
  const auto [entry, is_new] = rows_.try_emplace(number, static_cast<std::uint32_t>(edges.size()));
  if (is_new) edges.push_back({placed(o.a), placed(o.b), o.rises, o.role});
  return entry->second;
}

Point3f BlockObstacles::placed(const Point3d& p) const {
  return {static_cast<float>(p.x - corner_.x), static_cast<float>(p.y - corner_.y), static_cast<float>(p.z)};
}

}  // namespace farlod
