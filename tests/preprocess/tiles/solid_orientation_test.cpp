// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tiles/solid_orientation.hpp"

#include <gtest/gtest.h>

namespace farlod::tiles {
namespace {

/// The six sides of a box, looking out (+1) or in (−1).
std::vector<OrientedArea> box(double side, const Point3d& middle, double direction, std::uint16_t part) {
  std::vector<OrientedArea> sides;
  for (const Point3d& n : {Point3d{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}})
    sides.push_back({direction * side * side * n, middle + 0.5 * side * n, part});
  return sides;
}

TEST(OutwardSigns, AFileThatDrawsInwardsIsTurned) {
  EXPECT_EQ(outward_signs(box(10, {500, 600, 5}, 1.0, 0)), std::vector<double>(6, 1.0));
  EXPECT_EQ(outward_signs(box(10, {500, 600, 5}, -1.0, 0)), std::vector<double>(6, -1.0));
}

TEST(OutwardSigns, AMissingFacetChangesNothing) {
  for (std::size_t missing = 0; missing < 6; ++missing) {
    auto sides = box(10, {500, 600, 5}, -1.0, 0);
    sides.erase(sides.begin() + static_cast<std::ptrdiff_t>(missing));
    EXPECT_EQ(outward_signs(sides), std::vector<double>(5, -1.0)) << missing;
  }
}

TEST(OutwardSigns, EachPartDecidesForItself) {
  auto sides = box(10, {0, 0, 5}, 1.0, 0);
  const auto annex = box(4, {7, 0, 2}, -1.0, 1);
  sides.insert(sides.end(), annex.begin(), annex.end());
  const auto signs = outward_signs(sides);
  for (std::size_t n = 0; n < 12; ++n) EXPECT_EQ(signs[n], n < 6 ? 1.0 : -1.0);
}

}  // namespace
}  // namespace farlod::tiles
