// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/light_kernels.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "base/frame.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/kernels.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"
#include "radiation/light_table.hpp"

namespace farlod {
namespace {

using Rows = std::vector<PacketHorizon::Row>;

constexpr std::size_t azimuth_count = 48;

/// A light of two months, of which one is cloudy: six layers.
Light two_months() {
  LightInterval clear{{{Angle::degrees(140.0), Angle::degrees(35.0), 1.0}}, 1.0};
  clear.direct_normal_w_m2 = 700.0;
  clear.diffuse_w_m2 = 120.0;
  clear.month = 6;
  LightInterval cloudy{{{Angle::degrees(220.0), Angle::degrees(20.0), 1.0}}, 1.0};
  cloudy.direct_normal_w_m2 = 50.0;
  cloudy.diffuse_w_m2 = 200.0;
  cloudy.month = 1;
  Light light{{clear, cloudy}};
  light.by_month = true;
  return light;
}

/// What is summed up, and a scene of it.
struct Packet {
  AzimuthSampling azimuths = AzimuthSampling::even(azimuth_count, GridRotation{});
  LightTable table{LightOfPeriod(two_months(), false), std::vector<double>(turns())};
  ReceiverPacket receivers;
  Rows sky_from = Rows(azimuth_count), gap_from, gap_to, gap_share, sky;

