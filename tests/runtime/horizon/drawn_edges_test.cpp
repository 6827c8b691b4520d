// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/drawn_edges.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "horizon/packet_horizon.hpp"
#include "horizon/wedge_kernels.hpp"
#include "tests/runtime/horizon/kernel_targets.hpp"
#include "tests/runtime/horizon/random_places.hpp"

namespace farlod {
namespace {

constexpr std::size_t lanes = ReceiverPacket::lanes;

/// Long walls nearby, and far towers, most of which lie between two azimuths.
std::vector<HorizonEdge> walls_and_towers(RandomPlaces& random) {
  std::vector<HorizonEdge> edges;
  for (const double reach_m : {15.0, 60.0, 400.0})
    for (int n = 0; n < 12; ++n) edges.push_back(random.edge(reach_m, -5.0, 40.0));
  for (int n = 0; n < 400; ++n) {
    const Point3f far = random.direction_at(0.0), along{-far.y, far.x, 0.0F};
    const Point3f a = 300.0F * far + Point3f{0.0F, 0.0F, random.between(30.0, 300.0)};
    edges.push_back({a, a + 6.0F * along});
  }
  for (HorizonEdge& e : edges) e.adjacent = {AdjacentSlopes::straight_down, AdjacentSlopes::straight_down};
  return edges;
}

ReceiverPacket packet_near(const Point3f& p, float width_m, RandomPlaces& random) {
  std::vector<Point3f> places;
  for (std::size_t n = 0; n < lanes; ++n)
    places.push_back(p + Point3f{random.between(0.0, width_m), random.between(0.0, width_m), static_cast<float>(n % 3)});
  return packet_of(places);
}

/// The slope at which an edge is seen along a direction; 0 if it passes the edge, or the edge is seen end-on.
double slope_along(const HorizonEdge& e, const LookInWedge& look) {
  const Point3d p{e.a.x - look.x, e.a.y - look.y, e.a.z - look.z}, q{e.b.x - look.x, e.b.y - look.y, e.b.z - look.z};
  const double cross = p.x * q.y - p.y * q.x;
  if (std::abs(cross) < 2e-5 * std::hypot(p.x, p.y) * std::hypot(q.x, q.y)) return 0.0;
  const double u = (p.x * look.sine - p.y * look.cosine) / cross, v = (q.y * look.cosine - q.x * look.sine) / cross;
  return std::min(u, v) >= 0.0 ? p.z * v + q.z * u : 0.0;
}
double highest_of(const std::vector<HorizonEdge>& edges, const LookInWedge& look) {
  double highest = 0.0;
  for (const HorizonEdge& e : edges) highest = std::max(highest, slope_along(e, look));
  return highest;
}

class DrawnEdgesOfTargets : public testing::TestWithParam<KernelTarget> {
 protected:
  /// A receiver looks somewhere in a wedge, above the lower one of both horizons.
  [[nodiscard]] LookInWedge look(const ReceiverPacket& packet, std::size_t lane, std::uint32_t wedge,
                                 const std::vector<PacketHorizon::Row>& slopes) {
    const auto turn = static_cast<std::uint32_t>(azimuths_.size());
    const double angle = random_.between(0.02, 0.98) * 2.0 * std::numbers::pi / turn, c = azimuths_.cosine()[wedge],
                 s = azimuths_.sine()[wedge];
    return {.wedge = wedge,
            .wedges = turn,
            .x = packet.x[lane],
            .y = packet.y[lane],
            .z = packet.z[lane],
            .cosine = static_cast<float>(c * std::cos(angle) - s * std::sin(angle)),
            .sine = static_cast<float>(s * std::cos(angle) + c * std::sin(angle)),
            .above = std::min(slopes[wedge][lane], slopes[(wedge + 1) % turn][lane])};
  }
  [[nodiscard]] static HighestBorder highest(const DrawnEdges& drawn, const BorderEnds& ends, const LookInWedge& look) {
    return GetParam().wedge_end->find_highest(drawn.spans(), drawn.size(), ends.all(), look);
  }

