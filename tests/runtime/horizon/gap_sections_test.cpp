// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/gap_sections.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "farlod/point.hpp"
#include "horizon/gap_kernels.hpp"
#include "horizon/kernels.hpp"
#include "horizon/receiver_packet.hpp"
#include "tests/runtime/horizon/horizon_oracle.hpp"
#include "tests/runtime/horizon/random_places.hpp"

namespace farlod {
namespace {

constexpr std::size_t azimuths = 96;
constexpr std::uint32_t all_receivers = 0xFFFF;
constexpr double infinite = std::numeric_limits<double>::infinity();
using Corners = OverhangFacets::Corners;
using SlopesHidden = std::pair<double, double>;

/// The slopes that a triangle hides at an azimuth, in double: its edges are cut by the vertical plane of the azimuth one by one.
std::optional<SlopesHidden> judged_section(const Corners& t, const Point3f& eye, Point2d u) {
  std::vector<Point2d> cuts;  // ahead, up
  const auto seen = [&](const Point3f& p) {
    const double x = double{p.x} - double{eye.x}, y = double{p.y} - double{eye.y};
    return Point3d{x * u.y - y * u.x, x * u.x + y * u.y, double{p.z} - double{eye.z}};
  };
  for (std::size_t n = 0; n < 3; ++n) {
    const Point3d a = seen(t[n]), b = seen(t[(n + 1) % 3]);
    if ((a.x < 0.0) == (b.x < 0.0)) continue;
    const double share = a.x / (a.x - b.x);
    cuts.push_back({std::lerp(a.y, b.y, share), std::lerp(a.z, b.z, share)});
  }
  if (cuts.size() != 2) return std::nullopt;
  Point2d near = cuts[0], far = cuts[1];
  if (near.x > far.x) std::swap(near, far);
  if (far.x <= 0.0) return std::nullopt;
  const double far_slope = far.y / far.x;
  if (near.x > 0.0) return std::minmax(near.y / near.x, far_slope);
  const double over_eye = near.y - near.x * (far.y - near.y) / (far.x - near.x);
  return over_eye > 0.0 ? SlopesHidden{far_slope, infinite} : SlopesHidden{-infinite, far_slope};
}

/// The sky of an azimuth between two slopes that no interval hides, of a receiver that looks up.
double judged_sky(double from, double to, std::vector<SlopesHidden> hidden) {
  const auto above = [](double t) { return 1.0 / (1.0 + t * t); };
  std::sort(hidden.begin(), hidden.end());
  double sky = 0.0;
  for (const auto& [low, high] : hidden) {
    if (from >= to) break;
    if (low > from) sky += above(from) - above(std::min(low, to));
    from = std::max(from, high);
  }
  return from < to ? sky + above(from) - above(to) : sky;
}

/// Gaps between random horizons, and triangles that float around receivers and over some of them.
class GapsBelowTriangles : public testing::Test {
 protected:
  GapsBelowTriangles() {
    for (int n = 0; n < 400; ++n) {
      const Point3f middle{random_.between(-60.0, 60.0), random_.between(-60.0, 60.0), random_.between(2.0, 20.0)};
      Corners t;
      for (Point3f& p : t)
        p = {middle.x + random_.between(-8.0, 8.0), middle.y + random_.between(-8.0, 8.0), middle.z + random_.between(-3.0, 3.0)};
      triangles_.push_back(t);
      facets_.add(t);
    }
  }
  [[nodiscard]] ReceiverPacket receivers(Point2d low) {
    std::vector<Point3f> places;
    for (int n = 0; n < 16; ++n)
      places.push_back({random_.between(low.x, low.x + 8.0), random_.between(low.y, low.y + 8.0), random_.between(0.5, 3.0)});
    return packet_of(places, {0.0F, 0.0F, 1.0F});
  }
  void draw_gaps() {
    for (std::size_t n = 0; n < azimuths * packet_lanes; ++n) {
      const float from = random_.between(0.0, 0.4);
      from_.drawn_slopes()[n] = from;
      to_.drawn_slopes()[n] = n % 5 == 0 ? from : n % 7 == 0 ? std::numeric_limits<float>::infinity() : from + 0.9F;
      hidden_from_.drawn_slopes()[n] = from + 0.3F;
      hidden_to_.drawn_slopes()[n] = n % 3 == 0 ? from + 0.4F : from + 0.3F;
    }
  }
  [[nodiscard]] Gaps gaps(const ReceiverPacket& packet) {
    from_.find_sky_below(to_, SkyWeight::cosine, packet, sky_);
    return {from_, to_, hidden_from_, hidden_to_, sky_, all_receivers};
  }

