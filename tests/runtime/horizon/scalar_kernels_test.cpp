// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/runtime/horizon/scalar_kernels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "farlod/angle.hpp"
#include "horizon/drawn_edges.hpp"
#include "horizon/kernels.hpp"
#include "horizon/packet_horizon.hpp"
#include "tests/runtime/horizon/kernel_targets.hpp"
#include "tests/runtime/horizon/random_places.hpp"

// The kernels of each target that this processor runs against scalar code, bit for bit.

namespace farlod {
namespace {

using KernelRow = PacketHorizon::Row;
using Rows = std::vector<KernelRow>;  ///< rows[azimuth][receiver]
using Numbers = std::vector<std::array<std::int32_t, ReceiverPacket::lanes>>;
constexpr std::size_t lanes = ReceiverPacket::lanes;

float* data(Rows& rows) { return rows.front().data(); }
const float* data(const Rows& rows) { return rows.front().data(); }

class ScalarKernels : public testing::TestWithParam<KernelTarget> {
 protected:
  [[nodiscard]] static const EdgeKernels& edge() { return *GetParam().edge; }
  [[nodiscard]] static const SkyKernels& sky() { return *GetParam().sky; }

  [[nodiscard]] scalar::Azimuth azimuth(std::size_t k) const { return {azimuths_.cosine()[k], azimuths_.sine()[k]}; }
  /// Level, low and steep ones, and some up to the zenith.
  [[nodiscard]] Rows random_slopes() {
    Rows rows(azimuths_.size());
    for (KernelRow& row : rows)
      for (float& slope : row) {
        const float kind = random_.between(0.0, 1.0);
        slope = kind < 0.2F ? 0.0F : kind > 0.97F ? scalar::infinity : random_.between(0.0, kind < 0.6F ? 0.3 : 30.0);
      }
    return rows;
  }
  /// Sixteen receivers in a square of this width, on several floors.
  [[nodiscard]] ReceiverPacket random_packet(double width_m) {
    const Point3f low = random_.place(30.0, 0.0, 8.0);
    std::vector<Point3f> places;
    for (std::size_t n = 0; n < lanes; ++n)
      places.push_back({low.x + random_.between(0.0, width_m), low.y + random_.between(0.0, width_m),
                        low.z + 3.0F * static_cast<float>(n % 3)});
    return packet_of(places);
  }
  /// Edges around, across and right above the receivers. Facets are walls on both sides, so that every edge faces everywhere.
  [[nodiscard]] std::vector<HorizonEdge> random_edges(EdgeRole role, const ReceiverPacket& packet, int of_each_reach = 12) {
    const std::int8_t wall = role == EdgeRole::underside ? AdjacentSlopes::straight_up : AdjacentSlopes::straight_down;
    std::vector<HorizonEdge> edges;
    for (const double reach_m : {15.0, 60.0, 400.0})
      for (int n = 0; n < of_each_reach; ++n) edges.push_back(random_.edge(reach_m, -5.0, 40.0));
    for (std::size_t l = 0; l < 4; ++l) {
      const Point3f along = random_.direction_at(0.0);
      const auto on_line = [&](float s) { return Point3f{packet.x[l] + s * along.x, packet.y[l] + s * along.y, 25.0F}; };
      edges.push_back({on_line(-5.0F), on_line(4.0F)});   // right above
      edges.push_back({on_line(0.3F), on_line(9.0F)});    // end-on
      edges.push_back({on_line(60.0F), on_line(90.0F)});  // end-on, clear of the packet
    }
    for (HorizonEdge& e : edges) {
      e.role = role;
      e.adjacent = {wall, wall};
    }
    return edges;
  }
  static SilhouetteEdges silhouettes(EdgeRole role, const std::vector<HorizonEdge>& edges) {
    SilhouetteEdges result(role);
    for (const HorizonEdge& e : edges) result.add(e);
    return result;
  }
  static Point3f place(const ReceiverPacket& r, std::size_t l) { return {r.x[l], r.y[l], r.z[l]}; }
  static Point3f normal(const ReceiverPacket& r, std::size_t l) { return {r.normal_x[l], r.normal_y[l], r.normal_z[l]}; }

