// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/horizon_engine.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "package/horizon_edge.hpp"
#include "tests/package/far_horizon_by_hand.hpp"
#include "tests/runtime/horizon/horizon_oracle.hpp"
#include "tests/runtime/horizon/packed_overhangs.hpp"
#include "tests/runtime/horizon/packet_by_packet.hpp"
#include "tests/runtime/horizon/town_by_hand.hpp"

namespace farlod {
namespace {

constexpr SkyWeight both_weights[] = {SkyWeight::cosine, SkyWeight::solid_angle};
constexpr Point3f up{0.0F, 0.0F, 1.0F};
constexpr std::size_t azimuths = 128;

std::array<float, 3> ends(const SvfInterval& svf) { return {svf.low, svf.estimate, svf.high}; }

/// A raster of 1 m over a cell of 20 m, 1.5 m above the ground.
std::vector<Receiver> dense_receivers(const Point3f& normal) {
  std::vector<Receiver> receivers;
  for (std::size_t n = 0; n < 1600; ++n)
    receivers.push_back(
        {n, {0.25F + 0.5F * static_cast<float>(n % 40), 0.25F + 0.5F * static_cast<float>(n / 40), 1.5F}, normal});
  return receivers;
}

/// A town in which horizons are known, and an engine over it, which adds up azimuths evenly unless it is told otherwise.
class KnownTown {
 public:
  KnownTown(const TownByHand& town, SkyWeight weight, float gap_tolerance = 0.0F, JumpPlaces jumps = JumpPlaces::between_azimuths)
      : packed_(town.overhanging()),
        overhangs_(packed_.geometry()),
        silhouettes_(town.silhouettes()),
        engine_(ring_, weight, far_.map(), silhouettes_, overhangs_, gap_tolerance, jumps) {
    silhouettes_.number_borders();
  }
  /// With this far map. An engine looks once whether anything residual overhangs.
  KnownTown(const TownByHand& town, SkyWeight weight, const FarHorizon& map)
      : packed_(town.overhanging()),
        overhangs_(packed_.geometry()),
        silhouettes_(town.silhouettes()),
        engine_(ring_, weight, map, silhouettes_, overhangs_, 0.0F, JumpPlaces::between_azimuths) {
    silhouettes_.number_borders();
  }

  [[nodiscard]] HorizonEngine& engine() { return engine_; }
  [[nodiscard]] FarHorizon& map() { return far_.map(); }
  [[nodiscard]] const AzimuthSampling& ring() const { return ring_; }
  /// Answers receivers packet by packet; the numbers of those that needed rays.
  std::vector<std::uint32_t> evaluate(std::span<const Receiver> receivers, std::span<SvfInterval> intervals) {
    return packet_by_packet(engine_, receivers, intervals, &HorizonEngine::evaluate);
  }
  std::vector<std::uint32_t> evaluate_with_bounds(std::span<const Receiver> receivers, std::span<SvfInterval> intervals) {
    return packet_by_packet(engine_, receivers, intervals, &HorizonEngine::evaluate_with_bounds);
  }
  /// What the receivers see at the azimuths, at least and at most.
  std::vector<SvfInterval> drawn(std::span<const Receiver> receivers) {
    engine_.tell_profiles({}, [](std::size_t, SkyProfile&) {});
    std::vector<SvfInterval> intervals;
    for (std::size_t first = 0; first < receivers.size(); first += ReceiverPacket::lanes) {
      ReceiverPacket packet;
      for (std::size_t n = first; n < std::min(receivers.size(), first + ReceiverPacket::lanes); ++n) packet.add(receivers[n]);
      PacketAnswer answer;
      engine_.evaluate_with_bounds({&packet, 1}, {&answer, 1});
      intervals.insert(intervals.end(), answer.drawn.begin(), answer.drawn.begin() + static_cast<std::ptrdiff_t>(packet.count));
    }
    return intervals;
  }

