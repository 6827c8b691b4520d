// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/triangle_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "farlod/point.hpp"

namespace farlod {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

/// Small and large triangles of a city of 400 m, and places among them.
class CityOfTriangles : public testing::Test {
 protected:
  double between(double low, double high) { return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53; }
  Point3d place(double reach) { return {between(-reach, reach), between(-reach, reach), between(-0.1 * reach, 0.1 * reach)}; }
  std::vector<TriangleIndex::Corners> triangles(std::size_t count) {
    std::vector<TriangleIndex::Corners> all;
    for (std::size_t n = 0; n < count; ++n) {
      const Point3d middle = place(200.0);
      const double size = n % 10 == 0 ? 60.0 : 3.0;
      all.push_back({middle + place(size), middle + place(size), middle + place(size)});
    }
    return all;
  }
  TriangleIndex::Sector sector() {
    const double azimuth = between(0.0, 6.28), tilt = between(0.0, 3.14), aside = between(0.0, 6.28);
    const Point3d eye = place(150.0);
    return {{eye.x, eye.y, eye.z},
            {std::cos(azimuth), std::sin(azimuth)},
            between(0.01, 2.0),
            {std::sin(tilt) * std::cos(aside), std::sin(tilt) * std::sin(aside), std::cos(tilt)}};
  }