  RandomPlaces random_;
  std::vector<Corners> triangles_;
  OverhangFacets facets_;
  const AzimuthSampling ring_ = AzimuthSampling::even(azimuths, {});
  PacketHorizon from_{ring_}, to_{ring_}, hidden_from_{ring_}, hidden_to_{ring_};
  std::vector<PacketHorizon::Row> sky_;
};

TEST_F(GapsBelowTriangles, ShowWhatNoTriangleHides) {
  GapSections sections(ring_);
  int open = 0, split = 0;
  for (int turn = 0; turn < 20; ++turn) {
    const ReceiverPacket packet = receivers({random_.between(-30.0, 30.0), random_.between(-30.0, 30.0)});
    draw_gaps();
    std::map<std::pair<std::size_t, std::size_t>, OpenGap> found;
    for (const OpenGap& gap : sections.find_any_open(facets_, gaps(packet), SkyWeight::cosine, packet))
      EXPECT_TRUE(found.insert({{gap.azimuth, gap.lane}, gap}).second);
    for (std::size_t k = 0; k < azimuths; ++k)
      for (std::size_t l = 0; l < packet_lanes; ++l) {
        std::vector<SlopesHidden> hidden{{hidden_from_.row(k)[l], hidden_to_.row(k)[l]}};
        for (const Corners& t : triangles_)
          if (const auto section =
                  judged_section(t, {packet.x[l], packet.y[l], packet.z[l]}, {ring_.cosine()[k], ring_.sine()[k]}))
            hidden.push_back(*section);
        const double expected = judged_sky(from_.row(k)[l], to_.row(k)[l], hidden);
        const auto it = found.find({k, l});
        // Ends that differ by a hundred-thousandth are one; the steepest place of 1 / (1 + t²) falls by .65 for each unit of t
        ASSERT_NEAR(it == found.end() ? 0.0F : it->second.sky, expected, 6e-5) << "azimuth " << k << ", receiver " << l;
        open += it == found.end() ? 0 : 1;
        split += it != found.end() && it->second.is_split ? 1 : 0;
      }
  }
  EXPECT_GT(std::min(open, split), 1000) << "too few to tell";
}

/// Where eyes stand at corners of facets, sections are no numbers: what is open to one eye depends on no other, and an end comes.
TEST(OpenGaps, OfEyesAtCornersOfFacets) {
  RandomPlaces random;
  const AzimuthSampling ring = AzimuthSampling::even(azimuths, {});
  const auto whole = [&](double low, double high) { return std::round(random.between(low, high)); };
  for (int turn = 0; turn < 200; ++turn) {
    OverhangFacets facets;
    for (int n = 0; n < 40; ++n) {
      Corners corners;
      for (Point3f& p : corners) p = {whole(-3.0, 3.0), whole(-3.0, 3.0), whole(0.0, 4.0)};
      facets.add(corners);
    }
    GapBlock block{};
    for (std::size_t l = 0; l < packet_lanes; ++l) {
      block.eyes.x[l] = whole(-3.0, 3.0), block.eyes.y[l] = whole(-3.0, 3.0), block.eyes.z[l] = whole(0.0, 4.0);
      block.eyes.normal_z[l] = 1.0F;
      block.eyes.cosine[l] = ring.cosine()[l / 4], block.eyes.sine[l] = ring.sine()[l / 4];
      block.to[l] = l % 2 == 0 ? std::numeric_limits<float>::infinity() : random.between(0.3, 3.0);
    }
    std::vector<PacketHorizon::Row> room(2 * (facets.size() + 1));
    const auto find = [&](GapBlock gaps) {
      gap_kernels().find_open({facets.batches(), facets.boxes()}, false, room.front().data(), gaps);
      return gaps;
    };
    const GapBlock together = find(block);
    for (std::size_t l = 0; l < packet_lanes; ++l) {
      GapBlock alone = block;
      for (std::size_t other = 0; other < packet_lanes; ++other) alone.to[other] = other == l ? block.to[l] : 0.0F;
      ASSERT_NEAR(find(alone).sky[l], together.sky[l], 1e-5F) << "turn " << turn << ", receiver " << l;
      ASSERT_TRUE(together.sky[l] >= 0.0F && together.sky[l] <= 1.0F);
    }
  }
}

TEST_F(GapsBelowTriangles, AreAnsweredAlikeInAnyGroup) {
  GapSections together(ring_), alone(ring_);
  std::vector<ReceiverPacket> packets;
  for (int n = 0; n < 5; ++n) packets.push_back(receivers({8.0 * n - 20.0, 4.0}));
  draw_gaps();
  const std::vector<PacketHorizon> grounded(packets.size(), from_);
  together.begin(packets, grounded);
  for (const ReceiverPacket& packet : packets) {
    const std::span<const OpenGap> one = together.find_open(facets_, gaps(packet), SkyWeight::solid_angle, packet),
                                   other = alone.find_any_open(facets_, gaps(packet), SkyWeight::solid_angle, packet);
    ASSERT_EQ(one.size(), other.size());
    std::map<std::pair<std::uint32_t, std::uint32_t>, float> sky;
    for (const OpenGap& gap : one) sky[{gap.azimuth, gap.lane}] = gap.sky;
    for (const OpenGap& gap : other) EXPECT_EQ((sky[{gap.azimuth, gap.lane}]), gap.sky);
  }
}

TEST_F(GapsBelowTriangles, OnlyThoseAreAskedWhoAreMeant) {
  GapSections sections(ring_);
  const ReceiverPacket packet = receivers({0.0, 0.0});
  draw_gaps();
  constexpr std::uint32_t some = 0b1010'0000'0001'0110;
  Gaps asked = gaps(packet);
  asked.receivers = some;
  const std::span<const OpenGap> open = sections.find_any_open(facets_, asked, SkyWeight::cosine, packet);
  EXPECT_FALSE(open.empty());
  for (const OpenGap& gap : open) EXPECT_TRUE(has_bit(some, gap.lane));
}

/// All gaps are from the level up to the zenith.
class OneFacet : public testing::Test {
 protected:
  [[nodiscard]] std::vector<OpenGap> open_around(const std::array<Point3f, 4>& quad, const Point3f& eye) {
    OverhangFacets facets;
    facets.add({quad[0], quad[1], quad[2]});
    facets.add({quad[0], quad[2], quad[3]});
    std::fill_n(to_.drawn_slopes(), azimuths * packet_lanes, std::numeric_limits<float>::infinity());
    const std::vector<Point3f> places{eye};
    const ReceiverPacket packet = packet_of(places, {0.0F, 0.0F, 1.0F});
    std::vector<PacketHorizon::Row> sky;
    level_.find_sky_below(to_, SkyWeight::cosine, packet, sky);
    const auto open = sections_.find_any_open(facets, {level_, to_, level_, level_, sky, 1U}, SkyWeight::cosine, packet);
    return {open.begin(), open.end()};
  }
  const AzimuthSampling ring_ = AzimuthSampling::even(azimuths, {});
  PacketHorizon level_{ring_}, to_{ring_};
  GapSections sections_{ring_};
};

TEST_F(OneFacet, OverheadHidesAllAboveItsBorder) {
  const std::vector<OpenGap> open = open_around({{{-5, -5, 4}, {5, -5, 4}, {5, 5, 4}, {-5, 5, 4}}}, {1.0F, 2.0F, 1.0F});
  ASSERT_EQ(open.size(), azimuths);
  for (const OpenGap& gap : open) {
    const double c = ring_.cosine()[gap.azimuth], s = ring_.sine()[gap.azimuth];
    const double distance = std::min(((c > 0.0 ? 4.0 : -6.0) / c), (s > 0.0 ? 3.0 : -7.0) / s);
    EXPECT_EQ(gap.from, 0.0F);
    EXPECT_NEAR(gap.to, 3.0 / distance, 1e-6);
  }
}

TEST_F(OneFacet, OnWhoseSurfaceAnEyeStandsHidesNothing) {
  // Of a wall nothing is met that is nearer than least_distance_m: along a ray, so that half a millimetre hides what is behind at
  // azimuths within 30° of the wall
  for (const float y : {0.0F, 0.0005F, -0.0005F}) {
    int open = 0;
    for (const OpenGap& gap : open_around({{{-5, 0, 0}, {5, 0, 0}, {5, 0, 9}, {-5, 0, 9}}}, {1.0F, y, 2.0F}))
      open += gap.sky == 1.0F ? 1 : 0;
    EXPECT_EQ(open, y == 0.0F ? azimuths : azimuths - azimuths / 6) << y;
  }
  // A roof is under who stands on it, and hides what is below its plane
  for (const float above : {0.0F, 0.0005F, -0.0005F}) {
    const auto open = open_around({{{-5, -5, 0}, {5, -5, 0}, {5, 5, 10}, {-5, 5, 10}}}, {0.0F, 0.0F, 5.0F + above});
    ASSERT_EQ(open.size(), azimuths);
    for (const OpenGap& gap : open) EXPECT_NEAR(gap.from, std::max(0.0, double{ring_.sine()[gap.azimuth]}), 1e-3) << gap.azimuth;
  }
}

TEST_F(OneFacet, WithACornerOnTheAzimuthHidesNothingThere) {
  // The first azimuth of four is the diagonal: the corner touches it, and the rest is to the right
  const AzimuthSampling four = AzimuthSampling::even(4, {});
  const float c = four.cosine()[0], s = four.sine()[0];
  ASSERT_EQ(c, s);
  OverhangFacets facets;
  facets.add({Point3f{4, 4, 3}, {9, 5, 9}, {20, 2, 2}});
  PacketHorizon level(four), to(four);
  std::fill_n(to.drawn_slopes(), 4 * packet_lanes, std::numeric_limits<float>::infinity());
  const std::vector<Point3f> places{{0, 0, 1}};
  const ReceiverPacket packet = packet_of(places, {0.0F, 0.0F, 1.0F});
  std::vector<PacketHorizon::Row> sky;
  level.find_sky_below(to, SkyWeight::cosine, packet, sky);
  GapSections sections(four);
  for (const OpenGap& gap : sections.find_any_open(facets, {level, to, level, level, sky, 1U}, SkyWeight::cosine, packet))
    EXPECT_EQ(gap.sky, 1.0F) << gap.azimuth;
}

TEST_F(OneFacet, SeenEdgeOnHidesNothing) {
  for (const OpenGap& gap : open_around({{{2, 0, 3}, {9, 0, 3}, {9, 0, 3.5}, {2, 0, 3.5}}}, {0.0F, 0.0F, 1.0F}))
    EXPECT_EQ(gap.sky, 1.0F) << gap.azimuth;
}

}  // namespace
}  // namespace farlod
