// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "farmap/block_occluders.hpp"

namespace farlod {

void BlockOccluders::renumber(std::vector<package::ExplicitOccluder>& named) {
  for (package::ExplicitOccluder& n : named) n.row = row_of(n.row);
}

std::uint32_t BlockOccluders::row_of(std::uint32_t number) {
  const OccluderEdge& o = city_.occluders()[number];
  const auto [entry, is_new] = rows_.try_emplace(number, static_cast<std::uint32_t>(edges.size()));
  if (is_new) edges.push_back({placed(o.a), placed(o.b), o.adjacent, o.role});
  return entry->second;
}

Point3f BlockOccluders::placed(const Point3d& p) const {
  return {static_cast<float>(p.x - corner_.x), static_cast<float>(p.y - corner_.y), static_cast<float>(p.z)};
}

}  // namespace farlod
