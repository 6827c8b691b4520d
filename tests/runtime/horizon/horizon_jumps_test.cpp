// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/horizon_jumps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/runtime/horizon/random_places.hpp"

namespace farlod {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

/// ∫ cos²β over the azimuths of the edge from a to b, both at the same height: with the perpendicular distance d, T = height / d
/// and the azimuth ψ from the perpendicular, tan β = T cos ψ, and the integral is arctan(tan ψ / √(1 + T²)) / √(1 + T²).
double sky_above_edge(Point2d a, Point2d b, double height_m) {
  const double length = std::hypot(b.x - a.x, b.y - a.y), distance = std::abs(a.x * b.y - a.y * b.x) / length;
  const double slope = height_m / distance, root = std::sqrt(1.0 + slope * slope);
  const auto integral = [&](Point2d p) {
    const double along = (p.x * (b.x - a.x) + p.y * (b.y - a.y)) / length;  // tan ψ = along / distance
    return std::atan(along / distance / root) / root;
  };
  return std::abs(integral(b) - integral(a));
}
double angle_between(Point2d a, Point2d b) { return std::abs(std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y)); }

Point2d at(double azimuth_degrees, double distance_m) {
  const double azimuth = azimuth_degrees * std::numbers::pi / 180.0;
  return {distance_m * std::cos(azimuth), distance_m * std::sin(azimuth)};
}

/// A receiver at the origin, walls of one height around it, and their exact view factor: corners in the order of their azimuths,
/// with a wall from each to the next.
struct Walls {
  std::vector<Point2d> corners;
  double height_m;

  [[nodiscard]] std::vector<HorizonEdge> edges() const {
    std::vector<HorizonEdge> result;
    for (std::size_t n = 0; n + 1 < corners.size(); ++n) result.push_back({corner(n), corner(n + 1)});
    return result;
  }
  [[nodiscard]] double svf() const {
    double open = turn, sky = 0.0;
    for (std::size_t n = 0; n + 1 < corners.size(); ++n) {
      open -= angle_between(corners[n], corners[n + 1]);
      sky += sky_above_edge(corners[n], corners[n + 1], height_m);
    }
    return (open + sky) / turn;
  }

 private:
  [[nodiscard]] Point3f corner(std::size_t n) const {
    return {static_cast<float>(corners[n].x), static_cast<float>(corners[n].y), static_cast<float>(height_m)};
  }
};

struct Answers {
  double even, placed, of_light;
};
Answers answers_of(const std::vector<HorizonEdge>& edges, std::size_t azimuths, const Point3f& normal = {0.0F, 0.0F, 1.0F}) {
  const AzimuthSampling ring = AzimuthSampling::even(azimuths, {});
  ReceiverPacket receiver = packet_of(std::vector{Point3f{}});
  receiver.normal_x[0] = normal.x;
  receiver.normal_y[0] = normal.y;
  receiver.normal_z[0] = normal.z;
  const SilhouetteEdges silhouettes = silhouettes_of(edges);
  const SilhouetteEdges* const list = &silhouettes;
  const BorderEnds ends({&list, 1});
  PacketHorizon horizon(ring, PacketHorizon::Edges::tracked);
  horizon.clear();
  horizon.raise(silhouettes, receiver);
  HorizonJumps jumps(ring, ends);
  const float placed = jumps.sky_above(horizon, SkyWeight::cosine, receiver, 0, {}).sky[0];
  std::vector<PacketHorizon::Row> rows(azimuths);
  EXPECT_EQ(jumps.sky_above(horizon, SkyWeight::cosine, receiver, 0, {.for_light = rows}).sky[0], placed);
  double of_light = 0.0;
  for (const PacketHorizon::Row& row : rows) of_light += static_cast<double>(row[0]) / static_cast<double>(azimuths);
  return {horizon.sky_above(SkyWeight::cosine, receiver)[0], placed, of_light};
}