 private:
  std::mt19937_64 random_{20120901};
};

TriangleIndex::Corners relative(const TriangleIndex::Corners& triangle, const Point3d& eye) {
  return {triangle[0] - eye, triangle[1] - eye, triangle[2] - eye};
}

/// Promise (1), triangle by triangle.
bool is_asked_for(const TriangleIndex::Corners& triangle, const TriangleIndex::Sector& sector, double slope) {
  const Point3d along{sector.from.x, sector.from.y, 0.0}, left{-sector.from.y, sector.from.x, 0.0};
  const auto has_corner = [&](const auto& is_inside) { return std::any_of(triangle.begin(), triangle.end(), is_inside); };
  return has_corner([&](const Point3d& p) { return dot(left, p) >= 0.0; }) &&
         has_corner([&](const Point3d& p) { return dot(sector.tangent * along - left, p) >= 0.0; }) &&
         has_corner([&](const Point3d& p) { return dot(along, p) >= 0.0; }) && has_corner([&](const Point3d& p) {
           return dot(Point3d{-slope * along.x, -slope * along.y, 1.0}, p) > 0.0;
         }) &&
         has_corner([&](const Point3d& p) { return dot(sector.normal, p) > 0.0; });
}

/// Whether something of it rises above the slope, in front of the eye: at a corner there, or where it comes there.
bool rises_in_front(const TriangleIndex::Corners& triangle, const TriangleIndex::Sector& sector, double slope) {
  const auto along = [&](const Point3d& p) { return p.x * sector.from.x + p.y * sector.from.y; };
  for (std::size_t n = 0; n < 3; ++n) {
    const Point3d &p = triangle[n], &q = triangle[(n + 1) % 3];
    if (along(p) >= 0.0 && p.z > slope * along(p)) return true;
    if (along(p) * along(q) < 0.0 && (p + (along(p) / (along(p) - along(q))) * (q - p)).z > 0.0) return true;
  }
  return false;
}

bool comes_before(const TriangleIndex::Corners& a, const TriangleIndex::Corners& b) {
  for (std::size_t n = 0; n < 3; ++n) {
    if (a[n].x != b[n].x) return a[n].x < b[n].x;
    if (a[n].y != b[n].y) return a[n].y < b[n].y;
    if (a[n].z != b[n].z) return a[n].z < b[n].z;
  }
  return false;
}

TEST_F(CityOfTriangles, IsAskedAsOneByOne) {
  std::size_t told = 0, untold = 0;
  for (const std::size_t count : {0U, 1U, 16U, 17U, 1000U, 20000U}) {
    const std::vector<TriangleIndex::Corners> all = triangles(count);
    const TriangleIndex index(all);
    for (int n = 0; n < 60; ++n) {
      const TriangleIndex::Sector asked = sector();
      const double slope = n % 3 == 0 ? 0.0 : between(0.0, 0.5);
      std::vector<TriangleIndex::Corners> found, expected;
      index.find(asked, slope, [&](std::span<const TriangleIndex::Corners> some) {
        found.insert(found.end(), some.begin(), some.end());
        return slope;
      });
      for (const TriangleIndex::Corners& t : all)
        if (const TriangleIndex::Corners seen = relative(t, asked.eye); is_asked_for(seen, asked, slope))
          expected.push_back(seen);
      std::sort(found.begin(), found.end(), comes_before);
      std::sort(expected.begin(), expected.end(), comes_before);
      EXPECT_EQ(found, expected) << count << " triangles";
      told += expected.size();
      untold += all.size() - expected.size();
    }
  }
  EXPECT_GT(told, 10000U);
  EXPECT_GT(untold, 10000U);
}

TEST_F(CityOfTriangles, OnceTheSlopeIsRaisedNothingIsMissedAboveIt) {
  const std::vector<TriangleIndex::Corners> all = triangles(5000);
  const TriangleIndex index(all);
  std::size_t above = 0, left_out = 0;
  for (int n = 0; n < 60; ++n) {
    const TriangleIndex::Sector asked = sector();
    double slope = 0.0;
    std::vector<TriangleIndex::Corners> found;
    index.find(asked, slope, [&](std::span<const TriangleIndex::Corners> some) {
      found.insert(found.end(), some.begin(), some.end());
      return slope += 0.01;
    });
    std::size_t without_slope = 0;
    for (const TriangleIndex::Corners& t : all) {
      const TriangleIndex::Corners seen = relative(t, asked.eye);
      without_slope += is_asked_for(seen, asked, 0.0) ? 1 : 0;
      if (!is_asked_for(seen, asked, 0.0) || !rises_in_front(seen, asked, slope)) continue;
      ++above;
      EXPECT_EQ(std::count(found.begin(), found.end(), seen), 1);
    }
    left_out += without_slope - found.size();
  }
  EXPECT_GT(above, 500U);
  EXPECT_GT(left_out, 500U);
}

TEST_F(CityOfTriangles, NothingIsToldWhereAllIsHidden) {
  const TriangleIndex index(triangles(1000));
  std::size_t calls = 0;
  const auto count_call = [&](std::span<const TriangleIndex::Corners>) {
    ++calls;
    return endless;
  };
  const TriangleIndex::Sector ahead{{0.0, 0.0, -50.0}, {1.0, 0.0}, 1.0, {0.0, 0.0, 1.0}};
  index.find(ahead, endless, count_call);
  EXPECT_EQ(calls, 0U);
  index.find(ahead, 0.0, count_call);
  EXPECT_EQ(calls, 1U);
}

TEST(TriangleIndex, NearTrianglesComeFirst) {
  // Fences in rows, one behind the other
  std::vector<TriangleIndex::Corners> fences;
  for (int n = 1000; n > 0; --n) {
    const auto x = static_cast<float>(n);
    fences.push_back({Point3d{x, -500.0, 0.0}, Point3d{x, 500.0, 0.0}, Point3d{x, 0.0, 9.0}});
  }
  double reached = 0.0;
  TriangleIndex(fences).find({{0.0, 0.0, 1.0}, {1.0, 0.0}, 0.1, {0.0, 0.0, 1.0}}, 0.0,
                             [&](std::span<const TriangleIndex::Corners> some) {
                               for (const TriangleIndex::Corners& t : some) EXPECT_GE(t[0].x + 16.0, reached);
                               for (const TriangleIndex::Corners& t : some) reached = std::max(reached, t[0].x);
                               return 0.0;
                             });
  EXPECT_EQ(reached, 1000.0);
}

}  // namespace
}  // namespace farlod