  static std::vector<double> turns() {
    std::vector<double> result;
    for (std::size_t k = 0; k < azimuth_count; ++k)
      result.push_back((static_cast<double>(k) + 0.5) / static_cast<double>(azimuth_count));
    return result;
  }
  [[nodiscard]] Rows sums_by(const LightKernels& kernels) const {
    const auto data_of = [](const Rows& rows) { return rows.empty() ? nullptr : rows.front().data(); };
    Rows sums(table.layers());
    const LitPacket packet{&receivers,        receivers.all_look_straight_up(),
                           data_of(sky_from), data_of(gap_from),
                           data_of(gap_to),   data_of(gap_share),
                           data_of(sky),      sums.front().data()};
    kernels.sum_light({table.even(), table.pairs(), static_cast<std::uint32_t>(table.pair_count()), true, azimuths.view()},
                      {&packet, 1});
    return sums;
  }
  /// The light of a layer between two slopes of an azimuth, in steps of a hundredth of the way between the knots of the table.
  [[nodiscard]] std::vector<double> between(std::size_t azimuth, std::size_t lane, float from, float to) const {
    const float o = receivers.normal_x[lane] * azimuths.cosine()[azimuth] + receivers.normal_y[lane] * azimuths.sine()[azimuth],
                w = receivers.normal_z[lane];
    std::vector<double> light(table.layers());
    constexpr int steps = 4000;
    const double low = std::atan(from), high = std::atan(to);
    const auto angle = [&](int n) { return low + (high - low) * n / steps; };
    for (int n = 0; n < steps; ++n) {
      const double middle = 0.5 * (angle(n) + angle(n + 1));
      if (!(o * std::cos(middle) + w * std::sin(middle) > 0.0)) continue;
      std::array<LightPair, LightTable::most_pairs> sums{};
      table.add_above(azimuth, LightTable::place_of(static_cast<float>(std::tan(angle(n)))), o, w, sums.data());
      table.add_above(azimuth, LightTable::place_of(static_cast<float>(std::tan(angle(n + 1)))), -o, -w, sums.data());
      for (std::size_t layer = 0; layer < light.size(); ++layer) light[layer] += light_of_layer(sums.data(), layer);
    }
    return light;
  }
};

constexpr float infinite = std::numeric_limits<float>::infinity();

void set(ReceiverPacket& receivers, float tilt_deg, float azimuth_deg) {
  const Angle tilt = Angle::degrees(tilt_deg), azimuth = Angle::degrees(azimuth_deg);
  Receiver receiver;
  receiver.normal = {static_cast<float>(sin(tilt) * cos(azimuth)), static_cast<float>(sin(tilt) * sin(azimuth)),
                     static_cast<float>(cos(tilt))};
  receivers.add(receiver);
}

/// Horizons at random, some without a sky above them, and gaps below.
Packet random_packet(float tilt_deg, bool with_gaps) {
  Packet packet;
  for (int l = 0; l < 16; ++l) set(packet.receivers, tilt_deg, 23.0F * static_cast<float>(l));
  std::mt19937 random(7);
  std::uniform_real_distribution<float> slope(0.0F, 3.0F), share(0.0F, 1.0F);
  if (with_gaps)
    for (Rows* rows : {&packet.gap_from, &packet.gap_to, &packet.gap_share}) rows->resize(azimuth_count);
  for (std::size_t k = 0; k < azimuth_count; ++k)
    for (std::size_t l = 0; l < packet_lanes; ++l) {
      packet.sky_from[k][l] = share(random) < 0.1F ? infinite : slope(random);
      if (!with_gaps || share(random) < 0.5F) continue;
      packet.gap_from[k][l] = 0.1F * slope(random);
      packet.gap_to[k][l] = packet.gap_from[k][l] + slope(random);
      packet.gap_share[k][l] = share(random);
    }
  return packet;
}

void expect_steps(const Packet& packet) {
  const Rows sums = packet.sums_by(light_kernels());
  for (std::size_t l = 0; l < packet_lanes; l += 5) {
    std::vector<double> expected(packet.table.layers());
    const auto add = [&](const std::vector<double>& light, double share) {
      for (std::size_t n = 0; n < expected.size(); ++n) expected[n] += share * light[n];
    };
    for (std::size_t k = 0; k < azimuth_count; ++k) {
      if (packet.sky_from[k][l] < infinite) add(packet.between(k, l, packet.sky_from[k][l], 1e6F), 1.0);
      if (!packet.gap_share.empty() && packet.gap_share[k][l] > 0.0F)
        add(packet.between(k, l, packet.gap_from[k][l], packet.gap_to[k][l]), packet.gap_share[k][l]);
    }
    for (std::size_t n = 0; n < expected.size(); ++n)
      EXPECT_NEAR(sums[n][l], expected[n], 2e-4 * packet.table.on_level()[n] + 1e-6) << "layer " << n << ", receiver " << l;
  }
}

TEST(LightKernels, SumWhatIsAboveHorizonsInFrontOfReceivers) {
  for (const float tilt_deg : {0.0F, 30.0F, 90.0F, 130.0F}) expect_steps(random_packet(tilt_deg, false));
}

TEST(LightKernels, SumGapsBelowOverhangsByTheirShares) {
  for (const float tilt_deg : {0.0F, 90.0F, 130.0F}) expect_steps(random_packet(tilt_deg, true));
}

TEST(LightKernels, OfAllTargetsGiveTheSameBits) {
  for (const float tilt_deg : {0.0F, 40.0F, 130.0F}) {
    Packet packet = random_packet(tilt_deg, true);
    packet.sky.resize(azimuth_count);
    for (std::size_t k = 0; k < azimuth_count; ++k) packet.sky[k].fill(0.02F * static_cast<float>(k));
    const Rows expected = packet.sums_by(*runnable_kernels().back().light);
    for (const KernelTarget& target : runnable_kernels()) EXPECT_EQ(packet.sums_by(*target.light), expected) << target.name;
  }
}

/// A wall of 45° stands at half of the azimuths; of the two azimuths beside its ends, the sky says how far it goes on.
TEST(LightKernels, MoveJumpsToWhereTheSkySaysThatTheyAre) {
  Packet packet;
  set(packet.receivers, 0.0F, 0.0F);
  packet.sky.resize(azimuth_count);
  constexpr std::size_t half = azimuth_count / 2;
  for (std::size_t k = 0; k < azimuth_count; ++k) {
    packet.sky_from[k].fill(k < half ? 1.0F : 0.0F);
    packet.sky[k].fill(k < half ? 0.5F : 1.0F);
  }
  // A quarter of the last azimuth behind the wall sees over it; the wall goes on through two fifths of the last one beside it
  packet.sky[half - 1].fill(0.5F + 0.25F * 0.5F);
  packet.sky[azimuth_count - 1].fill(1.0F - 0.4F * 0.5F);
  const Rows sums = packet.sums_by(light_kernels());
  std::vector<double> expected(packet.table.layers());
  for (std::size_t k = 0; k < azimuth_count; ++k) {
    const double walled = k == half - 1 ? 0.75 : k + 1 == azimuth_count ? 0.4 : k < half ? 1.0 : 0.0;
    const std::vector<double> over = packet.between(k, 0, 1.0F, 1e6F), all = packet.between(k, 0, 0.0F, 1e6F);
    for (std::size_t n = 0; n < expected.size(); ++n) expected[n] += walled * over[n] + (1.0 - walled) * all[n];
  }
  for (std::size_t n = 0; n < expected.size(); ++n)
    EXPECT_NEAR(sums[n][0], expected[n], 2e-4 * packet.table.on_level()[n] + 1e-6) << n;
}

}  // namespace
}  // namespace farlod
