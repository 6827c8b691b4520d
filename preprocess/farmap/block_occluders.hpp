// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "farlod/horizon/horizon_edge.hpp"
#include "farlod/package/layout.hpp"
#include "farmap/city_horizon.hpp"

namespace farlod {

/// Gathers what the cells of a block name, each thing once, and numbers it anew.
class BlockOccluders {
 public:
  /// `corner` is the block's, in the frame of the city, which must outlive this.
  BlockOccluders(const CityHorizon& city, Point2d corner) : city_(city), corner_(corner) {}

  /// From numbers in the city to rows of `edges`.
  void renumber(std::vector<package::ExplicitOccluder>& named);
  std::vector<HorizonEdge> edges;

 private:
  [[nodiscard]] std::uint32_t row_of(std::uint32_t number);
  [[nodiscard]] Point3f placed(const Point3d& p) const;

  const CityHorizon& city_;
  Point2d corner_;
  std::unordered_map<std::uint32_t, std::uint32_t> rows_;
};

}  // namespace farlod
