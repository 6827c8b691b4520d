// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "farlod/box.hpp"
#include "farlod/point.hpp"
#include "package/manifest.hpp"

namespace farlod {
namespace {

TEST(Package, MapsShowFiftyMetresAroundACityAndLessAroundASmallOne) {
  const auto margin_of = [](double side_m) {
    const Box2d box{{1000.0, 2000.0}, {1000.0 + side_m, 2000.0 + 3.0 * side_m}}, map = package::with_margin(box);
    const Point2d low = box.low - map.low, high = map.high - box.high;
    EXPECT_NEAR(low.x, high.x, 1e-9);
    EXPECT_NEAR(low.y, high.y, 1e-9);
    return high;
  };
  EXPECT_NEAR(norm(margin_of(10.0) - Point2d{5.0, 5.0}), 0.0, 1e-9);
  EXPECT_NEAR(norm(margin_of(240.0) - Point2d{8.0, 24.0}), 0.0, 1e-9);
  EXPECT_NEAR(norm(margin_of(900.0) - Point2d{30.0, 50.0}), 0.0, 1e-9);
  EXPECT_NEAR(norm(margin_of(5000.0) - Point2d{50.0, 50.0}), 0.0, 1e-9);
}

}  // namespace
}  // namespace farlod
