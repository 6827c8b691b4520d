// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/visibility.hpp"

#include <gtest/gtest.h>

#include <random>

#include "horizon/sky_partition.hpp"

namespace farlod {
namespace {

/// Boxes without a floor on a plain, at random places.
class RandomTown {
 public:
  void add_box() {
    const auto first = static_cast<std::uint32_t>(vertices_.size());
    const float x = 40.0F * random(), y = 40.0F * random(), w = 2.0F + 2.0F * (random() + 1.0F),
                h = 2.0F + 8.0F * (random() + 1.0F);
    for (const float z : {0.0F, h})
      vertices_.insert(vertices_.end(), {{x, y, z}, {x + w, y, z}, {x + w, y + w, z}, {x, y + w, z}});
    for (std::uint32_t n = 0; n < 4; ++n) add_quad(first + n, first + (n + 1) % 4, first + 4 + (n + 1) % 4, first + 4 + n);
    add_quad(first + 4, first + 5, first + 6, first + 7);
  }
  [[nodiscard]] Occluder occluder() const { return {vertices_, triangles_}; }
  /// In [−1, 1), the same on every machine.
  float random() { return static_cast<float>(static_cast<double>(random_() >> 11) * 0x1p-52 - 1.0); }

 private:
  void add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    triangles_.push_back({a, b, c});
    triangles_.push_back({a, c, d});
  }
  std::vector<Point3f> vertices_;
  std::vector<Triangle> triangles_;
  std::mt19937_64 random_{20120901};
};

std::vector<Point3f> random_origins(std::size_t count) {
  RandomTown random;
  std::vector<Point3f> origins;
  for (std::size_t n = 0; n < count; ++n)
    origins.push_back({45.0F * random.random(), 45.0F * random.random(), 6.0F + 5.0F * random.random()});
  return origins;
}

TEST(Visibility, CountsAsOneRayAfterTheOtherDoes) {
  RandomTown town;
  for (int n = 0; n < 30; ++n) town.add_box();
  const Occluder occluder = town.occluder();
  // Around the size of a packet and of a batch, and no round numbers
  for (const std::size_t origin_count : {0U, 1U, 15U, 16U, 17U, 100U})
    for (const std::size_t ray_count : {1U, 7U, 256U, 970U}) {
      const std::vector<Point3f> origins = random_origins(origin_count);
      const std::vector<Point3d> directions = SkyPartition(SkyWeight::cosine, ray_count).directions();
      const std::vector<std::uint32_t> free = count_free(occluder, origins, directions);
      ASSERT_EQ(free.size(), origins.size());
      for (std::size_t n = 0; n < origins.size(); ++n) {
        std::uint32_t expected = 0;
        for (const Point3d& d : directions)
          expected += occluder.blocks({origins[n], {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)}})
                          ? 0U
                          : 1U;
        EXPECT_EQ(free[n], expected) << n << " of " << origin_count << ", " << ray_count << " rays";
      }
    }
}

TEST(Visibility, WithoutDirectionsNothingIsFree) {
  EXPECT_EQ(count_free(RandomTown().occluder(), random_origins(3), {}), (std::vector<std::uint32_t>{0, 0, 0}));
}

TEST(Visibility, AnotherBoxNeverOpensTheSky) {
  RandomTown town;
  const std::vector<Point3f> origins = random_origins(64);
  const std::vector<Point3d> directions = SkyPartition(SkyWeight::cosine, 290).directions();
  std::vector<std::uint32_t> before = count_free(town.occluder(), origins, directions);
  EXPECT_EQ(before, std::vector<std::uint32_t>(origins.size(), 290));
  for (int box = 0; box < 100; ++box) {
    town.add_box();
    const std::vector<std::uint32_t> after = count_free(town.occluder(), origins, directions);
    for (std::size_t n = 0; n < origins.size(); ++n) EXPECT_LE(after[n], before[n]) << "box " << box << ", receiver " << n;
    before = after;
  }
  EXPECT_LT(*std::min_element(before.begin(), before.end()), 200U) << "the town hides too little to tell";
}

}  // namespace
}  // namespace farlod
