// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/canopy_by_place.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/runtime/horizon/random_places.hpp"

namespace farlod {
namespace {

constexpr std::size_t lanes = ReceiverPacket::lanes;
constexpr double half_m = 60.0;  ///< of the raster's edge

/// A raster of 1 m of 100 trees a hectare, each a paraboloid, with the bottoms at a quarter of the tops.
std::vector<Crown> canopy() {
  RandomPlaces random;
  struct Tree {
    Point3f place;
    float radius_m;
  };
  std::vector<Tree> trees(static_cast<std::size_t>(4.0 * half_m * half_m * 0.01));
  for (Tree& tree : trees) tree = {random.place(half_m, 6.0, 18.0), random.between(2.0, 5.0)};
  std::vector<Crown> pixels;
  for (double x = 0.5 - half_m; x < half_m; x += 1.0)
    for (double y = 0.5 - half_m; y < half_m; y += 1.0) {
      double top_m = 0.0;
      for (const Tree& tree : trees) {
        const double away = std::hypot(x - static_cast<double>(tree.place.x), y - static_cast<double>(tree.place.y)) /
                            static_cast<double>(tree.radius_m);
        if (away < 1.0) top_m = std::max(top_m, static_cast<double>(tree.place.z) * (1.0 - 0.5 * away * away));
      }
      if (top_m > 0.0)
        pixels.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(0.25 * top_m),
                          static_cast<float>(top_m), 0.5F, CrownShape::prism, Foliage::unknown, 0});
    }
  return pixels;
}

ReceiverPacket receivers_around(Point2d middle, float step_m) {
  ReceiverPacket packet;
  for (std::size_t l = 0; l < lanes; ++l)
    packet.add({l,
                {static_cast<float>(middle.x) + step_m * static_cast<float>(l % 4),
                 static_cast<float>(middle.y) + step_m * static_cast<float>(l / 4), 1.5F}});
  return packet;
}

TEST(CanopyByPlace, ErrsLittleAgainstAllPixels) {
  // Twice of what was measured here; docs/concepts.md, "Canopies of rasters", has the errors of a real canopy
  constexpr double max_allowed = 0.0045, mean_allowed = 0.0012;
  const std::vector<Crown> pixels = canopy();
  const AzimuthSampling azimuths = AzimuthSampling::even(320, {});
  for (const CanopyRule rule : {CanopyRule::once, CanopyRule::beer}) {
    const CanopySettings settings{rule};
    const CrownBatches all(pixels, settings);
    CanopySky exact(azimuths);
    CanopyByPlace merged(pixels, settings, azimuths);
    double sum = 0.0, max = 0.0, hidden = 0.0, count = 0.0;
    for (double x = -40.0; x < 40.0; x += 17.0)
      for (double y = -40.0; y < 40.0; y += 17.0) {
        const ReceiverPacket receivers = receivers_around({x, y}, 2.0F);
        const SkyProfile open(azimuths);
        const CanopyShares expected = exact.evaluate(open, receivers, all), got = merged.evaluate(open, receivers, {});
        for (std::size_t l = 0; l < lanes; ++l) {
          const double error = std::abs(static_cast<double>(got.lost[l]) - static_cast<double>(expected.lost[l]));
          sum += error, count += 1.0, max = std::max(max, error);
          hidden += static_cast<double>(expected.lost[l]);
        }
      }
    RecordProperty("max", std::to_string(max));
    RecordProperty("mean", std::to_string(sum / count));
    EXPECT_LE(max, max_allowed);
    EXPECT_LE(sum / count, mean_allowed);
    EXPECT_GT(hidden / count, 0.2) << "the canopy hides too little to tell";
  }
}

TEST(CanopyByPlace, DoesNotDependOnTheRestOfThePacket) {
  const std::vector<Crown> pixels = canopy();
  const AzimuthSampling azimuths = AzimuthSampling::even(64, {});
  CanopyByPlace sky(pixels, {}, azimuths);
  // Over several places
  const ReceiverPacket receivers = receivers_around({-11.0, 3.0}, 7.0F);
  SkyProfile::Rows behind(azimuths.size()), behind_alone(azimuths.size());
  const SkyProfile open(azimuths);
  const CanopyShares together = sky.evaluate(open, receivers, behind);
  for (std::size_t l = 0; l < lanes; ++l) {
    ReceiverPacket alone;
    alone.add({0, {receivers.x[l], receivers.y[l], receivers.z[l]}});
    const CanopyShares of_one = sky.evaluate(open, alone, behind_alone);
    EXPECT_EQ(together.lost[l], of_one.lost[0]);
    EXPECT_EQ(together.behind[l], of_one.behind[0]);
    for (std::size_t k = 0; k < azimuths.size(); ++k) EXPECT_EQ(behind[k][l], behind_alone[k][0]);
  }
}

}  // namespace
}  // namespace farlod