struct LargestErrors {
  double even = 0.0, placed = 0.0, of_light = 0.0;
};
/// Over walls that are turned a little at a time, by a whole azimuth in all.
template <class WallsAt>
LargestErrors largest_errors(std::size_t azimuths, const WallsAt& walls_at) {
  LargestErrors largest;
  constexpr int turns = 50;
  for (int n = 0; n < turns; ++n) {
    const auto walls = walls_at(360.0 / static_cast<double>(azimuths) * n / turns);
    const Answers answers = answers_of(walls.edges(), azimuths);
    largest.even = std::max(largest.even, std::abs(answers.even - walls.svf()));
    largest.placed = std::max(largest.placed, std::abs(answers.placed - walls.svf()));
    largest.of_light = std::max(largest.of_light, std::abs(answers.of_light - walls.svf()));
  }
  return largest;
}

TEST(HorizonJumps, AWallEndsWhereItEnds) {
  for (const std::size_t azimuths : {32U, 64U, 128U, 256U}) {
    // Between its ends it is as far as they are, so that the horizon hardly changes beside a jump
    const LargestErrors largest = largest_errors(azimuths, [](double by) {
      return Walls{{at(10.0 + by, 20.0), at(50.3 + by, 20.0)}, 60.0};
    });
    const double bin = 1.0 / static_cast<double>(azimuths);
    EXPECT_GT(largest.even, 0.4 * bin);
    EXPECT_LT(largest.placed, 1.2 * bin * bin) << azimuths;
  }
}

TEST(HorizonJumps, AWallThatGoesOnRoundACornerEndsWithWhatGoesOn) {
  constexpr std::size_t azimuths = 64;
  // The second wall is narrower than the distance of two azimuths, 5.6°: mostly, no azimuth meets it
  const LargestErrors largest = largest_errors(azimuths, [](double by) {
    return Walls{{at(10.0 + by, 20.0), at(50.0 + by, 20.0), at(53.5 + by, 21.0)}, 60.0};
  });
  EXPECT_GT(largest.even, 0.4 / azimuths);
  EXPECT_LT(largest.placed, 0.1 / azimuths);
}

TEST(HorizonJumps, AWallThatGoesOnInManyPiecesEndsWithTheLast) {
  constexpr std::size_t azimuths = 64;
  // The pieces are narrower than the distance of two azimuths, all together
  const LargestErrors largest = largest_errors(azimuths, [](double by) {
    return Walls{{at(10.0 + by, 20.0), at(50.0 + by, 20.0), at(51.0 + by, 20.2), at(52.0 + by, 20.5), at(53.5 + by, 21.0)}, 60.0};
  });
  EXPECT_GT(largest.even, 0.4 / azimuths);
  EXPECT_LT(largest.placed, 0.1 / azimuths);
}

TEST(HorizonJumps, AWallThatGoesOnFarAwayIsSeenLower) {
  constexpr std::size_t azimuths = 64;
  const LargestErrors largest = largest_errors(azimuths, [](double by) {
    return Walls{{at(10.0 + by, 20.0), at(50.0 + by, 20.0), at(54.0 + by, 160.0)}, 60.0};
  });
  EXPECT_GT(largest.even, 0.3 / azimuths);
  EXPECT_LT(largest.placed, 0.15 / azimuths);
}

/// A wall, and a lower one that stands behind its second end and goes on beyond.
struct WallBehind {
  Walls front, behind;

  [[nodiscard]] std::vector<HorizonEdge> edges() const {
    std::vector<HorizonEdge> both = front.edges();
    const std::vector<HorizonEdge> others = behind.edges();
    both.insert(both.end(), others.begin(), others.end());
    return both;
  }
  [[nodiscard]] double svf() const {
    // What is seen of it begins on the ray past the end of the front: at a + s (b − a) with f × (a + s (b − a)) = 0
    const Point2d f = front.corners.back(), a = behind.corners.front(), b = behind.corners.back();
    const auto beside = [&](Point2d p) { return f.x * p.y - f.y * p.x; };
    const double s = beside(a) / (beside(a) - beside(b));
    const Walls seen{{{a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)}, b}, behind.height_m};
    return front.svf() + seen.svf() - 1.0;
  }
};

/// What is seen of the wall behind is narrower than the distance of two azimuths: mostly, no azimuth meets it.
LargestErrors largest_errors_of_walls(double front_m, double behind_m) {
  return largest_errors(HorizonJumps::least_azimuths_to_look, [&](double by) {
    return WallBehind{{{at(10.0 + by, 20.0), at(50.0 + by, 20.0)}, front_m},
                      {{at(35.0 + by, 60.0), at(50.9 + by, 60.0)}, behind_m}};
  });
}

