// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/wedge_envelope.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "horizon/wedge_sky.hpp"
#include "tests/runtime/horizon/random_places.hpp"
#include "tests/runtime/horizon/wedge_scenes.hpp"

namespace farlod {
namespace {

struct Edge3d {
  Point3d a, b;
};

WedgeEnvelope::Sky above_edges(std::span<const Edge3d> edges, const Wedge& wedge, const Point3d& normal, SkyWeight weight) {
  WedgeEnvelope envelope;
  envelope.begin(wedge, normal, weight);
  for (const Edge3d& e : edges) envelope.add(e.a, e.b);
  return envelope.sky();
}

/// Everything below an edge, to far below the level.
double above_curtains(std::span<const Edge3d> edges, const Wedge& wedge, const Point3d& normal, SkyWeight weight) {
  WedgeSky sky;
  sky.begin(wedge, normal, weight);
  for (const Edge3d& e : edges) {
    const auto below = [](const Point3d& p) { return Point3d{p.x, p.y, -1000.0}; };
    for (const Triangle3d& triangle : quadrilateral(e.a, e.b, below(e.b), below(e.a))) sky.add(triangle);
  }
  return sky.sky().sky;
}

/// Some hundred arcs, each of a few angles of at most π by some ten roundings of as much.
constexpr double wedge_rounding = 256.0 * 10.0 * 0.5 * std::numeric_limits<double>::epsilon();

/// The azimuths of an edge that passes the receiver are off by the rounding of its places over its distance.
double azimuth_rounding(std::span<const Edge3d> edges) {
  double rounding = 0.0;
  for (const Edge3d& e : edges) {
    const Point2d p = horizontal(e.a), way = horizontal(e.b) - p;
    const double share = std::clamp(-dot(p, way) / dot(way, way), 0.0, 1.0);
    rounding += 4.0 * (norm(p) + norm(way)) * std::numeric_limits<double>::epsilon() / norm(p + share * way);
  }
  return rounding;
}

Point3d normal_at(RandomPlaces& random, double z) {
  const Point3f n = random.direction_at(z);
  return normalized(Point3d{n.x, n.y, n.z});
}

TEST(WedgeEnvelope, AWallHidesWhatItsElevationHides) {
  for (const double height : {0.5, 3.0, 40.0}) {
    double sum = 0.0;
    const Edge3d top{{4.0, -50.0, height}, {4.0, 50.0, height}};
    for (const Wedge& wedge : wedges_of_turn(320))
      sum += above_edges(std::span(&top, 1), wedge, {0.0, 0.0, 1.0}, SkyWeight::cosine).sky;
    EXPECT_NEAR(sum / turn_rad, 1.0 - 2.0 * wall_view_factor(4.0, 50.0, height), 320.0 * wedge_rounding);
  }
}

TEST(WedgeEnvelope, EdgesAreCurtainsDownToTheGround) {
  RandomPlaces random;
  for (int scene = 0; scene < 200; ++scene)
    for (const double z : {1.0, 0.8, 0.1, 0.0, -0.1, -0.7}) {
      const Point3d normal = normal_at(random, z);
      std::vector<Edge3d> edges;
      for (int n = 0; n < 1 + scene % 20; ++n) {
        const HorizonEdge e = random.edge(30.0, -3.0, 15.0);
        edges.push_back({{e.a.x, e.a.y, e.a.z}, {e.b.x, e.b.y, e.b.z}});
      }
      for (const SkyWeight weight : {SkyWeight::cosine, SkyWeight::solid_angle})
        for (const Wedge& wedge : wedges_of_turn(9))
          EXPECT_NEAR(above_edges(edges, wedge, normal, weight).sky, above_curtains(edges, wedge, normal, weight),
                      wedge_rounding + azimuth_rounding(edges))
              << edges.size() << " edges, " << z;
    }
}

TEST(WedgeEnvelope, EdgesThatBeginAtTheSameAzimuth) {
  // The higher one falls, the lower one rises; and one that rises from below the level crosses it there, at τ = 1/8
  const Point3d normal{0.0, 0.0, 1.0};
  const Wedge wedge{{1.0, 0.0}, 0.25};
  const Edge3d high{{8.0, 1.0, 4.0}, {8.0, 2.0, 3.0}}, low{{8.0, 1.0, 1.0}, {8.0, 2.0, 2.0}},
      crossing{{8.0, 0.0, -1.0}, {8.0, 2.0, 1.0}};
  for (const std::vector<Edge3d>& edges :
       {std::vector{high, low}, {low, high}, {crossing, high}, {high, crossing}, {crossing, low, high}})
    EXPECT_NEAR(above_edges(edges, wedge, normal, SkyWeight::cosine).sky, above_curtains(edges, wedge, normal, SkyWeight::cosine),
                wedge_rounding);
}

TEST(WedgeEnvelope, EdgesThatMeetInOnePlace) {
  // A fan of edges through one place of the picture: each is the envelope on one side of it at most
  const Point3d normal{0.0, 0.0, 1.0};
  const Wedge wedge{{1.0, 0.0}, 0.3};
  std::vector<Edge3d> edges;
  for (const double rise : {-0.9, 1.3, 0.1, -2.7, 2.1, 0.7})
    for (const double d : {7.0, 3.0}) edges.push_back({{d, 0.0, d * (0.5 - 0.1 * rise)}, {d, 0.3 * d, d * (0.5 + 0.2 * rise)}});
  EXPECT_NEAR(above_edges(edges, wedge, normal, SkyWeight::cosine).sky, above_curtains(edges, wedge, normal, SkyWeight::cosine),
              wedge_rounding);
}

TEST(WedgeEnvelope, NothingIsSeenBesideAnEdgeThatPassesCloseBy) {
  // A millimetre from the receiver and 40 m long. Where it covers a wedge, a gap beside it would be as wide as the rounding of 40
  // m at a millimetre, 9e-12, and not as that of the tangent
  const std::vector<Edge3d> edge{{{0.001, -17.3, 9.1}, {0.0013, 23.9, 9.7}}};
  const Point3d normal{0.0, 0.0, 1.0};
  std::size_t covered = 0;
  for (const Wedge& wedge : wedges_of_turn(64)) {
    const double sky = above_edges(edge, wedge, normal, SkyWeight::cosine).sky;
    if (sky > 1e-7) continue;
    ++covered;
    EXPECT_NEAR(sky, above_curtains(edge, wedge, normal, SkyWeight::cosine),
                std::numeric_limits<double>::epsilon() * wedge.tangent);
  }
  EXPECT_GT(covered, 20U);
}

TEST(WedgeEnvelope, TheLeastHeightOfTheEnvelope) {
  const Wedge wedge{{1.0, 0.0}, 0.2};
  const std::vector<Edge3d> edges{{{10.0, -1.0, 5.0}, {10.0, 1.0, 3.0}}, {{5.0, 0.5, 1.5}, {5.0, 2.0, 3.0}}};
  const auto lowest = [&](std::size_t count) {
    return above_edges(std::span(edges).first(count), wedge, {0.0, 0.0, 1.0}, SkyWeight::cosine).lowest;
  };
  EXPECT_EQ(lowest(0), 0.0);
  EXPECT_EQ(lowest(1), 0.0);
  EXPECT_NEAR(lowest(2), 0.3, wedge_rounding);
  // Nothing is seen by who looks away
  const WedgeEnvelope::Sky behind = above_edges(edges, wedge, {-1.0, 0.0, 0.0}, SkyWeight::cosine);
  EXPECT_EQ(behind.sky, 0.0);
  EXPECT_EQ(behind.lowest, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace farlod