  RandomPlaces random_;
  const AzimuthSampling azimuths_ = AzimuthSampling::even(96, GridRotation(Angle::degrees(20.0)));
};

TEST_P(ScalarKernels, HorizonsRaisedToEdges) {
  std::size_t raised = 0;
  for (int n = 0; n < 60; ++n)
    for (const EdgeRole role : {EdgeRole::grounded, EdgeRole::underside}) {
      const ReceiverPacket packet = random_packet(n % 2 == 0 ? 4.0 : 25.0);
      const PacketBounds bounds = bounds_of(packet);
      const std::vector<HorizonEdge> edges = random_edges(role, packet);
      const SilhouetteEdges silhouettes_of_role = silhouettes(role, edges);
      Rows slopes(azimuths_.size()), unnumbered = slopes;
      Numbers numbers(azimuths_.size());
      const auto raise = [&](Rows& raised_slopes, std::int32_t* edge_numbers) {
        DrawnEdges drawn;
        (void)edge().raise_to_edges(
            {silhouettes_of_role.batches(), role}, packet, bounds, azimuths_.view(), Culling::nothing_drawn,
            {data(raised_slopes), edge_numbers, drawn.room_for(silhouettes_of_role.batches().size() * lanes)});
      };
      raise(slopes, numbers.front().data());
      raise(unnumbered, nullptr);
      EXPECT_EQ(unnumbered, slopes);
      for (std::size_t k = 0; k < azimuths_.size(); ++k)
        for (std::size_t l = 0; l < lanes; ++l) {
          EXPECT_EQ(slopes[k][l], scalar::raised(0.0F, edges, place(packet, l), bounds, azimuth(k)))
              << n << ", " << k << ", " << l;
          // The number is that of the first edge with this slope
          const auto sees = [&](const HorizonEdge& e) {
            return scalar::raised(0.0F, {&e, 1}, place(packet, l), bounds, azimuth(k)) == slopes[k][l];
          };
          if (slopes[k][l] > 0.0F) {
            EXPECT_EQ(numbers[k][l], std::find_if(edges.begin(), edges.end(), sees) - edges.begin());
          }
          raised += slopes[k][l] > 0.0F ? 1 : 0;
        }
    }
  EXPECT_GT(raised, 100'000U);
}

/// So many edges that minima are renewed several times, from far to near, so that the last ones still rise above the horizon.
TEST_P(ScalarKernels, HorizonsDoNotDependOnCulling) {
  for (int n = 0; n < 6; ++n) {
    const ReceiverPacket packet = random_packet(4.0);
    const PacketBounds bounds = bounds_of(packet);
    std::vector<HorizonEdge> edges = random_edges(EdgeRole::grounded, packet, 200);
    std::reverse(edges.begin(), edges.end());
    const SilhouetteEdges grounded = silhouettes(EdgeRole::grounded, edges);
    Rows wanted(azimuths_.size());
    for (std::size_t k = 0; k < azimuths_.size(); ++k)
      for (std::size_t l = 0; l < lanes; ++l) wanted[k][l] = scalar::raised(0.0F, edges, place(packet, l), bounds, azimuth(k));
    for (const Culling culling : {Culling::nothing_drawn, Culling::mostly_drawn, Culling::mostly_seen}) {
      Rows slopes(azimuths_.size());
      (void)edge().raise_to_edges({grounded.batches(), EdgeRole::grounded}, packet, bounds, azimuths_.view(), culling,
                                  {data(slopes)});
      EXPECT_EQ(slopes, wanted) << n << ", " << static_cast<int>(culling);
    }
  }
}

/// Facets beside a lower border may face some receivers of a packet, and not others.
TEST_P(ScalarKernels, LowerBordersOfAReceiverDoNotDependOnTheOthers) {
  std::size_t raised = 0, higher_for_others = 0;
  for (int n = 0; n < 30; ++n) {
    const ReceiverPacket packet = random_packet(25.0);
    std::vector<HorizonEdge> edges = random_edges(EdgeRole::underside, packet);
    const auto rise = [this] { return static_cast<std::int8_t>(random_.between(-127.0, 128.0)); };
    for (HorizonEdge& e : edges) e.adjacent = {rise(), rise()};
    const SilhouetteEdges undersides = silhouettes(EdgeRole::underside, edges);
    const auto drawn = [&](const ReceiverPacket& receivers) {
      Rows slopes(azimuths_.size());
      (void)edge().raise_to_edges({undersides.batches(), EdgeRole::underside}, receivers, bounds_of(receivers), azimuths_.view(),
                                  Culling::nothing_drawn, {data(slopes)});
      return slopes;
    };
    const Rows together = drawn(packet);
    for (std::size_t l = 0; l < lanes; ++l) {
      const Rows alone = drawn(packet_of(std::array{place(packet, l)}));
      for (std::size_t k = 0; k < azimuths_.size(); ++k) {
        EXPECT_FLOAT_EQ(together[k][l], alone[k][0]) << n << ", " << k << ", " << l;
        raised += alone[k][0] > 0.0F ? 1 : 0;
        higher_for_others += scalar::raised(0.0F, edges, place(packet, l), bounds_of(packet), azimuth(k)) > alone[k][0] ? 1 : 0;
      }
    }
  }
  EXPECT_GT(std::min(raised, higher_for_others), 5'000U) << "too few to tell";
}

TEST_P(ScalarKernels, HorizonsLoweredToEdgesAboveAMinimum) {
  std::size_t lowered = 0;
  for (int n = 0; n < 60; ++n) {
    const ReceiverPacket packet = random_packet(n % 2 == 0 ? 4.0 : 25.0);
    const PacketBounds bounds = bounds_of(packet);
    const std::vector<HorizonEdge> edges = random_edges(EdgeRole::underside, packet);
    const SilhouetteEdges silhouettes_of_role = silhouettes(EdgeRole::underside, edges);
    Rows min_slopes = random_slopes(), slopes(azimuths_.size());
    for (KernelRow& row : slopes) row.fill(scalar::infinity);
    edge().lower_to_edges({silhouettes_of_role.batches(), EdgeRole::underside}, packet, bounds, azimuths_.view(),
                          data(min_slopes), data(slopes));
    for (std::size_t k = 0; k < azimuths_.size(); ++k)
      for (std::size_t l = 0; l < lanes; ++l) {
        EXPECT_EQ(slopes[k][l], scalar::lowered(scalar::infinity, min_slopes[k][l], edges, place(packet, l), bounds, azimuth(k)))
            << n << ", " << k << ", " << l;
        lowered += slopes[k][l] < scalar::infinity ? 1 : 0;
      }
  }
  EXPECT_GT(lowered, 10'000U);
}

/// Normals that point up, up a little aside, along a roof, along a wall, slightly and steeply downward.
std::vector<std::vector<Point3f>> sets_of_normals(RandomPlaces& random) {
  std::vector<Point3f> any{
      {0.0F, 0.0F, 1.0F}, {0.0F, 0.0F, -1.0F}, {0.0F, -1.0F, 0.0F}, {-0.6F, 0.0F, 0.8F}, {0.0F, 0.8F, -0.6F}};
  for (const double z : {0.999, 0.9, 0.5, 0.1, 0.01, 0.0, -0.01, -0.3, -0.9, -0.999, 0.3}) any.push_back(random.direction_at(z));
  std::vector<Point3f> level;
  for (std::size_t l = 0; l < lanes; ++l) level.push_back(random.direction_at(0.0));
  return {any, level, std::vector<Point3f>(lanes, {0.0F, 0.0F, 1.0F})};
}

ReceiverPacket packet_with(const std::vector<Point3f>& normals) {
  ReceiverPacket packet;
  for (const Point3f& n : normals) packet.add({0, {}, n});
  return packet;
}

TEST_P(ScalarKernels, SkyAboveHorizons) {
  const std::vector<std::vector<Point3f>> normals = sets_of_normals(random_);
  for (std::size_t set = 0; set < normals.size(); ++set) {
    const ReceiverPacket packet = packet_with(normals[set]);
    const Rows slopes = random_slopes();
    PacketHorizon::Lanes cosine, special, solid;
    Rows terms(azimuths_.size()), special_terms = terms;
    sky().sum_cosine(data(slopes), packet, azimuths_.view(), cosine.data(), data(terms));
    sky().sum_solid_angle(data(slopes), packet, azimuths_.view(), solid.data(), nullptr);
    // The kernels of some normals leave out terms that are 0: for straight up, they leave 1 / (1 + t²)
    if (set == 1) sky().sum_cosine_level(data(slopes), packet, azimuths_.view(), special.data(), data(special_terms));
    if (set == 2) sky().sum_cosine_up(data(slopes), azimuths_.size(), special.data(), data(special_terms));
    for (std::size_t l = 0; l < lanes; ++l) {
      float cosine_sum = 0.0F, special_sum = 0.0F, solid_sum = 0.0F;
      for (std::size_t k = 0; k < azimuths_.size(); ++k) {
        const float t = slopes[k][l];
        const Point3f n = normal(packet, l);
        EXPECT_EQ(terms[k][l], scalar::sky_of_azimuth(SkyWeight::cosine, t, n, azimuth(k)));
        cosine_sum += terms[k][l];
        solid_sum += scalar::sky_of_azimuth(SkyWeight::solid_angle, t, n, azimuth(k));
        const float outward = scalar::max(n.x * azimuth(k).x + n.y * azimuth(k).y, 0.0F);
        const float special_term = set == 1 ? scalar::cosine_above(scalar::min(t, 1e6F), outward, 0.0F) : 1.0F / (1.0F + t * t);
        if (set > 0) {
          EXPECT_EQ(special_terms[k][l], special_term);
        }
        special_sum += special_term;
      }
      EXPECT_EQ(cosine[l], cosine_sum) << set << ", " << l;
      EXPECT_EQ(solid[l], solid_sum) << set << ", " << l;
      if (set > 0) {
        EXPECT_EQ(special[l], special_sum) << set << ", " << l;
      }
    }
  }
}

TEST_P(ScalarKernels, SkyBetweenHorizons) {
  for (const std::vector<Point3f>& normals : sets_of_normals(random_))
    for (const SkyWeight weight : {SkyWeight::cosine, SkyWeight::solid_angle}) {
      const ReceiverPacket packet = packet_with(normals);
      Rows low = random_slopes(), high = low, rows(azimuths_.size());
      for (std::size_t k = 0; k < high.size(); k += 2)
        for (float& slope : high[k]) slope += random_.between(0.0, 2.0);
      for (Rows* finite : {&low, &high})
        for (KernelRow& row : *finite)
          for (float& slope : row) slope = std::min(slope, 1e9F);
      sky().find_sky_between(data(low), data(high), packet, azimuths_.view(), weight == SkyWeight::solid_angle, data(rows));
      for (std::size_t k = 0; k < rows.size(); ++k)
        for (std::size_t l = 0; l < lanes; ++l) {
          const float sky = scalar::sky_above(weight, low[k][l], normal(packet, l), azimuth(k)) -
                            scalar::sky_above(weight, high[k][l], normal(packet, l), azimuth(k));
          EXPECT_EQ(rows[k][l], scalar::max(sky, 0.0F) * (1.0F / static_cast<float>(azimuths_.size()))) << k << ", " << l;
        }
    }
}

TEST_P(ScalarKernels, HorizonsAgainstHorizons) {
  const Rows before = random_slopes(), a = random_slopes(), b = random_slopes();
  Rows lower = before, higher = before, replaced = before, joined = before;
  const std::size_t count = azimuths_.size();
  sky().lower(data(a), count, data(lower));
  sky().raise(data(a), count, data(higher));
  sky().replace_infinite(data(a), count, data(replaced));
  sky().join(data(a), data(b), count, data(joined));
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t l = 0; l < lanes; ++l) {
      const float t = before[k][l];
      EXPECT_EQ(lower[k][l], std::min(t, a[k][l]));
      EXPECT_EQ(higher[k][l], std::max(t, a[k][l]));
      EXPECT_EQ(replaced[k][l], t < scalar::infinity ? t : a[k][l]);
      EXPECT_EQ(joined[k][l], a[k][l] <= t ? std::max(t, b[k][l]) : t);
    }
}

TEST_P(ScalarKernels, DifferencesAndCounts) {
  Rows a = random_slopes(), b = random_slopes();
  // A difference of two infinite slopes is no number
  for (Rows* finite : {&a, &b})
    for (KernelRow& row : *finite)
      for (float& slope : row) slope = std::min(slope, 1e9F);
  // The first receiver's horizon is far below the other one; a ray along a horizon is not above it
  std::vector<float> ray_slopes;
  for (std::size_t k = 0; k < azimuths_.size(); ++k) {
    b[k][0] = a[k][0] + 2.0F;
    ray_slopes.push_back(a[k][k % lanes]);
  }
  PacketHorizon::Lanes differences, counts;
  sky().find_max_difference(data(a), data(b), azimuths_.size(), differences.data());
  sky().count_above(data(a), ray_slopes.data(), azimuths_.size(), counts.data());
  for (std::size_t l = 0; l < lanes; ++l) {
    float difference = -1.0F;
    std::size_t count = 0;
    for (std::size_t k = 0; k < azimuths_.size(); ++k) {
      difference = std::max(difference, a[k][l] - b[k][l]);
      count += a[k][l] < ray_slopes[k] ? 1 : 0;
    }
    EXPECT_EQ(differences[l], difference);
    EXPECT_EQ(counts[l], static_cast<float>(count));
  }
}

TEST_P(ScalarKernels, HorizonsRaisedToBinsOfAFarMap) {
  std::vector<float> here, above, lower, upper;
  for (int n = 0; n < 8; ++n) {
    here.push_back(random_.between(0.0, 2.0));
    above.push_back(random_.between(0.0, 2.0));
    lower.push_back(random_.between(0.0, 1.0));
    upper.push_back(lower.back() + random_.between(0.0, 1.0));
  }
  std::vector<std::uint32_t> bins;
  for (std::uint32_t k = 0; k < azimuths_.size(); ++k) bins.push_back(k * 8 / static_cast<std::uint32_t>(azimuths_.size()));
  ResidualRows rows{here, above, lower, upper, {}, {}};
  for (std::size_t l = 0; l < lanes; ++l) {
    rows.shares[l] = random_.between(0.0, 1.0);
    rows.caps[l] = l % 3 == 0 ? 0.0F : scalar::infinity;
  }
  const Rows before = random_slopes();
  Rows of_row = before, between = before;
  sky().raise_to_row(here.data(), rows.caps.data(), bins.data(), bins.size(), data(of_row));
  sky().raise_between_rows(rows, bins.data(), bins.size(), data(between), nullptr);
  Rows numbered = before;
  Numbers numbers(azimuths_.size());
  for (auto& row : numbers) row.fill(7);
  sky().raise_between_rows(rows, bins.data(), bins.size(), data(numbered), numbers.front().data());
  EXPECT_EQ(numbered, between);
  for (std::size_t k = 0; k < bins.size(); ++k)
    for (std::size_t l = 0; l < lanes; ++l) {
      const std::uint32_t bin = bins[k];
      const float estimate = here[bin] + rows.shares[l] * (above[bin] - here[bin]);
      EXPECT_EQ(of_row[k][l], std::max(before[k][l], std::min(here[bin], rows.caps[l])));
      EXPECT_EQ(between[k][l], std::max(before[k][l], std::min(std::clamp(estimate, lower[bin], upper[bin]), rows.caps[l])));
      EXPECT_EQ(numbers[k][l], between[k][l] > before[k][l] || (before[k][l] == 0.0F && between[k][l] == 0.0F) ? -1 : 7);
    }
}

TEST_P(ScalarKernels, JumpsOfTheSky) {
  constexpr float least = 0.4F;
  Rows sky_of_azimuths = random_slopes();
  Numbers numbers(azimuths_.size());
  for (auto& row : numbers)
    for (std::int32_t& number : row) number = random_.between(0.0, 1.0) < 0.5F ? 1 : 2;
  std::vector<SkyJump> jumps(azimuths_.size());
  jumps.resize(sky().find_jumps(data(sky_of_azimuths), numbers.front().data(), azimuths_.size(), least, jumps.data()));
  std::size_t found = 0;
  for (std::uint32_t k = 0; k < azimuths_.size(); ++k) {
    const std::size_t next = (k + 1) % azimuths_.size();
    std::uint32_t expected = 0;
    for (std::size_t l = 0; l < lanes; ++l)
      if (std::abs(sky_of_azimuths[k][l] - sky_of_azimuths[next][l]) > least && numbers[k][l] != numbers[next][l])
        expected |= 1U << l;
    if (expected == 0) continue;
    ASSERT_LT(found, jumps.size());
    EXPECT_EQ(jumps[found].azimuth, k);
    EXPECT_EQ(jumps[found].receivers, expected);
    ++found;
  }
  EXPECT_EQ(found, jumps.size());
  EXPECT_GT(found, 0U);
}

INSTANTIATE_TEST_SUITE_P(Targets, ScalarKernels, testing::ValuesIn(kernel_targets()), name_of_target);

}  // namespace
}  // namespace farlod