 private:
  AzimuthSampling ring_ = AzimuthSampling::even(azimuths, {});
  FarHorizonByHand far_{{}};
  PackedOverhangs packed_;
  OverhangGeometry overhangs_;
  CellSilhouettes silhouettes_;
  HorizonEngine engine_;
};

TEST(HorizonEngine, AnswersWhatIsAboveTheEdgesOfATown) {
  RandomPlaces random;
  TownByHand town;
  add_random_boxes(random, 40, town);
  for (const SkyWeight weight : both_weights)
    for (const Point3f& normal : {up, Point3f{0.6F, 0.0F, 0.8F}, {0.0F, -1.0F, 0.0F}, {0.0F, 0.8F, -0.6F}}) {
      KnownTown known(town, weight);
      const std::vector<Receiver> receivers = receivers_in_a_square(random, normal);
      std::vector<SvfInterval> intervals(receivers.size());
      EXPECT_TRUE(known.evaluate(receivers, intervals).empty());
      for (const Receiver& r : receivers) {
        const auto sky_above = [&](double SlopeRange::*end) {
          return expected_sky(weight, normal, known.ring(), [&](std::size_t k) {
            return expected_horizon(town.grounded(), r.p_cell, {known.ring().cosine()[k], known.ring().sine()[k]}).*end;
          });
        };
        const double rounding = sky_rounding(azimuths, normal);
        EXPECT_LE(intervals[r.index].estimate, sky_above(&SlopeRange::low) + rounding) << r.index;
        EXPECT_GE(intervals[r.index].estimate, sky_above(&SlopeRange::high) - rounding) << r.index;
      }
    }
}

TEST(HorizonEngine, TheSkyOfLightHasSmallJumpsWhereTheyAre) {
  // Low and far: the sky above them differs by less than the jumps that the view factor places
  TownByHand town;
  for (const double x : {-60.0, -35.0, 30.0, 52.0})
    for (const double y : {-55.0, -32.0, 28.0, 50.0}) town.add_box({x, y}, {7.0, 9.0}, 9.0);
  KnownTown known(town, SkyWeight::cosine, 0.0F, JumpPlaces::at_edge_ends);
  SkyProfile profile(known.ring());
  known.engine().tell_profiles({.light_sky = true}, [&](std::size_t, SkyProfile& told) { profile = told; });
  const AzimuthSampling fine = AzimuthSampling::even(64 * azimuths, {});
  double error_of_sky = 0.0, error_of_light = 0.0;
  for (float x = -8.0F; x < 24.0F; x += 3.0F) {
    const Receiver receiver{0, {x, 0.7F * x, 1.5F}};
    std::vector<SvfInterval> interval(1);
    known.evaluate({&receiver, 1}, interval);
    const double truth = expected_sky(SkyWeight::cosine, up, fine, [&](std::size_t k) {
      return expected_horizon(town.grounded(), receiver.p_cell, {fine.cosine()[k], fine.sine()[k]}).high;
    });
    const auto mean = [](const SkyProfile::Rows& rows) {
      double sum = 0.0;
      for (const PacketHorizon::Row& row : rows) sum += static_cast<double>(row[0]);
      return sum / static_cast<double>(rows.size());
    };
    error_of_sky += std::abs(mean(profile.sky) - truth);
    error_of_light += std::abs(mean(profile.light_sky) - truth);
  }
  EXPECT_LT(error_of_light, 0.75 * error_of_sky);
}

TEST(HorizonEngine, AReceiverSeesTheSameWhoeverStandsBesideIt) {
  RandomPlaces random;
  TownByHand town;
  add_random_boxes(random, 40, town);
  for (const Point3f& normal : {up, Point3f{0.6F, 0.0F, 0.8F}}) {
    KnownTown known(town, SkyWeight::cosine, 0.0F, JumpPlaces::at_edge_ends);
    const std::vector<Receiver> receivers = dense_receivers(normal);
    std::vector<SvfInterval> together(receivers.size()), with_bounds(receivers.size()), alone(1);
    EXPECT_TRUE(known.evaluate(receivers, together).empty());
    EXPECT_TRUE(known.evaluate_with_bounds(receivers, with_bounds).empty());
    for (std::size_t n = 0; n < receivers.size(); ++n) {
      EXPECT_TRUE(known.evaluate(std::span(receivers).subspan(n, 1), alone).empty());
      EXPECT_EQ(alone[0].estimate, together[n].estimate) << n;
      EXPECT_EQ(with_bounds[n].estimate, std::clamp(together[n].estimate, with_bounds[n].low, with_bounds[n].high)) << n;
    }
  }
}

TEST(HorizonEngine, APacketIsAnsweredAlikeInAnyGroup) {
  RandomPlaces random;
  TownByHand town;
  add_random_boxes(random, 40, town);
  town.add_beam({5.0, 5.0}, {4.0, 9.0}, 4.0, 6.0);
  KnownTown known(town, SkyWeight::cosine, 0.0F, JumpPlaces::at_edge_ends);
  std::vector<ReceiverPacket> packets;
  for (const Receiver& r : dense_receivers(up)) {
    if (packets.empty() || packets.back().count == ReceiverPacket::lanes) packets.emplace_back();
    packets.back().add(r);
  }
  for (const Evaluate evaluate : {Evaluate{&HorizonEngine::evaluate}, Evaluate{&HorizonEngine::evaluate_with_bounds}}) {
    std::vector<PacketAnswer> together(packets.size()), alone(1);
    (known.engine().*evaluate)(packets, together);
    for (std::size_t n = 0; n < packets.size(); ++n) {
      (known.engine().*evaluate)(std::span(packets).subspan(n, 1), alone);
      for (std::size_t l = 0; l < packets[n].count; ++l)
        EXPECT_EQ(ends(together[n].svf[l]), ends(alone[0].svf[l])) << n << ", " << l;
    }
  }
}

TEST(HorizonEngine, TheEstimateChangesEvenlyFromFloorToFloor) {
  KnownTown known(TownByHand(), SkyWeight::cosine);
  FarHorizon& map = known.map();
  // Each bin has its own
  for (std::size_t n = 0; n < map.estimate.size(); ++n)
    map.estimate[n] = (n < map.bins.count ? 1.0F : 0.5F) + 0.1F * static_cast<float>(n % map.bins.count);
  std::fill(map.high.begin(), map.high.end(), 2.0F);
  // Floors at 0 and 10 m; below the lowest nobody knows: as on it
  for (const float z : {-3.0F, 0.0F, 2.5F, 5.0F, 7.5F, 10.0F, 99.0F}) {
    const std::vector<Receiver> receiver{{0, {3.0F, 3.0F, z}}};
    std::vector<SvfInterval> interval(1);
    known.evaluate(receiver, interval);
    const double between = 1.0 - 0.05 * double{std::clamp(z, 0.0F, 10.0F)};
    const double expected = expected_sky(SkyWeight::cosine, up, known.ring(), [&](std::size_t k) {
      return between + 0.1 * map.bins.bin_of({known.ring().cosine()[k], known.ring().sine()[k]});
    });
    EXPECT_NEAR(interval[0].estimate, expected, sky_rounding(azimuths, up)) << z << " m";
  }
}

TEST(HorizonEngine, ReceiversOfOnePacketMayStandOnDifferentFloors) {
  KnownTown known(TownByHand(), SkyWeight::cosine);
  FarHorizon& map = known.map();
  for (std::size_t n = 0; n < map.estimate.size(); ++n) {
    map.low[n] = n < map.bins.count ? 0.5F : 0.0F;
    map.estimate[n] = n < map.bins.count ? 1.0F : 0.25F;
    map.high[n] = n < map.bins.count ? 2.0F : 0.5F;
  }
  std::vector<Receiver> receivers;
  for (std::size_t n = 0; n < 11; ++n) receivers.push_back({n, {3.0F, 3.0F, -7.0F + 2.0F * static_cast<float>(n)}});
  std::vector<SvfInterval> together(receivers.size()), alone(1);
  known.evaluate_with_bounds(receivers, together);
  for (std::size_t n = 0; n < receivers.size(); ++n) {
    known.evaluate_with_bounds(std::span(receivers).subspan(n, 1), alone);
    EXPECT_EQ(ends(alone[0]), ends(together[n])) << n;
  }
  // Below the lowest floor nothing is certain
  EXPECT_EQ(together.front().low, 0.0F);
  EXPECT_EQ(together.front().high, 1.0F);
}

TEST(HorizonEngine, BoundsHoldTheEstimate) {
  RandomPlaces random;
  TownByHand town;
  add_random_boxes(random, 20, town);
  KnownTown known(town, SkyWeight::cosine);
  std::fill(known.map().low.begin(), known.map().low.end(), 0.2F);
  std::fill(known.map().estimate.begin(), known.map().estimate.end(), 0.5F);
  std::fill(known.map().high.begin(), known.map().high.end(), 0.9F);
  const std::vector<Receiver> receivers = receivers_in_a_square(random, up);
  constexpr std::size_t many_azimuths = 8192;
  const AzimuthSampling fine = AzimuthSampling::even(many_azimuths, {});
  std::vector<SvfInterval> bounded(receivers.size()), plain(receivers.size());
  known.evaluate_with_bounds(receivers, bounded);
  known.evaluate(receivers, plain);
  for (const Receiver& r : receivers) {
    const SvfInterval& interval = bounded[r.index];
    EXPECT_EQ(interval.estimate, plain[r.index].estimate);
    const auto sky_above = [&](double residual, const AzimuthSampling& ring) {
      return expected_sky(SkyWeight::cosine, up, ring, [&](std::size_t k) {
        const Point2d u{ring.cosine()[k], ring.sine()[k]};
        return std::max(residual, expected_horizon(town.grounded(), r.p_cell, u).high);
      });
    };
    // Where an edge ends within rounding of an azimuth, that azimuth's share may differ
    EXPECT_NEAR(interval.estimate, sky_above(0.5F, known.ring()), sky_rounding(azimuths, up) + 1.0 / azimuths);
    // Bounds are those of the whole turn, of which sixteen jumps between many azimuths are known to half of one
    const double between = 16.0 * 0.5 / static_cast<double>(many_azimuths), wedges = 0.006;
    EXPECT_GE(interval.high, sky_above(0.2F, fine) - between);
    EXPECT_LE(interval.high, sky_above(0.2F, fine) + between + wedges);
    EXPECT_LE(interval.low, sky_above(0.9F, fine) + between);
    EXPECT_GE(interval.low, sky_above(0.9F, fine) - between - wedges);
    EXPECT_LT(interval.low, interval.estimate);
    EXPECT_LT(interval.estimate, interval.high);
  }
}

/// Houses in the east, and a slab behind them that those who stand near to the row do not see.
TownByHand slab_behind_houses() {
  TownByHand town;
  town.add_box({22.0, -60.0}, {4.0, 140.0}, 12.0);
  town.add_slab({40.0, 5.0}, {5.0, 9.0}, 22.0);
  return town;
}

TEST(HorizonEngine, LittleSkyInGapsIsEstimatedWithinTheTolerance) {
  const TownByHand town = slab_behind_houses();
  constexpr float tolerance = 5e-5F;
  KnownTown known(town, SkyWeight::cosine, 0.0F, JumpPlaces::at_edge_ends),
      lax(town, SkyWeight::cosine, tolerance, JumpPlaces::at_edge_ends);
  const std::vector<Receiver> receivers = dense_receivers(up);
  std::vector<SvfInterval> exact(receivers.size()), estimated(receivers.size());
  known.evaluate(receivers, exact);
  lax.evaluate(receivers, estimated);
  const std::vector<SvfInterval> gaps = known.drawn(receivers);
  int small = 0, large = 0;
  for (std::size_t n = 0; n < receivers.size(); ++n) {
    const float width = gaps[n].high - gaps[n].low;
    if (width > tolerance * gaps[n].low) {
      EXPECT_EQ(estimated[n].estimate, exact[n].estimate) << n;
      ++large;
    } else {
      EXPECT_NEAR(estimated[n].estimate, gaps[n].low + 0.3F * width, sky_rounding(azimuths, up)) << n;
      small += width > 0.0F ? 1 : 0;
    }
  }
  EXPECT_GT(std::min(small, large), 10) << "too few to tell";
}

TEST(HorizonEngine, ASlabRightOverheadHidesAllThatIsAboveItsBorders) {
  TownByHand town;
  town.add_slab({5.0, 5.0}, {4.0, 4.0}, 6.0);
  // Walls all around so near and high that no border shows over them
  town.add_box({3.0, 3.0}, {0.5, 8.0}, 60.0);
  town.add_box({10.5, 3.0}, {0.5, 8.0}, 60.0);
  town.add_box({3.0, 10.5}, {8.0, 0.5}, 60.0);
  town.add_box({3.0, 3.0}, {8.0, 0.5}, 60.0);
  KnownTown known(town, SkyWeight::cosine);
  const std::vector<Receiver> receivers{{0, {7.0F, 7.0F, 1.5F}}, {1, {15.0F, 15.0F, 1.5F}}};
  std::vector<SvfInterval> intervals(2);
  for (const bool wants_bounds : {false, true}) {
    EXPECT_TRUE((wants_bounds ? known.evaluate_with_bounds(receivers, intervals) : known.evaluate(receivers, intervals)).empty());
    // What is left above a horizon that stands for the zenith is less than 1e-12
    for (const float sky : {intervals[0].low, intervals[0].estimate}) EXPECT_NEAR(sky, 0.0F, 1e-12F);
    // Between two azimuths, at corners of the walls, a border that is no higher than both horizons may show sky
    constexpr double corners = 1e-5;
    EXPECT_LE(intervals[0].high, wants_bounds ? static_cast<float>(rounding_of_bounds + corners) : 1e-12F);
    EXPECT_GT(intervals[1].estimate, 0.1F);
  }
}

TEST(HorizonEngine, ResidualOverhangsLeaveTheSkyBelowThemOpen) {
  // All around, something residual surely rises to 0.8, and may be open below 0.3
  const TownByHand nothing;
  KnownTown known(nothing, SkyWeight::cosine);
  std::fill(known.map().low.begin(), known.map().low.end(), 0.8F);
  std::fill(known.map().estimate.begin(), known.map().estimate.end(), 0.8F);
  std::fill(known.map().high.begin(), known.map().high.end(), 0.8F);
  std::fill(known.map().overhang.begin(), known.map().overhang.end(), 0.3F);
  KnownTown reread(nothing, SkyWeight::cosine, known.map());
  const std::vector<Receiver> receiver{{0, {3.0F, 3.0F, 1.5F}}};
  std::vector<SvfInterval> interval(1);
  EXPECT_TRUE(reread.evaluate_with_bounds(receiver, interval).empty()) << "no ray could tell";
  const double above = 1.0 / (1.0 + 0.8 * 0.8), below = 1.0 - 1.0 / (1.0 + 0.3 * 0.3), rounding = sky_rounding(azimuths, up);
  EXPECT_NEAR(interval[0].low, above - rounding_of_bounds, rounding);
  EXPECT_NEAR(interval[0].estimate, above, rounding);
  EXPECT_NEAR(interval[0].high, above + below + rounding_of_bounds, rounding);
}

}  // namespace
}  // namespace farlod