TEST(HorizonJumps, ALowerWallComesIntoSightWhereAHigherOneEnds) {
  const LargestErrors largest = largest_errors_of_walls(60.0, 70.0);
  EXPECT_GT(largest.even, 0.4 / HorizonJumps::least_azimuths_to_look);
  EXPECT_LT(largest.placed, 0.05 / HorizonJumps::least_azimuths_to_look);
}

TEST(HorizonJumps, ALowerWallCountsForLightWhereLittleSkyIsAtStake) {
  const LargestErrors largest = largest_errors_of_walls(8.0, 18.0);
  EXPECT_GT(largest.placed, 0.03 / HorizonJumps::least_azimuths_to_look);
  EXPECT_LT(largest.of_light, 0.01 / HorizonJumps::least_azimuths_to_look);
}

TEST(HorizonJumps, ATurnOfTheNormalIsNone) {
  // A straight wall, of one edge or of two, seen by a receiver that looks along it: what it sees changes much from azimuth to
  // azimuth, but not where the second edge begins
  const Point3f from{20.0F, -2e4F, 30.0F}, middle{20.0F, 3.0F, 30.0F}, to{20.0F, 2e4F, 30.0F};
  const Point3f along{0.0F, 1.0F, 0.0F};
  const Answers whole = answers_of({{from, to}}, 32, along), in_two = answers_of({{from, middle}, {middle, to}}, 32, along);
  EXPECT_FLOAT_EQ(static_cast<float>(in_two.placed), static_cast<float>(whole.placed));
}

TEST(HorizonJumps, SmallOnesStayWhereTheyAre) {
  const Walls low{{at(10.2, 100.0), at(50.3, 100.0)}, 20.0};  // 4 % of the sky
  const Answers answers = answers_of(low.edges(), 64);
  EXPECT_EQ(answers.placed, answers.even);
}

TEST(HorizonJumps, FewAzimuthsAreSummedAsTheyAre) {
  const Answers answers = answers_of(Walls{{at(10.2, 20.0), at(50.3, 20.0)}, 60.0}.edges(), HorizonJumps::least_azimuths - 1);
  EXPECT_EQ(answers.placed, answers.even);
}

TEST(HorizonJumps, TheSkyStaysBetweenNothingAndAll) {
  RandomPlaces random;
  for (int n = 0; n < 200; ++n) {
    std::vector<HorizonEdge> edges;
    for (int k = 0; k < 30; ++k) edges.push_back(random.edge(20.0, 0.0, 90.0));
    const Answers answers = answers_of(edges, 32);
    EXPECT_GE(answers.placed, 0.0);
    EXPECT_LE(answers.placed, 1.0);
    EXPECT_NEAR(answers.placed, answers.even, 0.5 * 30 / 32.0);
  }
}

TEST(BorderEnds, LeadAroundAllThatAreAtOnePlace) {
  // A triangle, and an edge that touches one of its corners
  const Point3f a{1.0F, 2.0F, 3.0F}, b{4.0F, 2.0F, 3.0F}, c{4.0F, 9.0F, 3.0F}, d{7.0F, 7.0F, 7.0F};
  const SilhouetteEdges triangle = silhouettes_of(std::vector<HorizonEdge>{{a, b}, {b, c}, {c, a}});
  SilhouetteEdges single = silhouettes_of(std::vector<HorizonEdge>{{d, b}});
  single.number_from(3);
  const std::array<const SilhouetteEdges*, 2> lists{&triangle, &single};
  const BorderEnds ends(lists);
  ASSERT_EQ(ends.size(), 8U);
  const auto around = [&](std::size_t n) {
    std::vector<std::size_t> all{n};
    for (std::size_t k = ends.end(n).next; k != n && all.size() < 9; k = ends.end(k).next) all.push_back(k);
    std::sort(all.begin(), all.end());
    return all;
  };
  for (std::size_t n = 0; n < ends.size(); ++n) {
    std::vector<std::size_t> expected;
    for (std::size_t k = 0; k < ends.size(); ++k)
      if (ends.end(k).p == ends.end(n).p) expected.push_back(k);
    EXPECT_EQ(around(n), expected) << n;
  }
  EXPECT_EQ(around(1), (std::vector<std::size_t>{1, 2, 7}));
}

}  // namespace
}  // namespace farlod