  RandomPlaces random_;
  const AzimuthSampling azimuths_ = AzimuthSampling::even(96, GridRotation(Angle::degrees(20.0)));
};

/// Whatever was culled is no higher than both horizons: the highest of what was drawn is the highest of all.
TEST_P(DrawnEdgesOfTargets, HaveTheHighestOfEachWedge) {
  int between_both = 0;
  for (int n = 0; n < 20; ++n) {
    const ReceiverPacket packet = packet_near(random_.place(30.0, 0.0, 8.0), n % 2 == 0 ? 0.5F : 25.0F, random_);
    const std::vector<HorizonEdge> edges = walls_and_towers(random_);
    const SilhouetteEdges silhouettes = silhouettes_of(edges);
    const BorderEnds ends(std::array<const SilhouetteEdges*, 1>{&silhouettes});
    std::vector<PacketHorizon::Row> slopes(azimuths_.size());
    std::vector<std::array<std::int32_t, lanes>> numbers(azimuths_.size());
    DrawnEdges drawn;
    drawn.added(GetParam().edge->raise_to_edges(
        {silhouettes.batches(), EdgeRole::grounded}, packet, bounds_of(packet), azimuths_.view(), Culling::nothing_drawn,
        {slopes.front().data(), numbers.front().data(), drawn.room_for(silhouettes.batches().size() * lanes)}));
    for (std::uint32_t k = 0; k < azimuths_.size(); ++k)
      for (std::size_t l = 0; l < lanes; ++l) {
        const LookInWedge at = look(packet, l, k, slopes);
        const double wanted = highest_of(edges, at), rounding = 1e-4 * (1.0 + wanted);
        const HighestBorder border = highest(drawn, ends, at);
        EXPECT_NEAR(std::max(border.slope, at.above), std::max(wanted, static_cast<double>(at.above)), rounding)
            << k << ", " << l;
        if (border.number < 0) continue;
        EXPECT_NEAR(slope_along(edges[static_cast<std::size_t>(border.number)], at), wanted, rounding);
        between_both += wanted < std::max(slopes[k][l], slopes[(k + 1) % azimuths_.size()][l]) ? 1 : 0;
      }
  }
  EXPECT_GT(between_both, 500);
}

TEST_P(DrawnEdgesOfTargets, HaveTheSameHighestInAnyGroup) {
  const std::vector<HorizonEdge> edges = walls_and_towers(random_);
  const SilhouetteEdges silhouettes = silhouettes_of(edges);
  const BorderEnds ends(std::array<const SilhouetteEdges*, 1>{&silhouettes});
  std::vector<ReceiverPacket> packets;
  for (int n = 0; n < 8; ++n) packets.push_back(packet_near({0.2F * static_cast<float>(n), 0.0F, 1.0F}, 0.2F, random_));
  std::vector<PacketHorizon> together(packets.size(), PacketHorizon(azimuths_, PacketHorizon::Edges::tracked));
  PacketGroup(azimuths_).raise(silhouettes, packets, together);
  int found = 0;
  for (std::size_t n = 0; n < packets.size(); ++n) {
    PacketHorizon alone(azimuths_, PacketHorizon::Edges::tracked);
    alone.raise(silhouettes, packets[n]);
    std::vector<PacketHorizon::Row> slopes;
    for (std::size_t k = 0; k < azimuths_.size(); ++k) slopes.push_back(alone.row(k));
    for (std::uint32_t k = 0; k < azimuths_.size(); ++k)
      for (std::size_t l = 0; l < lanes; ++l) {
        const LookInWedge at = look(packets[n], l, k, slopes);
        const HighestBorder border = highest(alone.drawn(), ends, at), other = highest(together[n].drawn(), ends, at);
        EXPECT_EQ(border.slope, other.slope) << n << ", " << k << ", " << l;
        EXPECT_EQ(border.number, other.number);
        found += border.number >= 0 ? 1 : 0;
      }
  }
  EXPECT_GT(found, 1000);
}

INSTANTIATE_TEST_SUITE_P(Targets, DrawnEdgesOfTargets, testing::ValuesIn(kernel_targets()), name_of_target);

}  // namespace
}  // namespace farlod
